/*
 * binding: the interface between a lab's scene and a submission's shaders: attributes and uniforms
 * by name, each set if the program has it.
 *
 * Values adapt to the declared type: a vec4 instead of a vec3 gets w = 1 for a position or colour
 * and 0 for a direction, a mat3 gets a mat4's upper left part, a short array the first lights.
 */
#ifndef BINDING_H
#define BINDING_H

#include "core/gl.h"
#include "core/mesh_buffer.h"
#include "core/shader.h"
#include "labs/program/lab.h"
#include "labs/program/lab_scene.h"

/* The shadow map of a lab's scene: the depths that its light sees, in a texture that OpenGL ES 2.0
 * and WebGL 1 draw and read without extensions: packed into red, green and blue. */

enum { LAB_SHADOW_MAP_SIZE = 1024 }; /* in texels, each way */

typedef struct LabShadowMap {
    GLuint texture;
    Mat4 clip_from_world; /* of the light */
    Shader shader;        /* that draws it */
} LabShadowMap;

/* Draws it, and binds what was bound. Of a scene whose light casts no shadows it has no texture. It
 * is zeroed before, or open: then it is that of another scene from now on, drawn by the same
 * shader, which a driver compiles in 30 ms. */
bool lab_shadow_map_open(LabShadowMap *map, const LabScene *lab_scene, Message *message);
void lab_shadow_map_close(LabShadowMap *map); /* NULL or zeroed is fine */

/* One object of a scene, drawn with this aspect ratio, width / height. */
typedef struct Drawn {
    const Scene *scene;
    int object;
    double aspect;
    const Mat4 *world_from_object; /* lab 3's; NULL: the object's */
    const Mat4 *normal_matrix;     /* lab 3's; NULL: the inverse transpose */
    const LabShadowMap *map;       /* lab 11's; stays bound */
    const double (*own)[4];        /* LabScene.own; NULL if the lab has none */
} Drawn;

/* Checks every active attribute and uniform of a linked program. False, with a message about the
 * first that the lab's interface lacks (naming the nearest) or that has another type. */
bool binding_check(const Lab *lab, const Shader *shader, Message *message);

/* Whether the lab's interface has a value of this name. */
bool binding_has(const Lab *lab, const char *name);

/* Sets the uniforms and the colour, binds the mesh and draws it with the program, which stays in
 * use. False, with a message: the camera is degenerate. */
bool binding_draw(const Lab *lab, GLuint program, const MeshBuffer *mesh, const Drawn *drawn,
                  Message *message);

/* A uniform of the interface as numbers, without a program. No GL. */
typedef struct BindingValue {
    const char *name;
    int count, size; /* of array elements; of each one's numbers, a vector's 4; of a map 0 */
    float numbers[16];
} BindingValue;
enum { BINDING_VALUES = 32 + LAB_MAX_UNIFORMS };

/* How many the lab has; 0, with a message: the camera is degenerate. */
int binding_values(const Lab *lab, const Drawn *drawn, BindingValue values[BINDING_VALUES],
                   Message *message);

/* The inverse transpose of the matrix's 3x3 part; the identity if it is singular. Unlike
 * mat4_normal it keeps the scale. */
Mat4 binding_normal_matrix(Mat4 matrix);

#endif
