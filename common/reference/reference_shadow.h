/*
 * reference_shadow: whether a light that casts shadows reaches a point of a surface.
 *
 * The segment between them is intersected with every object, solids by formula. Nothing is moved
 * by an epsilon. Three rules decide what rounding would decide otherwise:
 *
 * - The surface's own side. A point is lit on one side, that to which the normal of its lighting
 *   points. If the light is on the other side of the solid's tangent plane, or of the triangle's
 *   plane, the surface itself is between them. On a mesh with smooth normals N.L may be positive
 *   there: these triangles are in shadow, as stencil volumes have it. The teapot's triangles, which
 *   stand for a smooth surface, have the plane of the interpolated normal. A convex object
 *   (object_is_convex) never shadows itself: its mesh neither, whose triangles may face away where
 *   N.L > 0.
 * - Which surface. A triangle does not shadow itself. A solid is met through one of its own points,
 *   so that one root is known: see solid_blocks.
 * - Error bounds. A surface that either end of the segment lies on, as far as the error of its
 *   coordinates lets tell, does not block it there: neighbours in a mesh, sheets in the same place,
 *   a light on a surface. Errors are those of a few roundings of coordinates as seen from the eye.
 *   (Waechter and Binder, A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing
 *   Gems, 2019, chapter 6; Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition,
 *   2023, section 6.8)
 *
 * Space: the axes are the world's, the origin is the eye.
 */
#ifndef REFERENCE_SHADOW_H
#define REFERENCE_SHADOW_H

#include "reference/reference_object.h"

/* A light, seen from an object that is exact. */
typedef struct ShadowEnd {
    Real3 place;      /* the light's position, or the direction towards it; object coordinates */
    uint32_t touched; /* see solid_touched */
} ShadowEnd;

typedef struct Shadows {
    const TraceObject *objects;
    int object_count;
    const ShadeLight *lights;
    int light_count;
    ShadowEnd *ends; /* of the lights for object 0, for object 1, ... */
} Shadows;

/* False where memory runs out; to be closed all the same. Objects and lights stay in use. */
bool shadows_open(Shadows *shadows, const TraceObject *objects, int object_count,
                  const ShadeLight *lights, int light_count);
void shadows_close(Shadows *shadows);

/* A point of a surface, as a segment to a light begins there. */
typedef struct ShadowPoint {
    const Shadows *shadows;
    int object;
    int part;          /* of a solid */
    uint32_t triangle; /* of triangles */
    Real3 from;
    Real3 local;  /* the same in object coordinates, if it is exact */
    Real reach;   /* the size of the coordinates that `from` was computed from */
    Real3 normal; /* the surface's own unit normal, on the side that is lit */
} ShadowPoint;

/* A point of an exact object, on a part of its solid, in object coordinates. `geometric` is the
 * unit normal outwards there, and `shading` the one of its lighting. */
ShadowPoint shadow_start_solid(const Shadows *shadows, int object, int part, Real3 local,
                               Real3 geometric, Real3 shading);

/* A point of an object's triangle, by the weights of its corners. */
ShadowPoint shadow_start_triangle(const Shadows *shadows, int object, uint32_t triangle,
                                  const Real weights[3], Real3 geometric, Real3 shading);

/* Whether light number `light` does not reach the point. */
bool shadow_falls(const ShadowPoint *point, int light);

/* shade_point of a point where shadows may fall, which begin at `start`. A light that a shadow
 * keeps off is on the side of those that the point does not face. */
Real3 shadow_shade(const Shading *shading, const ShadePoint *point, const ShadowPoint *start,
                   ShadeSides *sides);

#endif
