/*
 * reference_solid: where a ray meets a solid, and the solid's normal there. In the solid's own
 * coordinates, see mesh.h and solid.h.
 */
#ifndef REFERENCE_SOLID_H
#define REFERENCE_SOLID_H

#include "reference/reference_real.h"
#include "shapes/solid.h"

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

#endif
