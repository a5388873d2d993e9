#include "reference/reference_bounds.h"

#include <stdlib.h>

/* By the surface area heuristic, estimated in bins. (Wald, On fast Construction of SAH-based
 * Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray Tracing, 2007) */

enum { BINS = 16, LEAF = 4, SAH_DEPTH = 40 };

typedef struct Box {
    Real low[3], high[3];
} Box;

typedef struct Builder {
    Bounds *bounds;
    const Real (*boxes)[2][3];
    uint32_t node_count;
    const atomic_bool *stop;
} Builder;

static Box empty_box(void)
{
    return (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void extend(Box *box, const Real low[3], const Real high[3])
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = real_min(box->low[k], low[k]);
        box->high[k] = real_max(box->high[k], high[k]);
    }
}

static Real half_area(const Box *box)
{
    const Real x = box->high[0] - box->low[0], y = box->high[1] - box->low[1];
    const Real z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

static Real center(const Builder *builder, uint32_t item, int axis)
{
    return (builder->boxes[item][0][axis] + builder->boxes[item][1][axis]) / 2;
}

typedef struct Bin {
    Box box;
    uint32_t count;
} Bin;

static int bin_of(Real value, Real low, Real high)
{
    /* No number, or infinite, where the box is too small or too large to be divided. */
    const Real share = (value - low) / (high - low);
    const int bin = share > 0 ? (int)(BINS * (share < 1 ? share : 1)) : 0;
    return bin < BINS ? bin : BINS - 1;
}

/* Whether cutting between two bins beats a leaf; where. */
static bool best_cut(const Builder *builder, const uint32_t *items, uint32_t count,
                     const Box *centers, int axis, int *cut)
{
    Bin bins[BINS];
    Real right[BINS], best = INFINITY;
    Box box = empty_box();
    uint32_t below = 0, above = 0;
    for (int i = 0; i < BINS; i++)
        bins[i] = (Bin){empty_box(), 0};
    for (uint32_t i = 0; i < count; i++) {
        Bin *bin =
            &bins[bin_of(center(builder, items[i], axis), centers->low[axis], centers->high[axis])];
        bin->count++;
        extend(&bin->box, builder->boxes[items[i]][0], builder->boxes[items[i]][1]);
    }
    for (int i = BINS - 1; i > 0; i--) {
        above += bins[i].count;
        extend(&box, bins[i].box.low, bins[i].box.high);
        right[i] = half_area(&box) * above;
    }
    box = empty_box();
    for (int i = 1; i < BINS; i++) {
        below += bins[i - 1].count;
        extend(&box, bins[i - 1].box.low, bins[i - 1].box.high);
        const Real cost = half_area(&box) * below + right[i];
        if (below > 0 && below < count && cost < best) {
            best = cost;
            *cut = i;
        }
    }
    return best < INFINITY;
}

/* Puts items with a center below the cut first; returns their number, 0 where nothing separates
 * them. */
static uint32_t separate(const Builder *builder, uint32_t *items, uint32_t count, int depth)
{
    Box centers = empty_box();
    int axis = 0, cut = 0;
    for (uint32_t i = 0; i < count; i++) {
        const Real c[3] = {center(builder, items[i], 0), center(builder, items[i], 1),
                           center(builder, items[i], 2)};
        extend(&centers, c, c);
    }
    for (int k = 1; k < 3; k++)
        if (centers.high[k] - centers.low[k] > centers.high[axis] - centers.low[axis])
            axis = k;
    /* Items in one place, or a chain of lopsided cuts: any halves. */
    if (depth > SAH_DEPTH || !(centers.high[axis] > centers.low[axis]) ||
        !best_cut(builder, items, count, &centers, axis, &cut))
        return count / 2;
    uint32_t below = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t item = items[i];
        if (bin_of(center(builder, item, axis), centers.low[axis], centers.high[axis]) < cut) {
            items[i] = items[below];
            items[below++] = item;
        }
    }
    return below;
}

static void build(Builder *builder, uint32_t number, uint32_t first, uint32_t count, int depth)
{
    BoundsNode *node = &builder->bounds->nodes[number];
    uint32_t *items = builder->bounds->order + first;
    Box box = empty_box();
    for (uint32_t i = 0; i < count; i++)
        extend(&box, builder->boxes[items[i]][0], builder->boxes[items[i]][1]);
    for (int k = 0; k < 3; k++) {
        node->low[k] = box.low[k];
        node->high[k] = box.high[k];
    }
    node->first = first;
    node->count = count;
    if (count <= LEAF || stop_asked(builder->stop))
        return;
    const uint32_t below = separate(builder, items, count, depth);
    node->first = builder->node_count;
    node->count = 0;
    builder->node_count += 2;
    const uint32_t children = node->first;
    build(builder, children, first, below, depth + 1);
    build(builder, children + 1, first + below, count - below, depth + 1);
}

bool bounds_build(Bounds *bounds, const Real (*boxes)[2][3], size_t count, const atomic_bool *stop)
{
    *bounds = (Bounds){NULL, NULL};
    if (count == 0)
        return true;
    if (count > UINT32_MAX / 2)
        return false;
    bounds->nodes = calloc(2 * count, sizeof *bounds->nodes);
    bounds->order = calloc(count, sizeof *bounds->order);
    if (!bounds->nodes || !bounds->order) {
        bounds_close(bounds);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        bounds->order[i] = (uint32_t)i;
    Builder builder = {bounds, boxes, 1, stop};
    build(&builder, 0, 0, (uint32_t)count, 0);
    if (!stop_asked(stop))
        return true;
    bounds_close(bounds);
    return false;
}

void bounds_close(Bounds *bounds)
{
    free(bounds->nodes);
    free(bounds->order);
    *bounds = (Bounds){NULL, NULL};
}
