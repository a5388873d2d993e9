#include "reference/reference_triangles.h"

#include <stdlib.h>
#include <string.h>

/* Equal vertices. */

/* A chained hash table: for each vertex the next with the same place in the table. */
typedef struct Places {
    uint32_t *heads, *next;
    uint32_t mask;
} Places;

enum { NONE = TRIANGLES_NONE };

/* So many vertices or triangles are a few milliseconds' work. */
enum { STRIDE = 16384 };

static uint32_t hash_position(const float position[3])
{
    uint32_t hash = 2166136261U; /* FNV-1a, by words */
    for (int k = 0; k < 3; k++) {
        const float value = position[k] + 0.0F; /* -0 becomes 0 */
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 16777619U;
    }
    return hash ^ hash >> 15;
}

static bool equal_positions(const MeshVertex *a, const MeshVertex *b)
{
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] &&
           a->position[2] == b->position[2];
}

static bool equal_normals(const MeshVertex *a, const MeshVertex *b)
{
    return fabsf(a->normal[0] - b->normal[0]) <= 1e-3F &&
           fabsf(a->normal[1] - b->normal[1]) <= 1e-3F &&
           fabsf(a->normal[2] - b->normal[2]) <= 1e-3F;
}

/* Fills, for each vertex, the first that equals it, and the first in its place. */
static bool find_equal(const Mesh *mesh, uint32_t *equal, uint32_t *in_place,
                       const atomic_bool *stop)
{
    const MeshVertex *vertices = mesh->vertices;
    Places places = {NULL, NULL, 15};
    while (places.mask < mesh->vertex_count)
        places.mask = 2 * places.mask + 1;
    places.heads = malloc(((size_t)places.mask + 1) * sizeof *places.heads);
    places.next = malloc((mesh->vertex_count + 1) * sizeof *places.next);
    bool done = places.heads && places.next;
    if (done)
        memset(places.heads, 0xFF, ((size_t)places.mask + 1) * sizeof *places.heads);
    for (uint32_t i = 0; done && i < mesh->vertex_count; i++) {
        done = i % STRIDE != 0 || !stop_asked(stop);
        const uint32_t place = hash_position(vertices[i].position) & places.mask;
        uint32_t other = places.heads[place];
        equal[i] = in_place[i] = i;
        for (; other != NONE && equal[i] == i; other = places.next[other]) {
            if (!equal_positions(&vertices[i], &vertices[other]))
                continue;
            in_place[i] = in_place[other];
            if (equal_normals(&vertices[i], &vertices[other]))
                equal[i] = other;
        }
        if (equal[i] != i)
            continue;
        places.next[i] = places.heads[place];
        places.heads[place] = i;
    }
    free(places.heads);
    free(places.next);
    return done;
}

/* Pieces: union and find. (Tarjan, 1975; halving the paths) */
static uint32_t root_of(uint32_t *parents, uint32_t i)
{
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

static void unite(uint32_t *parents, uint32_t a, uint32_t b)
{
    a = root_of(parents, a);
    b = root_of(parents, b);
    parents[a > b ? a : b] = a > b ? b : a;
}

/* Boxes. By the surface area heuristic, estimated in bins. (Wald, On fast Construction of SAH-based
 * Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray Tracing, 2007) */

enum { BINS = 16, LEAF = 4, SAH_DEPTH = 40 };

typedef struct Box {
    Real low[3], high[3];
} Box;

/* A triangle while the hierarchy is built: moved as a whole, so that memory is read in order. */
typedef struct Item {
    Box box;
    uint32_t number; /* in the mesh */
} Item;

typedef struct Builder {
    BoundsNode *nodes;
    Item *items;
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

static Real center(const Item *item, int axis)
{
    return (item->box.low[axis] + item->box.high[axis]) / 2;
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
static bool best_cut(const Item *items, uint32_t count, const Box *centers, int axis, int *cut)
{
    Bin bins[BINS];
    Real right[BINS], best = INFINITY;
    Box box = empty_box();
    uint32_t below = 0, above = 0;
    for (int i = 0; i < BINS; i++)
        bins[i] = (Bin){empty_box(), 0};
    for (uint32_t i = 0; i < count; i++) {
        Bin *bin = &bins[bin_of(center(&items[i], axis), centers->low[axis], centers->high[axis])];
        bin->count++;
        extend(&bin->box, items[i].box.low, items[i].box.high);
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
static uint32_t separate(Item *items, uint32_t count, const Box *centers, int depth)
{
    int axis = 0, cut = 0;
    for (int k = 1; k < 3; k++)
        if (centers->high[k] - centers->low[k] > centers->high[axis] - centers->low[axis])
            axis = k;
    /* Items in one place, or a chain of lopsided cuts: any halves. */
    if (depth > SAH_DEPTH || !(centers->high[axis] > centers->low[axis]) ||
        !best_cut(items, count, centers, axis, &cut))
        return count / 2;
    uint32_t below = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (bin_of(center(&items[i], axis), centers->low[axis], centers->high[axis]) < cut) {
            const Item item = items[i];
            items[i] = items[below];
            items[below++] = item;
        }
    }
    return below;
}

static void build(Builder *builder, uint32_t number, uint32_t first, uint32_t count, int depth)
{
    BoundsNode *node = &builder->nodes[number];
    Item *items = builder->items + first;
    Box box = empty_box(), centers = empty_box();
    for (uint32_t i = 0; i < count; i++) {
        const Real c[3] = {center(&items[i], 0), center(&items[i], 1), center(&items[i], 2)};
        extend(&box, items[i].box.low, items[i].box.high);
        extend(&centers, c, c);
    }
    for (int k = 0; k < 3; k++) {
        node->low[k] = box.low[k];
        node->high[k] = box.high[k];
    }
    node->first = first;
    node->count = count;
    if (count <= LEAF || stop_asked(builder->stop))
        return;
    const uint32_t below = separate(items, count, &centers, depth);
    node->first = builder->node_count;
    node->count = 0;
    builder->node_count += 2;
    const uint32_t children = node->first;
    build(builder, children, first, below, depth + 1);
    build(builder, children + 1, first + below, count - below, depth + 1);
}

/* Builds it over items, and puts those of a leaf together. The nodes; NULL where memory runs out,
 * or it was stopped. */
static BoundsNode *bounds_build(Item *items, size_t count, const atomic_bool *stop)
{
    if (count > UINT32_MAX / 2)
        return NULL;
    Builder builder = {malloc((2 * count + 1) * sizeof *builder.nodes), items, 1, stop};
    if (builder.nodes && count > 0)
        build(&builder, 0, 0, (uint32_t)count, 0);
    if (!stop_asked(stop))
        return builder.nodes;
    free(builder.nodes);
    return NULL;
}

/* Triangles. */

static Real3 normal_of(const uint32_t *indices, const Real3 *points)
{
    const Real3 v0 = points[indices[0]];
    return real3_cross(real3_subtract(points[indices[1]], v0),
                       real3_subtract(points[indices[2]], v0));
}

static Triangle make_triangle(const uint32_t *indices, uint32_t number, const Real3 *points,
                              const uint32_t *equal, const uint32_t *in_place)
{
    Triangle triangle = {.number = number};
    const Real3 v0 = points[indices[0]], v1 = points[indices[1]], v2 = points[indices[2]];
    triangle.edges[0] = real3_cross(v1, v2);
    triangle.edges[1] = real3_cross(v2, v0);
    triangle.edges[2] = real3_cross(v0, v1);
    triangle.normal = normal_of(indices, points);
    triangle.offset = real3_dot(triangle.normal, v0);
    for (int k = 0; k < 3; k++) {
        triangle.corners[k] = equal[indices[k]];
        triangle.places[k] = in_place[indices[k]];
    }
    return triangle;
}

static Box box_of(const uint32_t *indices, const Real3 *points)
{
    Box box = empty_box();
    for (int k = 0; k < 3; k++) {
        const Real v[3] = {points[indices[k]].x, points[indices[k]].y, points[indices[k]].z};
        extend(&box, v, v);
    }
    return box;
}

static bool has_area(Real3 normal)
{
    return normal.x != 0 || normal.y != 0 || normal.z != 0;
}

/* What is needed while triangles are opened. */
typedef struct Work {
    uint32_t *equal, *in_place, *parents;
    Item *items;
    size_t count;
} Work;

/* The triangles that have an area, and what hangs together. */
static bool find_items(Work *work, const Mesh *mesh, const Real3 *points, const atomic_bool *stop)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        work->parents[i] = i;
    for (uint32_t i = 0; i < mesh->index_count / 3; i++) {
        if (i % STRIDE == 0 && stop_asked(stop))
            return false;
        const uint32_t *indices = mesh->indices + 3 * (size_t)i, *equal = work->equal;
        if (!has_area(normal_of(indices, points)))
            continue;
        unite(work->parents, equal[indices[0]], equal[indices[1]]);
        unite(work->parents, equal[indices[1]], equal[indices[2]]);
        work->items[work->count++] = (Item){box_of(indices, points), i};
    }
    return true;
}

static bool fill(Triangles *triangles, const Mesh *mesh, const Real3 *points, bool apart,
                 Work *work, const atomic_bool *stop)
{
    if (!work->equal || !work->parents || !work->in_place || !work->items ||
        !find_equal(mesh, work->equal, work->in_place, stop) ||
        !find_items(work, mesh, points, stop))
        return false;
    triangles->count = work->count;
    triangles->nodes = bounds_build(work->items, work->count, stop);
    triangles->triangles = malloc((work->count + 1) * sizeof *triangles->triangles);
    if (!triangles->nodes || !triangles->triangles)
        return false;
    for (size_t i = 0; i < work->count; i++) {
        Triangle *triangle = &triangles->triangles[i];
        const uint32_t number = work->items[i].number;
        *triangle = make_triangle(mesh->indices + 3 * (size_t)number, number, points, work->equal,
                                  work->in_place);
        triangle->piece = apart ? number : root_of(work->parents, triangle->corners[0]);
    }
    return true;
}

bool triangles_open(Triangles *triangles, const Mesh *mesh, const Real3 *points, bool apart,
                    const atomic_bool *stop)
{
    Work work = {malloc((mesh->vertex_count + 1) * sizeof *work.equal),
                 malloc((mesh->vertex_count + 1) * sizeof *work.in_place),
                 malloc((mesh->vertex_count + 1) * sizeof *work.parents),
                 malloc((mesh->index_count / 3 + 1) * sizeof *work.items), 0};
    *triangles = (Triangles){.triangles = NULL};
    const bool done = fill(triangles, mesh, points, apart, &work, stop);
    free(work.equal);
    free(work.in_place);
    free(work.parents);
    free(work.items);
    if (!done)
        triangles_close(triangles);
    return done;
}

void triangles_close(Triangles *triangles)
{
    free(triangles->triangles);
    free(triangles->nodes);
    *triangles = (Triangles){.triangles = NULL};
}

/* Rays. */

/* The ray lies on one side of all three planes through the eye and an edge. Two triangles compute
 * the same plane for the edge that they share, but for its sign, so that no ray slips between them.
 * (Shoemake, Pluecker Coordinate Tutorial, Ray Tracing News 11(1), 1998) */
static bool meet(const Triangle *triangle, Real3 direction, Real near, Real far, TriangleHit *hit,
                 uint32_t number)
{
    const Real a = real3_dot(direction, triangle->edges[0]);
    const Real b = real3_dot(direction, triangle->edges[1]);
    const Real c = real3_dot(direction, triangle->edges[2]);
    if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)))
        return false;
    const Real sum = a + b + c, slope = real3_dot(direction, triangle->normal);
    if (sum == 0 || slope == 0)
        return false;
    const Real t = triangle->offset / slope;
    if (!(t >= near && t <= far) || t > hit->t)
        return false;
    if (t == hit->t && (number == NONE || triangle->number > number))
        return false; /* the first object, and the first triangle, keeps what is equally near */
    hit->t = t;
    hit->weights[0] = a / sum;
    hit->weights[1] = b / sum;
    hit->weights[2] = c / sum;
    return true;
}

/* Where the ray enters a box, or INFINITY; a little early, so that rounding loses nothing.
 * `inverse` has 1 over each component of the direction; where that is 0 it is infinite, and its
 * product with a side at 0 is not a number, which has no effect: it is first in the comparison. */
static inline Real enter(const BoundsNode *node, const Real inverse[3], Real near, Real far)
{
    Real from = near, to = far;
    for (int k = 0; k < 3; k++) {
        const bool up = inverse[k] > 0;
        const Real one = (up ? node->low : node->high)[k] * inverse[k];
        const Real other = (up ? node->high : node->low)[k] * inverse[k];
        from = real_max(one, from);
        to = real_min(other, to);
    }
    return from * (1 - 8 * REAL_EPSILON) <= to ? from * (1 - 8 * REAL_EPSILON) : INFINITY;
}

bool triangles_ray(const Triangles *triangles, Real3 direction, Real near, Real far,
                   TriangleHit *hit)
{
    const Real inverse[3] = {1 / direction.x, 1 / direction.y, 1 / direction.z};
    const BoundsNode *nodes = triangles->nodes;
    uint32_t stack[BOUNDS_MAX_DEPTH];
    uint32_t number = NONE; /* of the triangle that is hit */
    int depth = 0;
    if (triangles->count > 0 && enter(&nodes[0], inverse, near, far) < INFINITY)
        stack[depth++] = 0;
    while (depth > 0) {
        const BoundsNode *node = &nodes[stack[--depth]];
        if (node->count == 0) {
            const uint32_t left = node->first, right = left + 1;
            const Real limit = real_min(far, hit->t);
            const Real to_left = enter(&nodes[left], inverse, near, limit);
            const Real to_right = enter(&nodes[right], inverse, near, limit);
            const bool left_first = to_left <= to_right;
            if (real_max(to_left, to_right) < INFINITY)
                stack[depth++] = left_first ? right : left;
            if (real_min(to_left, to_right) < INFINITY)
                stack[depth++] = left_first ? left : right;
            continue;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            if (meet(&triangles->triangles[i], direction, near, far, hit, number)) {
                number = triangles->triangles[i].number;
                hit->index = i;
            }
        }
    }
    return number != NONE;
}

/* As in `meet`, with the planes through the segment's beginning: the differences of the positions,
 * and so the planes, are the same for both triangles at an edge. */
static bool crosses(const Triangle *triangle, const TriangleSegment *segment)
{
    const uint32_t *indices = segment->indices + 3 * (size_t)triangle->number;
    const Real3 v0 = segment->points[indices[0]], way = segment->way;
    const Real3 a = real3_subtract(v0, segment->from);
    const Real3 b = real3_subtract(segment->points[indices[1]], segment->from);
    const Real3 c = real3_subtract(segment->points[indices[2]], segment->from);
    const Real bc = real3_dot(way, real3_cross(b, c)), ca = real3_dot(way, real3_cross(c, a));
    if ((bc > 0 && ca < 0) || (bc < 0 && ca > 0))
        return false;
    const Real ab = real3_dot(way, real3_cross(a, b));
    if (!((bc >= 0 && ca >= 0 && ab >= 0) || (bc <= 0 && ca <= 0 && ab <= 0)))
        return false;
    /* Heights of the ends over the plane, times the normal's length. */
    const Real height = real3_dot(triangle->normal, a), slope = real3_dot(triangle->normal, way);
    const Real t = height / slope;
    if (slope == 0 || !(t > 0) || !(segment->endless || t < 1))
        return false;
    const Real length = real3_length(triangle->normal);
    const Real more = 32 * REAL_EPSILON * real3_reach(v0);
    return real_abs(height) > (segment->error + more) * length &&
           (segment->endless || real_abs(height - slope) > (segment->light_error + more) * length);
}

/* Whether a segment meets a box; also if it misses it by rounding. `inverse` is infinite where the
 * way has no component; on a side of the box the product is then NaN, which says nothing: such a
 * comparison is false, and what is first in real_max and real_min has no effect. */
static inline bool passes(const BoundsNode *node, const Real from[3], const Real inverse[3],
                          Real end)
{
    Real enters = 0, leaves = end;
    for (int k = 0; k < 3; k++) {
        const bool up = inverse[k] > 0;
        const Real one = ((up ? node->low : node->high)[k] - from[k]) * inverse[k];
        const Real other = ((up ? node->high : node->low)[k] - from[k]) * inverse[k];
        enters = real_max(one, enters);
        leaves = real_min(other, leaves);
    }
    return enters <= leaves * (1 + 8 * REAL_EPSILON);
}

bool triangles_block(const Triangles *triangles, const TriangleSegment *segment)
{
    const Real from[3] = {segment->from.x, segment->from.y, segment->from.z};
    const Real inverse[3] = {1 / segment->way.x, 1 / segment->way.y, 1 / segment->way.z};
    const Real end = segment->endless ? INFINITY : 1;
    const BoundsNode *nodes = triangles->nodes;
    uint32_t stack[BOUNDS_MAX_DEPTH];
    int depth = 0;
    if (triangles->count > 0 && passes(&nodes[0], from, inverse, end))
        stack[depth++] = 0;
    while (depth > 0) {
        const BoundsNode *node = &nodes[stack[--depth]];
        if (node->count == 0) {
            for (uint32_t child = node->first; child < node->first + 2; child++)
                if (passes(&nodes[child], from, inverse, end))
                    stack[depth++] = child;
            continue;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++)
            if (i != segment->own && crosses(&triangles->triangles[i], segment))
                return true;
    }
    return false;
}

TrianglesShare triangles_share(const Triangle *a, const Triangle *b)
{
    TrianglesShare share = {0, 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            share.corners += a->corners[i] == b->corners[j];
            share.places += a->places[i] == b->places[j];
        }
    return share;
}
