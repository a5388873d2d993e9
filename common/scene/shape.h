/*
 * shape: the solids of the examples by name, upright and centred at the origin.
 */
#ifndef SHAPE_H
#define SHAPE_H

#include "scene/scene.h"

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
    SHAPE_HEAD_FACETED, /* of a fox: one normal for each face of its cage */
    SHAPE_HEAD_SMOOTH,  /* ... for each vertex */
    SHAPE_HEAD,         /* ... subdivided twice */
    SHAPE_COUNT,
} ShapeKind;

/* Names by value, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const SHAPE_NAMES[SHAPE_COUNT + 1];

/* Whose measures and divisions. */
typedef enum ShapeStyle {
    SHAPE_LECTURE,  /* about the unit sphere: cube of side 2, sphere of 20 divisions */
    SHAPE_TEXTBOOK, /* half as large: cube of side 1, sphere of 128 x 64 */
} ShapeStyle;

/* A model file, and which of its axes points up: a ModelUp; or how fine the mesh of a shape is. */
typedef struct ShapeModel {
    const char *path; /* NULL: none */
    int up;
    int divisions; /* of solid_mesh, at least SOLID_MIN_DIVISIONS; 0: the style's own mesh */
} ShapeModel;

extern const char *const SHAPE_UP_NAMES[];

typedef struct Shape {
    Mesh mesh;
    Solid solid;
    bool flat, closed; /* as in Object */
    Mat4 placed;       /* centred and upright, from the mesh as it is */
} Shape;

/* The model file, moved and scaled into the unit sphere, or half of it for the textbook; if
 * there is none, or `model` is NULL, a solid. A shape without a formula has no divisions. */
bool shape_open(Shape *shape, ShapeKind kind, ShapeStyle style, const ShapeModel *model,
                Message *message);

/* An object of this shape. It points at the shape's mesh. */
Object shape_object(const Shape *shape, Mat4 world_from_object, Material material);

/* NULL or a zeroed shape is fine. */
void shape_close(Shape *shape);

#endif
