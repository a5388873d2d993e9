/*
 * Polygons are cut at ears: corners whose triangle holds no other corner (Meisters, Polygons have
 * ears, 1975). A cut changes that for its two neighbours only, so that each corner is tried three
 * times on average; and only corners that do not point outwards can be in the way (O'Rourke,
 * Computational geometry in C, 1998, 1.5). These are searched in a tree of boxes around corners in
 * the order of a space-filling curve (Lauterbach et al., Fast BVH construction on GPUs, 2009).
 */
#include "scene/polygon.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { GONE = -1 };

typedef struct Corner {
    double x, y; /* in its plane, where the polygon turns left */
    int previous, next;
    int round; /* in which its neighbour was cut, or GONE */
    int leaf;
    bool inward; /* it does not point outwards */
} Corner;

typedef struct Box {
    double low[2], high[2];
    int inward; /* corners */
} Box;

typedef struct Cut {
    Corner *corners;
    Box *boxes; /* a binary tree: 1 holds 2 and 3, 2 holds 4 and 5...; NULL: all point outwards */
    int leaves, count, left; /* corners that are not cut off */
    int *triangles;          /* the next one */
    int *later, later_count; /* corners to be tried in the next round */
} Cut;

/* How far left of the line from a to b. */
static double left_of(const Corner *a, const Corner *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static bool is_outside(const Box *box, const Corner *a, const Corner *b)
{
    return !(left_of(a, b, b->y > a->y ? box->low[0] : box->high[0],
                     b->x > a->x ? box->high[1] : box->low[1]) > 0);
}

/* Whether a corner that points inwards is within a triangle, not at its border. */
static bool holds_any(const Cut *cut, int box, const Corner *const t[3])
{
    const Box *here = &cut->boxes[box];
    if (!here->inward || is_outside(here, t[0], t[1]) || is_outside(here, t[1], t[2]) ||
        is_outside(here, t[2], t[0]))
        return false;
    return box >= cut->leaves || holds_any(cut, 2 * box, t) || holds_any(cut, 2 * box + 1, t);
}

static bool points_inward(const Cut *cut, int i)
{
    const Corner *all = cut->corners, *at = &all[i];
    return !(left_of(&all[at->previous], at, all[at->next].x, all[at->next].y) > 0);
}

static void turn(Cut *cut, int i, bool inward)
{
    Corner *corner = &cut->corners[i];
    const int change = inward - corner->inward;
    corner->inward = inward;
    for (int box = corner->leaf; cut->boxes && change != 0 && box > 0; box /= 2)
        cut->boxes[box].inward += change;
}

static bool is_ear(const Cut *cut, int i)
{
    const Corner *all = cut->corners, *at = &all[i];
    const Corner *const triangle[3] = {&all[at->previous], at, &all[at->next]};
    return !at->inward && !(cut->boxes && holds_any(cut, 1, triangle));
}

/* The tree of boxes */

typedef struct Place {
    uint64_t code; /* along the curve */
    int corner;
} Place;

static int by_code(const void *a, const void *b)
{
    const uint64_t x = ((const Place *)a)->code, y = ((const Place *)b)->code;
    return (x > y) - (x < y);
}

/* The bits of both, by turns (Morton, A computer oriented geodetic data base, 1966). Within 0 to 1;
 * NaN, of corners that are refused later, is 0. */
static uint64_t curve(double x, double y)
{
    const uint64_t a = (uint64_t)(fmin(fmax(x, 0), 1) * 4294967295.0),
                   b = (uint64_t)(fmin(fmax(y, 0), 1) * 4294967295.0);
    uint64_t code = 0;
    for (int bit = 31; bit >= 0; bit--)
        code = code << 2 | (a >> bit & 1) << 1 | (b >> bit & 1);
    return code;
}

static void join(Box *box, const Box *other)
{
    for (int k = 0; k < 2; k++) {
        box->low[k] = fmin(box->low[k], other->low[k]);
        box->high[k] = fmax(box->high[k], other->high[k]);
    }
    box->inward += other->inward;
}

static void make_boxes(Cut *cut)
{
    static const Box EMPTY = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0};
    Place *places = memory_new((size_t)cut->count, sizeof *places);
    Box all = EMPTY;
    for (int i = 0; i < cut->count; i++) {
        const Corner *c = &cut->corners[i];
        join(&all, &(Box){{c->x, c->y}, {c->x, c->y}, 0});
    }
    const double size = fmax(fmax(all.high[0] - all.low[0], all.high[1] - all.low[1]), 1e-300);
    for (int i = 0; i < cut->count; i++)
        places[i] = (Place){
            curve((cut->corners[i].x - all.low[0]) / size, (cut->corners[i].y - all.low[1]) / size),
            i};
    qsort(places, (size_t)cut->count, sizeof *places, by_code);
    for (cut->leaves = 1; cut->leaves < cut->count;)
        cut->leaves *= 2;
    cut->boxes = memory_new(2 * (size_t)cut->leaves, sizeof *cut->boxes);
    for (int box = 2 * cut->leaves - 1; box > 0; box--) {
        const int i = box - cut->leaves;
        Corner *c = i >= 0 && i < cut->count ? &cut->corners[places[i].corner] : NULL;
        cut->boxes[box] = c ? (Box){{c->x, c->y}, {c->x, c->y}, c->inward} : EMPTY;
        if (c)
            c->leaf = box;
        for (int k = 0; k < 2 && i < 0; k++)
            join(&cut->boxes[box], &cut->boxes[2 * box + k]);
    }
    free(places);
}

/* Flat: without the axis that its normal, Newell's, is closest to. */
static void flatten(Cut *cut, const Vec3 *corners)
{
    Vec3 normal = {0, 0, 0};
    for (int i = 1; i + 1 < cut->count; i++)
        normal = vec3_add(normal, vec3_cross(vec3_subtract(corners[i], corners[0]),
                                             vec3_subtract(corners[i + 1], corners[0])));
    const double n[3] = {normal.x, normal.y, normal.z};
    const int larger = fabs(n[1]) > fabs(n[0]) ? 1 : 0,
              axis = fabs(n[2]) < fabs(n[larger]) ? larger : 2;
    const int x = (axis + (n[axis] < 0 ? 2 : 1)) % 3, y = (axis + (n[axis] < 0 ? 1 : 2)) % 3;
    bool inward = false;
    for (int i = 0; i < cut->count; i++) {
        const double v[3] = {corners[i].x, corners[i].y, corners[i].z};
        cut->corners[i] = (Corner){.x = v[x],
                                   .y = v[y],
                                   .previous = (i + cut->count - 1) % cut->count,
                                   .next = (i + 1) % cut->count};
    }
    for (int i = 0; i < cut->count; i++)
        inward |= cut->corners[i].inward = points_inward(cut, i);
    if (inward && cut->count > 3)
        make_boxes(cut);
}

/* Cuts a corner off, and lists its neighbours to be tried later. */
static void cut_off(Cut *cut, int i, int round)
{
    Corner *at = &cut->corners[i];
    const int ends[2] = {at->previous, at->next};
    cut->triangles[0] = ends[0];
    cut->triangles[1] = i;
    cut->triangles[2] = ends[1];
    cut->triangles += 3;
    cut->corners[ends[0]].next = ends[1];
    cut->corners[ends[1]].previous = ends[0];
    turn(cut, i, false);
    at->round = GONE;
    for (int k = 0; k < 2; k++) {
        turn(cut, ends[k], points_inward(cut, ends[k]));
        if (cut->corners[ends[k]].round != round)
            cut->later[cut->later_count++] = ends[k];
        cut->corners[ends[k]].round = round;
    }
    cut->left--;
}

/* In rounds: a corner whose neighbour was cut is tried in the next one, so that triangles are not
 * slivers from one corner. */
static void polygon_cut(const Vec3 *corners, int count, int *triangles)
{
    Cut cut = {.count = count, .left = count, .triangles = triangles};
    int *lists = memory_new(2 * (size_t)count, sizeof *lists), *now = lists, now_count = count;
    cut.corners = memory_new((size_t)count, sizeof *cut.corners);
    flatten(&cut, corners);
    for (int i = 0; i < count; i++)
        now[i] = (i + 1) % count;
    cut.later = lists + count;
    int last = 0;
    for (int round = 1; cut.left > 3; round++) {
        for (int i = 0; i < now_count && cut.left > 3; i++)
            if (cut.corners[now[i]].round != GONE && cut.corners[now[i]].round != round &&
                is_ear(&cut, now[i])) {
                last = cut.corners[now[i]].previous;
                cut_off(&cut, now[i], round);
            }
        if (cut.later_count == 0) { /* it crosses itself, or has no area */
            const int next = cut.corners[last].next;
            cut_off(&cut, last, round);
            last = next;
        }
        int *const tried = now;
        now = cut.later;
        now_count = cut.later_count;
        cut.later = tried;
        cut.later_count = 0;
    }
    cut.triangles[0] = last;
    cut.triangles[1] = cut.corners[last].next;
    cut.triangles[2] = cut.corners[last].previous;
    free(lists);
    free(cut.corners);
    free(cut.boxes);
}

void polygon_add(TriangleList *list, const uint32_t *vertices, int count, PolygonPlace *place,
                 const void *of)
{
    int only[3] = {0, 1, 2}, *triangles = only;
    if (count > 3) {
        Vec3 *places = memory_new((size_t)count, sizeof *places);
        triangles = memory_new(3 * (size_t)count, sizeof *triangles);
        for (int i = 0; i < count; i++)
            places[i] = place(of, vertices[i]);
        polygon_cut(places, count, triangles);
        free(places);
    }
    for (int i = 0; i < 3 * (count - 2); i++)
        *(uint32_t *)memory_add(&list->corners, &list->count, &list->room, sizeof *list->corners) =
            vertices[triangles[i]];
    if (triangles != only)
        free(triangles);
}
