/*
 * reference_solid: where a ray meets a solid, the solid's normal there, and whether the solid lies
 * between two points. In the solid's own coordinates, see mesh.h and solid.h.
 */
#ifndef REFERENCE_SOLID_H
#define REFERENCE_SOLID_H

#include "reference/reference_real.h"
#include "shapes/solid.h"

#include <stdint.h>

/* The real roots of polynomials of at most the fourth degree. */

/* All roots of c[0] + c[1] s + ... + c[degree] s^degree between low and high, in their order;
 * returns their number. Where it touches 0 without a change of sign there is none. */
int polynomial_roots(const Real *c, int degree, Real low, Real high, Real *roots);

/* A point of the line origin + t direction on the surface; `part` is the face that it lies on: of a
 * box in the order of mesh_cube; of a cylinder or cone one of those below; of all others 0. */
typedef struct SolidHit {
    Real t;
    int part;
} SolidHit;

enum { PART_SIDE, PART_TOP, PART_BOTTOM };
enum { SOLID_MAX_HITS = 4 };

/* The points where a line meets a solid that has a formula and is no teapot, in the order of t;
 * returns their number. The direction has any length but 0. A point's distance from the surface is
 * within 1e-9 of the solid's size where the origin is within 1000 such sizes; a line that misses
 * or hits by less than that may do either. */
int ray_solid(const Solid *solid, Real3 origin, Real3 direction, SolidHit hits[SOLID_MAX_HITS]);

/* The unit normal at a point of such a part, outwards; at a cone's apex along its axis. */
Real3 solid_normal(const Solid *solid, int part, Real3 point);

/* The point of a part's surface next to a point within 1e-3 of the solid's size: it lies there but
 * for a few roundings. */
Real3 solid_project(const Solid *solid, int part, Real3 point);

/* The parts on which a point lies, a bit each, given the error of its coordinates; an end that is
 * open counts like a cap, because it bounds the solid's convex hull. */
uint32_t solid_touched(const Solid *solid, Real3 point, Real3 error);

/* From a point on some surface to a light. */
typedef struct SolidSegment {
    Real3 from, way; /* to from + way; endless to a directional light */
    bool endless;
    Real3 error;            /* of the coordinates of `from` */
    uint32_t touched;       /* the parts that `from` is known to lie on */
    uint32_t light_touched; /* those that the light lies on */
} SolidSegment;

/* Whether a solid as above meets a segment between its ends, which do not count themselves. Where
 * an end lies on the surface this is not left to the sign of a root next to 0: one root is known,
 * and the others are those of the line through a point of the surface. A convex solid has one other
 * if the line goes inwards, none if it goes outwards; of a torus's quartic a cubic is left. */
bool solid_blocks(const Solid *solid, const SolidSegment *segment);

#endif
