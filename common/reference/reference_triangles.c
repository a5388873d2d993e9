/*
 * A ray from the eye is inside a triangle if it lies on one side of the three planes through the
 * eye and an edge. Neighbours compute the plane of their common edge from the same numbers, but for
 * its sign, so no ray slips between them; a segment to a light does the same with the planes
 * through its beginning. Which triangles are asked a hierarchy of boxes tells (reference_bounds.h):
 * some 30 of 262,000.
 *
 * Which triangles hang together is found by union and find over equal vertices: equal in position,
 * by a hash table, and in the normal but for rounding. The boxes and the pieces are found at the
 * same time by two threads.
 */
#include "reference/reference_triangles.h"

#include <pthread.h>
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

/* Triangles. */

static Real3 normal_of(const uint32_t *indices, const Real3 *points)
{
    const Real3 v0 = points[indices[0]];
    return real3_cross(real3_subtract(points[indices[1]], v0),
                       real3_subtract(points[indices[2]], v0));
}

static Box box_of(const uint32_t *indices, const Real3 *points)
{
    Box box = box_empty();
    for (int k = 0; k < 3; k++) {
        const Real v[3] = {points[indices[k]].x, points[indices[k]].y, points[indices[k]].z};
        box_extend(&box, v, v);
    }
    return box;
}

static bool has_area(Real3 normal)
{
    return normal.x != 0 || normal.y != 0 || normal.z != 0;
}

/* What is needed while triangles are opened. */
typedef struct Work {
    Triangles *triangles;
    const Mesh *mesh;
    const Real3 *points;
    uint32_t *parents;
    BoundsItem *items;
    const atomic_bool *stop;
} Work;

/* Finds what is equal, and what hangs together. */
static void *find_pieces(void *argument)
{
    const Work *work = argument;
    const Mesh *mesh = work->mesh;
    const uint32_t *equal = work->triangles->equal;
    if (!find_equal(mesh, work->triangles->equal, work->triangles->in_place, work->stop))
        return NULL;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        work->parents[i] = i;
    for (uint32_t i = 0; i < mesh->index_count / 3; i++) {
        const uint32_t *indices = mesh->indices + 3 * (size_t)i;
        if (i % STRIDE == 0 && stop_asked(work->stop))
            return NULL;
        if (!has_area(normal_of(indices, work->points)))
            continue;
        unite(work->parents, equal[indices[0]], equal[indices[1]]);
        unite(work->parents, equal[indices[1]], equal[indices[2]]);
    }
    return argument;
}

/* Boxes of the triangles that have an area, and a hierarchy of them. */
static bool find_boxes(const Work *work, int threads)
{
    Triangles *triangles = work->triangles;
    for (uint32_t i = 0; i < work->mesh->index_count / 3; i++) {
        const uint32_t *indices = work->mesh->indices + 3 * (size_t)i;
        if (has_area(normal_of(indices, work->points)))
            work->items[triangles->count++] = (BoundsItem){box_of(indices, work->points), i, 0};
    }
    triangles->nodes = bounds_build(work->items, triangles->count, threads, work->stop);
    triangles->triangles = malloc((triangles->count + 1) * sizeof *triangles->triangles);
    return triangles->nodes && triangles->triangles;
}

static bool fill(Work *work, bool apart, int threads)
{
    Triangles *triangles = work->triangles;
    const Real3 *points = work->points;
    pthread_t thread;
    void *pieces = NULL;
    if (!triangles->equal || !triangles->in_place || !work->parents || !work->items)
        return false;
    const bool parallel = threads > 1 && work->mesh->index_count > STRIDE &&
                          pthread_create(&thread, NULL, find_pieces, work) == 0;
    const bool found = find_boxes(work, threads);
    if (parallel)
        pthread_join(thread, &pieces);
    else if (found)
        pieces = find_pieces(work);
    if (!found || !pieces)
        return false;
    for (size_t i = 0; i < triangles->count; i++) {
        const uint32_t number = work->items[i].number;
        const uint32_t *indices = work->mesh->indices + 3 * (size_t)number;
        triangles->triangles[i] = (Triangle){
            .corners = {points[indices[0]], points[indices[1]], points[indices[2]]},
            .number = number,
            .piece = apart ? number : root_of(work->parents, triangles->equal[indices[0]])};
    }
    return true;
}

bool triangles_open(Triangles *triangles, const Mesh *mesh, const Real3 *points, bool apart,
                    int threads, const atomic_bool *stop)
{
    const size_t vertex_count = mesh->vertex_count + 1;
    *triangles = (Triangles){.indices = mesh->indices,
                             .equal = malloc(vertex_count * sizeof *triangles->equal),
                             .in_place = malloc(vertex_count * sizeof *triangles->in_place)};
    Work work = {.triangles = triangles,
                 .mesh = mesh,
                 .points = points,
                 .parents = malloc(vertex_count * sizeof *work.parents),
                 .items = malloc((mesh->index_count / 3 + 1) * sizeof *work.items),
                 .stop = stop};
    const bool done = fill(&work, apart, threads);
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
    free(triangles->equal);
    free(triangles->in_place);
    *triangles = (Triangles){.triangles = NULL};
}

/* Rays. */

/* The ray lies on one side of all three planes through the eye and an edge. Two triangles compute
 * the same plane for the edge that they share, but for its sign, so that no ray slips between them.
 * (Shoemake, Pluecker Coordinate Tutorial, Ray Tracing News 11(1), 1998) */
static bool meet(const Triangle *triangle, Real3 direction, Real near, Real far, TriangleHit *hit,
                 uint32_t number)
{
    const Real3 *v = triangle->corners;
    const Real a = real3_dot(direction, real3_cross(v[1], v[2]));
    const Real b = real3_dot(direction, real3_cross(v[2], v[0]));
    if ((a > 0 && b < 0) || (a < 0 && b > 0))
        return false;
    const Real c = real3_dot(direction, real3_cross(v[0], v[1]));
    if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)))
        return false;
    const Real3 normal = triangle_normal(triangle);
    const Real sum = a + b + c, slope = real3_dot(direction, normal);
    if (sum == 0 || slope == 0)
        return false;
    const Real t = real3_dot(normal, v[0]) / slope;
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

/* A line, to meet the boxes of a node. `inverse` has 1 over each component of its direction:
 * infinite where that is 0; its product with a side at 0 is then NaN, which has no effect, because
 * it is first in the comparisons. */
typedef struct Line {
    Real2 from[3], inverse[3];
    int enters[3]; /* through the low or the high sides */
} Line;

static inline Line line_along(Real3 from, Real3 way)
{
    const Real3 inverse = {1 / way.x, 1 / way.y, 1 / way.z};
    return (Line){{real2(from.x), real2(from.y), real2(from.z)},
                  {real2(inverse.x), real2(inverse.y), real2(inverse.z)},
                  {!(inverse.x > 0), !(inverse.y > 0), !(inverse.z > 0)}};
}

/* What is infinite or NaN would meet the boxes of children that are not there. */
static inline bool is_finite(Real3 a)
{
    return 0 * a.x + 0 * a.y + 0 * a.z == 0;
}

/* What of a line, between `from` and `to`, lies in two boxes. */
typedef struct Spans {
    Real2 from, to;
} Spans;

static inline void cut(const BoundsNode *node, const Line *line, int axis, int child, Spans *spans)
{
    const Real2 one = real2_load(&node->sides[line->enters[axis]][axis][child]);
    const Real2 other = real2_load(&node->sides[!line->enters[axis]][axis][child]);
    const Real2 from = line->from[axis], inverse = line->inverse[axis];
    spans->from = real2_max(real2_multiply(real2_subtract(one, from), inverse), spans->from);
    spans->to = real2_min(real2_multiply(real2_subtract(other, from), inverse), spans->to);
}

/* The same in the boxes of children number `child` and `child` + 1. */
static inline Spans spans_in(const BoundsNode *node, const Line *line, int child, Real from,
                             Real to)
{
    Spans spans = {real2(from), real2(to)};
    cut(node, line, 0, child, &spans);
    cut(node, line, 1, child, &spans);
    cut(node, line, 2, child, &spans);
    return spans;
}

typedef struct Waiting {
    BoundsChild child;
    Real enters;
} Waiting;

/* Puts the children that a line meets on a stack, the nearest last. */
static inline int push_met(const BoundsNode *node, const Line *line, Real near, Real far,
                           Waiting *stack)
{
    Real enters[BOUNDS_WIDTH];
    int met = 0, count = 0;
    for (int i = 0; i < BOUNDS_WIDTH; i += 2) {
        /* A little early, so that rounding loses nothing. */
        const Spans spans = spans_in(node, line, i, near, far);
        const Real2 from = real2_multiply(spans.from, real2(1 - 8 * REAL_EPSILON));
        real2_store(&enters[i], from);
        met |= real2_at_most(from, spans.to) << i;
    }
    for (int i = 0; i < BOUNDS_WIDTH; i++) {
        if (!(met >> i & 1))
            continue;
        int k = count++;
        for (; k > 0 && stack[k - 1].enters < enters[i]; k--)
            stack[k] = stack[k - 1];
        stack[k] = (Waiting){node->children[i], enters[i]};
    }
    return count;
}

bool triangles_ray(const Triangles *triangles, Real3 direction, Real near, Real far,
                   TriangleHit *hit)
{
    const Line line = line_along((Real3){0, 0, 0}, direction);
    Waiting stack[BOUNDS_STACK];
    if (!is_finite(direction))
        return false;
    uint32_t number = NONE; /* of the triangle that is hit */
    int depth = 1;
    stack[0] = (Waiting){{0, 0}, near};
    while (depth > 0) {
        const BoundsChild child = stack[--depth].child;
        if (stack[depth].enters > hit->t)
            continue;
        if (child.count == 0)
            depth += push_met(&triangles->nodes[child.first], &line, near, real_min(far, hit->t),
                              &stack[depth]);
        for (uint32_t i = child.first; i < child.first + child.count; i++) {
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
    const Real3 *v = triangle->corners, way = segment->way;
    const Real3 a = real3_subtract(v[0], segment->from);
    const Real3 b = real3_subtract(v[1], segment->from);
    const Real3 c = real3_subtract(v[2], segment->from);
    const Real bc = real3_dot(way, real3_cross(b, c)), ca = real3_dot(way, real3_cross(c, a));
    if ((bc > 0 && ca < 0) || (bc < 0 && ca > 0))
        return false;
    const Real ab = real3_dot(way, real3_cross(a, b));
    if (!((bc >= 0 && ca >= 0 && ab >= 0) || (bc <= 0 && ca <= 0 && ab <= 0)))
        return false;
    /* Heights of the ends over the plane, times the normal's length. */
    const Real3 normal = triangle_normal(triangle);
    const Real height = real3_dot(normal, a), slope = real3_dot(normal, way);
    const Real t = height / slope;
    if (slope == 0 || !(t > 0) || !(segment->endless || t < 1))
        return false;
    const Real length = real3_length(normal);
    const Real more = 32 * REAL_EPSILON * real3_reach(v[0]);
    return real_abs(height) > (segment->error + more) * length &&
           (segment->endless || real_abs(height - slope) > (segment->light_error + more) * length);
}

/* Which children of a node a segment meets, a bit each; also if it misses them by rounding. */
static inline int children_met(const BoundsNode *node, const Line *line, Real end)
{
    const Real2 more = real2(1 + 8 * REAL_EPSILON);
    const Spans one = spans_in(node, line, 0, 0, end), other = spans_in(node, line, 2, 0, end);
    return real2_at_most(one.from, real2_multiply(one.to, more)) |
           real2_at_most(other.from, real2_multiply(other.to, more)) << 2;
}

/* Any order gives the same answer: each step of `cut` is monotonic, also when rounded, so that
 * whoever meets a leaf's box meets the boxes around it. */
bool triangles_block(const Triangles *triangles, const TriangleSegment *segment)
{
    const Line line = line_along(segment->from, segment->way);
    const Real end = segment->endless ? INFINITY : 1;
    uint32_t stack[BOUNDS_STACK];
    int depth = 1;
    if (!is_finite(segment->from) || !is_finite(segment->way))
        return false;
    stack[0] = 0;
    while (depth > 0) {
        const BoundsNode *node = &triangles->nodes[stack[--depth]];
        const BoundsChild *child = node->children;
        for (int met = children_met(node, &line, end); met != 0; met >>= 1, child++) {
            if (!(met & 1))
                continue;
            if (child->count == 0)
                stack[depth++] = child->first;
            for (uint32_t i = child->first; i < child->first + child->count; i++)
                if (i != segment->own && crosses(&triangles->triangles[i], segment))
                    return true;
        }
    }
    return false;
}

TrianglesShare triangles_share(const Triangles *triangles, uint32_t a, uint32_t b)
{
    const uint32_t *one = triangles->indices + 3 * (size_t)triangles->triangles[a].number;
    const uint32_t *other = triangles->indices + 3 * (size_t)triangles->triangles[b].number;
    TrianglesShare share = {0, 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            share.corners += triangles->equal[one[i]] == triangles->equal[other[j]];
            share.places += triangles->in_place[one[i]] == triangles->in_place[other[j]];
        }
    return share;
}
