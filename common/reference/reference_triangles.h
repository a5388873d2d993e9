/*
 * reference_triangles: rays from the eye, and segments to lights, against triangles.
 *
 * Space: the axes are the world's, the origin is the eye, where every ray begins.
 */
#ifndef REFERENCE_TRIANGLES_H
#define REFERENCE_TRIANGLES_H

#include "core/mesh.h"
#include "reference/reference_bounds.h"

#include <stddef.h>
#include <stdint.h>

typedef struct Triangle {
    Real3 corners[3]; /* from the origin */
    uint32_t number;  /* in the mesh */
    uint32_t piece;   /* a triangle of it: pieces are what hangs together by equal corners */
} Triangle;

typedef struct Triangles {
    Triangle *triangles; /* in the order of the boxes */
    size_t count;
    BoundsNode *nodes; /* a hierarchy of boxes, so that a ray meets few triangles; the root first */
    const uint32_t *indices;    /* of the mesh */
    uint32_t *equal, *in_place; /* of each vertex the first that equals it; in the same place */
} Triangles;

/* The triangles of a mesh with its vertices at `points`; without those that have no area. Vertices
 * are equal where position and normal are, the normal but for 1e-3. Where `apart` is set no two
 * triangles hang together. About so many threads work at a large mesh. The mesh stays in use. False
 * where memory runs out, or it was stopped. */
bool triangles_open(Triangles *triangles, const Mesh *mesh, const Real3 *points, bool apart,
                    int threads, const atomic_bool *stop);
void triangles_close(Triangles *triangles);

/* Not a unit vector. */
static inline Real3 triangle_normal(const Triangle *triangle)
{
    const Real3 *v = triangle->corners;
    return real3_cross(real3_subtract(v[1], v[0]), real3_subtract(v[2], v[0]));
}

typedef struct TriangleHit {
    Real t;
    Real weights[3]; /* of the corners; their sum is 1 */
    uint32_t index;  /* in `triangles` */
} TriangleHit;

/* The nearest point t * direction with near <= t <= far and t < hit->t on a triangle; of several
 * with that t that of the first triangle of the mesh. A ray through an edge or corner that
 * triangles share meets at least one of them. */
bool triangles_ray(const Triangles *triangles, Real3 direction, Real near, Real far,
                   TriangleHit *hit);

/* From a point of some surface to a light. */
typedef struct TriangleSegment {
    Real3 from, way; /* to from + way; endless to a directional light */
    bool endless;
    uint32_t own;            /* in `triangles`: the one that `from` lies on; else TRIANGLES_NONE */
    Real error, light_error; /* of distances between the ends and a triangle, but for what the size
                                of the triangle's coordinates adds */
} TriangleSegment;
#define TRIANGLES_NONE 0xFFFFFFFFU

/* Whether a triangle meets the segment between its ends; not where an end lies in its plane, as
 * far as rounding lets tell: that is a triangle next to the own one, or in the same place. No
 * segment slips through an edge or corner that triangles share. */
bool triangles_block(const Triangles *triangles, const TriangleSegment *segment);

/* How many corners two triangles have in common, 3 for one with itself; and how many places. More
 * places than corners make a crease between them. */
typedef struct TrianglesShare {
    int corners, places;
} TrianglesShare;
TrianglesShare triangles_share(const Triangles *triangles, uint32_t a, uint32_t b);

#endif
