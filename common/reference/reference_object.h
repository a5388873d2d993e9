/*
 * reference_object: an object of the scene, made ready for rays from the eye.
 *
 * Space: the axes are the world's, the origin is the eye. Translations are subtracted before
 * anything is multiplied, so that a scene far from the origin is what it is there.
 */
#ifndef REFERENCE_OBJECT_H
#define REFERENCE_OBJECT_H

#include "reference/reference.h"
#include "reference/reference_shade.h"
#include "reference/reference_triangles.h"
#include "scene/scene.h"

/* It contains an object, with room for rounding. */
typedef struct Ball {
    Real3 center;
    Real square; /* of its radius */
} Ball;

typedef struct TraceObject {
    const Object *object;
    Real3 columns[3];        /* of world_from_object */
    Real3 normal_columns[3]; /* what normals are transformed with, up to a factor; zero: none is */
    Real3 offset;            /* its translation, from the eye */
    bool mirrored;           /* determinant below 0 */
    bool exact;              /* a solid by its formula; else triangles */
    Ball ball;               /* what contains it */
    Real3 inverse[3], eye;   /* exact: rows of object_from_world, the eye in object coordinates */
    /* Triangles, and for each of their vertices the unit normal; or, where light is computed there,
     * the colors of the front and of the back: for each vertex, or, for flat triangles, for each
     * corner. */
    Triangles triangles;
    Mesh own; /* of a teapot: made for its formula, of which it has none */
    const Mesh *mesh;
    Real3 *points, *normals;
    bool smooth;      /* the triangles stand for a smooth surface: the teapot's */
    Real3 *colors[2]; /* one such array after the other for each layer: see TraceLayers */
    bool own_corners;
    size_t color_count; /* of a layer */
} TraceObject;

/* Light at the corners in parts: first all but the diffuse and specular light of the lights that
 * cast shadows, then that of each such light. Without any: everything is in one. */
typedef struct TraceLayers {
    const Shading *layers;
    int count;
} TraceLayers;

/* False where memory runs out, or it was stopped; to be closed all the same. */
bool trace_object_open(TraceObject *ready, const Object *object, const Scene *scene,
                       const TraceLayers *layers, const ReferenceOptions *options);
void trace_object_close(TraceObject *ready);

/* Whether a line from `from` along `way`, or a segment to from + way, surely misses a ball. */
static inline bool ball_missed(const Ball *ball, Real3 from, Real3 way, bool endless)
{
    const Real3 there = real3_subtract(ball->center, from);
    const Real square = real3_dot(there, there), length = real3_dot(way, way);
    const Real along = real3_dot(there, way), rounding = (Real)1e-13;
    /* Of the distance to where the line touches the ball. */
    const Real tangent = square - ball->square - rounding * square;
    if (!(tangent > 0))
        return false; /* it may begin inside */
    const Real beyond = square - 2 * along + length - rounding * (square + length);
    return along < 0 || tangent * length > along * along ||
           (!endless && along > length && beyond > ball->square);
}

/* A point in object coordinates, as seen from the eye. */
Real3 trace_object_place(const TraceObject *ready, Real3 point_object);

/* The unit normal that light sees, from one in object coordinates; zero where there is none. */
Real3 trace_object_normal(const TraceObject *ready, Real3 normal_object);

#endif
