#include "reference/reference_triangles.h"

#include <stdlib.h>
#include <string.h>

/* Equal vertices. */

/* A chained hash table: for each vertex the next with the same place in the table. */
typedef struct Places {
    uint32_t *heads, *next;
    uint32_t mask;
} Places;

enum { NONE = 0xFFFFFFFF };

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

static Triangle make_triangle(const uint32_t *indices, uint32_t number, const Real3 *points,
                              const uint32_t *equal, const uint32_t *in_place)
{
    Triangle triangle = {.number = number};
    const Real3 v0 = points[indices[0]], v1 = points[indices[1]], v2 = points[indices[2]];
    triangle.edges[0] = real3_cross(v1, v2);
    triangle.edges[1] = real3_cross(v2, v0);
    triangle.edges[2] = real3_cross(v0, v1);
    triangle.normal = real3_cross(real3_subtract(v1, v0), real3_subtract(v2, v0));
    triangle.offset = real3_dot(triangle.normal, v0);
    for (int k = 0; k < 3; k++) {
        triangle.corners[k] = equal[indices[k]];
        triangle.places[k] = in_place[indices[k]];
    }
    return triangle;
}

static void set_box(Real box[2][3], const uint32_t *indices, const Real3 *points)
{
    for (int k = 0; k < 3; k++) {
        const Real v[3] = {points[indices[k]].x, points[indices[k]].y, points[indices[k]].z};
        for (int axis = 0; axis < 3; axis++) {
            box[0][axis] = k == 0 ? v[axis] : real_min(box[0][axis], v[axis]);
            box[1][axis] = k == 0 ? v[axis] : real_max(box[1][axis], v[axis]);
        }
    }
}

static bool has_area(Real3 normal)
{
    return normal.x != 0 || normal.y != 0 || normal.z != 0;
}

/* What is needed while triangles are opened. */
typedef struct Work {
    uint32_t *equal, *in_place, *parents;
    Triangle *unordered;
    Real (*boxes)[2][3];
} Work;

static bool fill(Triangles *triangles, const Mesh *mesh, const Real3 *points, bool apart,
                 const Work *work, const atomic_bool *stop)
{
    const size_t max = mesh->index_count / 3;
    if (!work->equal || !work->parents || !work->in_place || !work->unordered || !work->boxes ||
        !triangles->triangles || !find_equal(mesh, work->equal, work->in_place, stop))
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        work->parents[i] = i;
    for (uint32_t i = 0; i < max; i++) {
        if (i % STRIDE == 0 && stop_asked(stop))
            return false;
        const uint32_t *indices = mesh->indices + 3 * (size_t)i;
        const Triangle triangle = make_triangle(indices, i, points, work->equal, work->in_place);
        if (!has_area(triangle.normal))
            continue;
        unite(work->parents, triangle.corners[0], triangle.corners[1]);
        unite(work->parents, triangle.corners[1], triangle.corners[2]);
        set_box(work->boxes[triangles->count], indices, points);
        work->unordered[triangles->count++] = triangle;
    }
    if (!bounds_build(&triangles->bounds, (const Real(*)[2][3])work->boxes, triangles->count, stop))
        return false;
    for (size_t i = 0; i < triangles->count; i++) {
        Triangle *triangle = &triangles->triangles[i];
        *triangle = work->unordered[triangles->bounds.order[i]];
        triangle->piece = apart ? triangle->number : root_of(work->parents, triangle->corners[0]);
    }
    return true;
}

bool triangles_open(Triangles *triangles, const Mesh *mesh, const Real3 *points, bool apart,
                    const atomic_bool *stop)
{
    const size_t max = mesh->index_count / 3;
    const Work work = {malloc((mesh->vertex_count + 1) * sizeof *work.equal),
                       malloc((mesh->vertex_count + 1) * sizeof *work.in_place),
                       malloc((mesh->vertex_count + 1) * sizeof *work.parents),
                       malloc((max + 1) * sizeof *work.unordered),
                       malloc((max + 1) * sizeof *work.boxes)};
    *triangles = (Triangles){.triangles = malloc((max + 1) * sizeof *triangles->triangles)};
    const bool done = fill(triangles, mesh, points, apart, &work, stop);
    free(work.equal);
    free(work.parents);
    free(work.in_place);
    free(work.unordered);
    free(work.boxes);
    if (!done)
        triangles_close(triangles);
    return done;
}

void triangles_close(Triangles *triangles)
{
    free(triangles->triangles);
    bounds_close(&triangles->bounds);
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
 * `inverse` has 1 over each component of the direction, and 0 where that is 0. */
static Real enter(const BoundsNode *node, const Real inverse[3], Real near, Real far)
{
    Real from = near, to = far;
    for (int k = 0; k < 3; k++) {
        if (inverse[k] == 0) {
            if (node->low[k] > 0 || node->high[k] < 0)
                return INFINITY;
            continue;
        }
        const Real one = node->low[k] * inverse[k], other = node->high[k] * inverse[k];
        from = real_max(from, real_min(one, other));
        to = real_min(to, real_max(one, other));
    }
    return from * (1 - 8 * REAL_EPSILON) <= to ? from * (1 - 8 * REAL_EPSILON) : INFINITY;
}

bool triangles_ray(const Triangles *triangles, Real3 direction, Real near, Real far,
                   TriangleHit *hit)
{
    const Real inverse[3] = {direction.x != 0 ? 1 / direction.x : 0,
                             direction.y != 0 ? 1 / direction.y : 0,
                             direction.z != 0 ? 1 / direction.z : 0};
    const BoundsNode *nodes = triangles->bounds.nodes;
    uint32_t stack[BOUNDS_MAX_DEPTH];
    uint32_t number = NONE; /* of the triangle that is hit */
    int depth = 0;
    if (nodes && enter(&nodes[0], inverse, near, far) < INFINITY)
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
