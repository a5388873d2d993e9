/*
 * shape: the solids that an example offers, by name, about as large as a sphere of radius 1.
 */
#ifndef SHAPE_H
#define SHAPE_H

#include "scene.h"

typedef enum ShapeKind {
    SHAPE_CUBE, /* side 2 */
    SHAPE_SPHERE,
    SHAPE_TEAPOT,
    SHAPE_TORUS,
    SHAPE_CONE,
    SHAPE_CYLINDER,
    SHAPE_TETRAHEDRON,
    SHAPE_OCTAHEDRON,
    SHAPE_DODECAHEDRON,
    SHAPE_ICOSAHEDRON,
    SHAPE_COUNT,
} ShapeKind;

/* Their names by number, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const SHAPE_NAMES[SHAPE_COUNT + 1];

/* A mesh and what is known of it. */
typedef struct Shape {
    Mesh mesh;
    Solid solid;
    bool flat, closed; /* as in Object */
} Shape;

/* A model file, where `model` is not NULL, moved and scaled into the unit sphere; else a solid. Cut
 * as finely as the originals have it: the sphere by 20, the torus 64 x 32, the cylinder by 64.
 */
bool shape_open(Shape *shape, ShapeKind kind, const char *model, Message *message);

/* An object of this shape. It points at the shape's mesh. */
Object shape_object(const Shape *shape, Mat4 world_from_object, Material material);

/* NULL or a zeroed shape is fine. */
void shape_close(Shape *shape);

#endif
