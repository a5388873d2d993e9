/*
 * reference_bounds: a hierarchy of boxes around triangles, so that a line meets few of them.
 */
#ifndef REFERENCE_BOUNDS_H
#define REFERENCE_BOUNDS_H

#include "base/stop.h"
#include "reference/reference_real.h"

#include <stddef.h>
#include <stdint.h>

/* Inner: `count` is 0, and `first` the number of a node; else so many triangles from `first` on. */
typedef struct BoundsChild {
    uint32_t first, count;
} BoundsChild;

/* Four boxes side by side, so that one step meets them all; those that are not needed are empty. */
enum { BOUNDS_WIDTH = 4 };
typedef struct BoundsNode {
    Real sides[2][3][BOUNDS_WIDTH]; /* [low or high][axis][child] */
    BoundsChild children[BOUNDS_WIDTH];
} BoundsNode;

typedef struct Box {
    Real low[3], high[3];
} Box;

/* A triangle while the hierarchy is built: moved as a whole, so that memory is read in order. */
typedef struct BoundsItem {
    Box box;
    uint32_t number; /* in the mesh */
    int bin;         /* for bounds_build */
} BoundsItem;

/* No path is longer than 72 cuts, two in a node, of which three children wait. */
enum { BOUNDS_STACK = 128 };

/* Builds a hierarchy, and puts the items of a leaf together. About so many threads work at a large
 * one. The nodes, to be freed; NULL where memory runs out, or it was stopped. */
BoundsNode *bounds_build(BoundsItem *items, size_t count, int threads, const atomic_bool *stop);

static inline Box box_empty(void)
{
    return (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static inline void box_extend(Box *box, const Real low[3], const Real high[3])
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = real_min(box->low[k], low[k]);
        box->high[k] = real_max(box->high[k], high[k]);
    }
}

#endif
