/*
 * overlay: unlit lines and points drawn over a scene: coordinate axes, positions of lights,
 * normals, edges of triangles.
 */
#ifndef OVERLAY_H
#define OVERLAY_H

#include "core/shader.h"
#include "scene/scene.h"

typedef struct OverlayVertex {
    float position[3]; /* in world coordinates */
    float color[3];
} OverlayVertex;

/* A growing list of lines (two vertices each) or points. Zeroed, it is empty. */
typedef struct OverlayList {
    OverlayVertex *vertices;
    int count, capacity;
    bool points; /* not lines */
    double size; /* of points, or the lines' width, in pixels; 0: 1 */
    bool failed; /* memory ran out: the list is incomplete */
} OverlayList;

/* The three axes from the origin: x red, y green, z blue. */
void overlay_add_axes(OverlayList *list, double length);

/* Lines along the normals that objects are lit with, transformed as each has it: of the vertices;
 * with flat interpolation of the triangles, from their middles. Those of the front are yellow; a
 * back with a material of its own has the opposite ones, in light blue. Half as long as the
 * object's radius, or a tenth where there are many. */
void overlay_add_normals(OverlayList *list, const Scene *scene);

/* The edges of the faces: sides of triangles, each once, but for diagonals, which two triangles of
 * one plane share. Draw the object with `behind_lines`. */
void overlay_add_edges(OverlayList *list, const Mesh *mesh, Mat4 world_from_object, Vec3 color);

/* A white point at each light, dark grey if it is off; of a directional light at its direction. */
void overlay_add_lights(OverlayList *list, const Scene *scene);

void overlay_list_close(OverlayList *list);

typedef struct Overlay {
    Shader shader;
    GLuint buffer;
    GLint a_Position, a_Color, u_ClipFromWorld, u_PointSize;
} Overlay;

bool overlay_open(Overlay *overlay, const ShaderLoader *loader, Message *message);

/* Draws a list with the scene's camera. */
bool overlay_draw(const Overlay *overlay, const OverlayList *list, const Scene *scene,
                  double aspect, Message *message);
void overlay_close(Overlay *overlay);

#endif
