/*
 * reference_bounds: a hierarchy of boxes around triangles, so that a ray meets few of them.
 */
#ifndef REFERENCE_BOUNDS_H
#define REFERENCE_BOUNDS_H

#include "base/stop.h"
#include "reference/reference_real.h"

#include <stddef.h>
#include <stdint.h>

/* A box. An inner node's children are `first` and `first` + 1; a leaf has `count` items from number
 * `first` of the order on. */
typedef struct BoundsNode {
    Real low[3], high[3];
    uint32_t first, count;
} BoundsNode;

/* No path from the root is longer. */
enum { BOUNDS_MAX_DEPTH = 80 };

typedef struct Bounds {
    BoundsNode *nodes; /* the root first; NULL where there are no items */
    uint32_t *order;   /* the items, those of a leaf together */
} Bounds;

/* Builds it over `count` boxes, lows and highs in turn. False where memory runs out, or it was
 * stopped. */
bool bounds_build(Bounds *bounds, const Real (*boxes)[2][3], size_t count, const atomic_bool *stop);
void bounds_close(Bounds *bounds);

#endif
