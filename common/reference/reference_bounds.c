/*
 * By the surface area heuristic: a line that meets a box meets one inside it about as often as its
 * share of the surface, so the cut that costs least is the one with the smallest sum of count times
 * surface on both sides. It is estimated in 16 bins along the longest axis, not at every item,
 * which takes time linear in the items for each level. (Wald, On fast Construction of SAH-based
 * Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray Tracing, 2007)
 *
 * Two levels of cuts make one node of four boxes, which a line meets together, two at a time. Below
 * a depth of 40 parts are halves, so that the depth is bounded whatever the triangles are. Branches
 * of many items are built by threads of their own: each has its share of the nodes' array, because
 * there are fewer nodes than items.
 */
#include "reference/reference_bounds.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 16, LEAF = 4, SAH_DEPTH = 40 };

/* So many items are a few milliseconds' work. */
enum { STRIDE = 16384 };

static Real half_area(const Box *box)
{
    const Real x = box->high[0] - box->low[0], y = box->high[1] - box->low[1];
    const Real z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

/* Items, and what contains them and their centers. */
typedef struct Part {
    Box box, centers;
    uint32_t count;
} Part;

static Part no_part(void)
{
    return (Part){box_empty(), box_empty(), 0};
}

static inline void add_item(Part *part, const BoundsItem *item)
{
    Real center[3];
    for (int k = 0; k < 3; k++)
        center[k] = (item->box.low[k] + item->box.high[k]) / 2;
    box_extend(&part->box, item->box.low, item->box.high);
    box_extend(&part->centers, center, center);
    part->count++;
}

static void add_part(Part *part, const Part *other)
{
    box_extend(&part->box, other->box.low, other->box.high);
    box_extend(&part->centers, other->centers.low, other->centers.high);
    part->count += other->count;
}

static int bin_of(const BoundsItem *item, const Box *centers, int axis)
{
    const Real low = centers->low[axis], high = centers->high[axis];
    const Real center = (item->box.low[axis] + item->box.high[axis]) / 2;
    /* No number, or infinite, where the box is too small or too large to be divided. */
    const Real share = (center - low) / (high - low);
    const int bin = share > 0 ? (int)(BINS * (share < 1 ? share : 1)) : 0;
    return bin < BINS ? bin : BINS - 1;
}

/* The cut between two bins that costs least, and the parts on its sides; 0 where nothing separates
 * the items. */
static int best_cut(const Part bins[BINS], Part parts[2])
{
    Real right[BINS + 1], best = INFINITY;
    Part part = no_part();
    int cut = 0;
    for (int i = BINS - 1; i > 0; i--) {
        if (bins[i].count > 0)
            add_part(&part, &bins[i]);
        right[i] = half_area(&part.box) * part.count;
    }
    const uint32_t count = part.count + bins[0].count;
    part = no_part();
    for (int i = 1; i < BINS; i++) {
        if (bins[i - 1].count == 0)
            continue; /* the same as one bin before */
        add_part(&part, &bins[i - 1]);
        const Real cost = half_area(&part.box) * part.count + right[i];
        if (part.count < count && cost < best) {
            best = cost;
            cut = i;
            parts[0] = part;
        }
    }
    parts[1] = no_part();
    for (int i = cut; i < BINS; i++)
        if (bins[i].count > 0)
            add_part(&parts[1], &bins[i]);
    return cut;
}

static void halve(const BoundsItem *items, const Part *whole, Part parts[2])
{
    parts[0] = parts[1] = no_part();
    for (uint32_t i = 0; i < whole->count; i++)
        add_item(&parts[i >= whole->count / 2], &items[i]);
}

/* Parts items in two, and puts those of the first part first. */
static void separate(BoundsItem *items, const Part *whole, int depth, Part parts[2])
{
    const Box *centers = &whole->centers;
    Part bins[BINS];
    int axis = 0, cut = 0;
    for (int k = 1; k < 3; k++)
        if (centers->high[k] - centers->low[k] > centers->high[axis] - centers->low[axis])
            axis = k;
    /* Items in one place, or a chain of lopsided cuts: any halves. */
    if (depth > SAH_DEPTH || !(centers->high[axis] > centers->low[axis])) {
        halve(items, whole, parts);
        return;
    }
    for (int i = 0; i < BINS; i++)
        bins[i].count = 0;
    for (uint32_t i = 0; i < whole->count; i++) {
        items[i].bin = bin_of(&items[i], centers, axis);
        Part *bin = &bins[items[i].bin];
        if (bin->count == 0)
            *bin = no_part();
        add_item(bin, &items[i]);
    }
    cut = best_cut(bins, parts);
    if (cut == 0) {
        halve(items, whole, parts);
        return;
    }
    for (uint32_t i = 0, below = 0; below < parts[0].count; i++) {
        if (items[i].bin < cut) {
            const BoundsItem item = items[i];
            items[i] = items[below];
            items[below++] = item;
        }
    }
}

/* A node to be made of the items from number `first` on, with nodes below it from number `next` on;
 * there are fewer than items. */
typedef struct Branch {
    BoundsNode *nodes;
    BoundsItem *items;
    uint32_t number, next, first;
    Part part;
    int depth, threads;
    const atomic_bool *stop;
    pthread_t thread;
} Branch;

/* The node's children: halves of halves, as long as they are no leaves. */
static void divide(const Branch *branch, Part parts[BOUNDS_WIDTH])
{
    int count = 1;
    parts[0] = branch->part;
    for (int level = 0; level < 2; level++) {
        Part halves[BOUNDS_WIDTH];
        BoundsItem *items = branch->items + branch->first;
        int made = 0;
        for (int i = 0; i < count; i++) {
            if (parts[i].count > LEAF) {
                separate(items, &parts[i], branch->depth + level, &halves[made]);
                made += 2;
            } else {
                halves[made++] = parts[i];
            }
            items += parts[i].count;
        }
        count = made;
        memcpy(parts, halves, (size_t)made * sizeof parts[0]);
    }
    while (count < BOUNDS_WIDTH)
        parts[count++] = no_part();
}

static void *build(void *argument)
{
    Branch *branch = argument, below[BOUNDS_WIDTH];
    BoundsNode *node = &branch->nodes[branch->number];
    const bool parallel = branch->threads > 1 && branch->part.count > STRIDE;
    uint32_t first = branch->first;
    int count = 0, running = 1;
    Part parts[BOUNDS_WIDTH];
    divide(branch, parts);
    for (int i = 0; i < BOUNDS_WIDTH; first += parts[i++].count) {
        for (int k = 0; k < 3; k++) {
            node->sides[0][k][i] = parts[i].box.low[k];
            node->sides[1][k][i] = parts[i].box.high[k];
        }
        node->children[i] = (BoundsChild){first, parts[i].count};
        if (parts[i].count <= LEAF || stop_asked(branch->stop))
            continue;
        Branch *child = &below[count++];
        *child = *branch;
        child->number = branch->next;
        child->next = branch->next + 1;
        child->first = first;
        child->part = parts[i];
        child->depth = branch->depth + 2;
        child->threads = (branch->threads + BOUNDS_WIDTH - 1) / BOUNDS_WIDTH;
        node->children[i] = (BoundsChild){child->number, 0};
        if (parallel) {
            branch->next += parts[i].count - 1;
        } else {
            build(child);
            branch->next = child->next;
        }
    }
    while (parallel && running < count &&
           pthread_create(&below[running].thread, NULL, build, &below[running]) == 0)
        running++;
    for (int i = 0; parallel && i < count; i++)
        if (i == 0 || i >= running)
            build(&below[i]);
    for (int i = 1; parallel && i < running && i < count; i++)
        pthread_join(below[i].thread, NULL);
    return NULL;
}

BoundsNode *bounds_build(BoundsItem *items, size_t count, int threads, const atomic_bool *stop)
{
    if (count > UINT32_MAX / 2)
        return NULL;
    Branch root = {.nodes = malloc((count + 1) * sizeof *root.nodes),
                   .items = items,
                   .next = 1,
                   .part = no_part(),
                   .threads = threads,
                   .stop = stop};
    for (size_t i = 0; i < count; i++)
        add_item(&root.part, &items[i]);
    if (root.nodes)
        build(&root);
    if (!stop_asked(stop))
        return root.nodes;
    free(root.nodes);
    return NULL;
}
