/*
 * marks: unlit lines and points that explain a scene: coordinate axes, the places of lights,
 * normals, the edges of triangles.
 */
#ifndef MARKS_H
#define MARKS_H

#include "scene.h"
#include "shader.h"

typedef struct MarkVertex {
    float position[3]; /* in the world */
    float color[3];
} MarkVertex;

/* A growing list of lines (two vertices each) or points. Zeroed, it is empty. */
typedef struct MarkList {
    MarkVertex *vertices;
    int count, capacity;
    bool failed; /* memory ran out: the list is not whole */
} MarkList;

void marks_add_point(MarkList *list, Vec3 position, Vec3 color);
void marks_add_line(MarkList *list, Vec3 from, Vec3 to, Vec3 color);

/* The three axes from the origin: x red, y green, z blue. */
void marks_add_axes(MarkList *list, double length);

/* Each vertex's normal, transformed by `normal_matrix` and made unit, as a line of this length. */
void marks_add_normals(MarkList *list, const Mesh *mesh, Mat4 world_from_object, Mat4 normal_matrix,
                       double length, Vec3 color);

/* The edges of every triangle. */
void marks_add_edges(MarkList *list, const Mesh *mesh, Mat4 world_from_object, Vec3 color);

/* Each light's place, if it has one, in its diffuse colour; dark if it is off. */
void marks_add_lights(MarkList *list, const Scene *scene);

void marks_list_close(MarkList *list);

typedef struct Marks {
    Shader shader;
    GLuint buffer;
    GLint a_Position, a_Color, u_ClipFromWorld, u_PointSize;
} Marks;

bool marks_open(Marks *marks, const ShaderLoader *loader, Message *message);

/* Draws a list as GL_LINES, or as GL_POINTS of `size` pixels, as the scene's camera sees it. */
bool marks_draw(const Marks *marks, const MarkList *list, GLenum mode, double size,
                const Scene *scene, double aspect, Message *message);
void marks_close(Marks *marks);

#endif
