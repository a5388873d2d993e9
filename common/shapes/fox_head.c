/*
 * A fox's head from 64 points: half of a cage of quadrilaterals, and its mirror image.
 *
 * Catmull-Clark subdivision cuts each quadrilateral into four. It adds the middle F of each
 * quadrilateral; on each edge the mean of its ends and of the two F beside it; and moves each point
 * P with n edges to ((n - 2) P + R + Q) / n, where R is the mean of the n other ends of its edges
 * and Q that of the n F around it. Repeated, this converges to bicubic B-splines, smooth everywhere
 * except for curvature where n is not 4. Only half of the cage is stored; a point in the mirror
 * plane has its neighbours twice, the second time with opposite x, so that it stays in the plane.
 * Edges are found by sorting the sides of all quadrilaterals by their two ends.
 */
#include "shapes/fox_head.h"

#include "base/memory.h"
#include "core/mesh_make.h"

#include <stdlib.h>
#include <string.h>

/* The half of the cage at x >= 0, in units of 1 / UNITS. Eight rings of six points, from the middle
 * of the top over the side to the middle of the bottom; then eye and ear. */
enum { UNITS = 105 };
/* clang-format off */
static const signed char POINTS[][3] = {
    /* nose */
    {0, -27, 90}, {8, -27, 89}, {13, -35, 87}, {9, -44, 84}, {6, -51, 81}, {0, -52, 81},
    /* behind the nose */
    {0, -25, 77}, {8, -26, 76}, {13, -37, 74}, {15, -48, 70}, {10, -57, 69}, {0, -59, 69},
    /* muzzle */
    {0, -17, 57}, {9, -19, 56}, {18, -33, 50}, {22, -49, 46}, {15, -60, 47}, {0, -63, 47},
    /* inner corner of the eye */
    {0, -1, 40}, {13, 4, 37}, {22, -16, 33}, {39, -49, 20}, {25, -62, 23}, {0, -66, 23},
    /* brow */
    {0, 23, 31}, {25, 25, 31}, {54, 10, 9}, {68, -34, -1}, {42, -62, 0}, {0, -68, 0},
    /* front of the ear, tip of the cheek */
    {0, 36, 7}, {13, 38, 9}, {59, 17, -1}, {90, -37, -25}, {48, -60, -27}, {0, -64, -30},
    /* back of the ear */
    {0, 34, -25}, {15, 34, -23}, {52, 16, -31}, {58, -26, -55}, {36, -52, -55}, {0, -58, -57},
    /* back of the head */
    {0, 14, -57}, {16, 12, -57}, {34, 2, -61}, {36, -22, -73}, {22, -42, -73}, {0, -46, -75},
    /* socket of the eye */
    {16, 6, 31}, {22, -10, 29}, {44, 9, 12}, {24, 18, 25},
    /* eye */
    {22, 6, 32}, {26, -3, 31}, {40, 8, 20}, {27, 14, 28},
    /* tip of the ear */
    {50, 89, -7}, {58, 87, -8}, {56, 86, -18}, {50, 87, -18},
    /* hollow of the ear */
    {31, 42, -5}, {40, 38, -6}, {46, 58, -9}, {41, 58, -8},
};
/* clang-format on */
static const unsigned char QUADS[][4] = {
    {0, 5, 4, 1},     {1, 4, 3, 2},     {0, 1, 7, 6},     {1, 2, 8, 7},     {2, 3, 9, 8},
    {3, 4, 10, 9},    {4, 5, 11, 10},   {6, 7, 13, 12},   {7, 8, 14, 13},   {8, 9, 15, 14},
    {9, 10, 16, 15},  {10, 11, 17, 16}, {12, 13, 19, 18}, {13, 14, 20, 19}, {14, 15, 21, 20},
    {15, 16, 22, 21}, {16, 17, 23, 22}, {18, 19, 25, 24}, {20, 21, 27, 26}, {21, 22, 28, 27},
    {22, 23, 29, 28}, {24, 25, 31, 30}, {25, 26, 32, 31}, {26, 27, 33, 32}, {27, 28, 34, 33},
    {28, 29, 35, 34}, {30, 31, 37, 36}, {32, 33, 39, 38}, {33, 34, 40, 39}, {34, 35, 41, 40},
    {36, 37, 43, 42}, {37, 38, 44, 43}, {38, 39, 45, 44}, {39, 40, 46, 45}, {40, 41, 47, 46},
    {42, 43, 46, 47}, {43, 44, 45, 46}, {19, 20, 49, 48}, {20, 26, 50, 49}, {26, 25, 51, 50},
    {25, 19, 48, 51}, {48, 49, 53, 52}, {49, 50, 54, 53}, {50, 51, 55, 54}, {51, 48, 52, 55},
    {52, 53, 54, 55}, {32, 38, 58, 57}, {38, 37, 59, 58}, {37, 31, 56, 59}, {56, 57, 58, 59},
    {31, 32, 61, 60}, {32, 57, 62, 61}, {57, 56, 63, 62}, {56, 31, 60, 63}, {60, 61, 62, 63},
};
enum {
    POINT_COUNT = sizeof POINTS / sizeof POINTS[0],
    QUAD_COUNT = sizeof QUADS / sizeof QUADS[0]
};

static Cage cage_open(size_t point_count, size_t quad_count)
{
    return (Cage){.points = memory_new(point_count, sizeof(Vec3)),
                  .quads = memory_new(quad_count, sizeof(uint32_t[4])),
                  .point_count = point_count,
                  .quad_count = quad_count};
}

void cage_close(Cage *cage)
{
    if (!cage)
        return;
    free(cage->points);
    free(cage->quads);
    *cage = (Cage){0};
}

/* A side of a quadrilateral. */
typedef struct Side {
    uint32_t ends[2]; /* the points that it joins, the lower one first */
    uint32_t corner;  /* 4 * quadrilateral + the corner at which it begins */
} Side;

static int compare_sides(const void *a, const void *b)
{
    const Side *p = a, *q = b;
    for (int i = 0; i < 2; i++)
        if (p->ends[i] != q->ends[i])
            return p->ends[i] < q->ends[i] ? -1 : 1;
    return p->corner < q->corner ? -1 : 1;
}

static Vec3 middle(Vec3 a, Vec3 b)
{
    return vec3_scale(vec3_add(a, b), 0.5);
}

/* Where a point of the surface moves that `corners` quadrilaterals share. `sum` adds up, for each
 * of them, its face point and the middle of its two points next to `from`: an edge's other end is
 * in two of those middles, half in each. In the mirror plane the image adds as many, with opposite
 * x.
 */
static Vec3 moved(Vec3 from, Vec3 sum, int corners)
{
    const bool mirrored = from.x == 0;
    const double valence = mirrored ? 2 * corners : corners;
    const Vec3 mean = vec3_scale(sum, 1.0 / corners);
    return vec3_scale(
        vec3_add(vec3_scale(from, valence - 2), (Vec3){mirrored ? 0 : mean.x, mean.y, mean.z}),
        1 / valence);
}

void cage_subdivide(Cage *cage)
{
    const uint32_t points = (uint32_t)cage->point_count, quads = (uint32_t)cage->quad_count;
    const Vec3 *point = cage->points;
    Cage fine = cage_open(points + 5 * (size_t)quads, 4 * (size_t)quads);
    Side *sides = memory_new(4 * (size_t)quads, sizeof *sides);
    int *corners = memory_new(points, sizeof *corners);
    for (uint32_t q = 0; q < quads; q++) {
        const uint32_t *quad = cage->quads[q];
        const Vec3 even = middle(point[quad[0]], point[quad[2]]);
        const Vec3 odd = middle(point[quad[1]], point[quad[3]]), face = middle(even, odd);
        fine.points[points + q] = face;
        for (uint32_t i = 0; i < 4; i++) {
            const uint32_t a = quad[i], b = quad[(i + 1) % 4];
            fine.points[a] = vec3_add(fine.points[a], vec3_add(face, i % 2 == 0 ? odd : even));
            corners[a]++;
            sides[4 * q + i] = (Side){{a < b ? a : b, a < b ? b : a}, 4 * q + i};
            fine.quads[4 * q + i][0] = a;
            fine.quads[4 * q + i][2] = points + q;
        }
    }
    for (uint32_t i = 0; i < points; i++)
        fine.points[i] = moved(point[i], fine.points[i], corners[i]);

    /* Sides with the same ends are one edge: of two quadrilaterals, or of one and its image. */
    qsort(sides, 4 * (size_t)quads, sizeof *sides, compare_sides);
    uint32_t edge = points + quads;
    for (uint32_t i = 0, end; i < 4 * quads; i = end, edge++) {
        const Vec3 first = fine.points[points + sides[i].corner / 4];
        Vec3 faces = {0, first.y, first.z};
        end = i + 1;
        if (end < 4 * quads && memcmp(sides[i].ends, sides[end].ends, sizeof sides->ends) == 0)
            faces = middle(first, fine.points[points + sides[end++].corner / 4]);
        fine.points[edge] = middle(middle(point[sides[i].ends[0]], point[sides[i].ends[1]]), faces);
        for (uint32_t k = i; k < end; k++) {
            const uint32_t from = sides[k].corner, to = from / 4 * 4 + (from + 1) % 4;
            fine.quads[from][1] = fine.quads[to][3] = edge;
        }
    }
    fine.point_count = edge;
    free(sides);
    free(corners);
    cage_close(cage);
    *cage = fine;
}

/* The cage as triangles; `faceted`: with four vertices for each quadrilateral, and its normal. */
static bool half_open(Mesh *half, const Cage *cage, bool faceted, Message *message)
{
    static const unsigned char split[6] = {0, 1, 2, 0, 2, 3};
    const size_t quads = cage->quad_count;
    if (!mesh_open(half, faceted ? 4 * quads : cage->point_count, 6 * quads, message))
        return false;
    for (size_t q = 0; q < quads; q++) {
        const uint32_t *quad = cage->quads[q];
        const Vec3 *p = cage->points;
        const Vec3 normal = vec3_unit(vec3_cross(vec3_subtract(p[quad[2]], p[quad[0]]),
                                                 vec3_subtract(p[quad[3]], p[quad[1]])));
        uint32_t index[4];
        for (uint32_t i = 0; i < 4; i++) {
            index[i] = faceted ? 4 * (uint32_t)q + i : quad[i];
            vec3_to_float(p[quad[i]], half->vertices[index[i]].position);
            vec3_to_float(normal, half->vertices[index[i]].normal);
        }
        for (size_t i = 0; i < 6; i++)
            half->indices[6 * q + i] = index[split[i]];
    }
    return faceted || mesh_compute_normals(half, MESH_WEIGHT_ANGLE, false, message);
}

/* Both halves. Without `faceted`, vertices in the mirror plane belong to both, and their normals
 * lie in it. */
static bool mirror(Mesh *mesh, const Mesh *half, bool faceted, Message *message)
{
    const size_t count = half->vertex_count, indices = half->index_count;
    if (!mesh_open(mesh, 2 * count, 2 * indices, message))
        return false;
    uint32_t *image = memory_new(count, sizeof *image);
    memcpy(mesh->vertices, half->vertices, count * sizeof *half->vertices);
    memcpy(mesh->indices, half->indices, indices * sizeof *half->indices);
    mesh->vertex_count = count;
    for (uint32_t i = 0; i < count; i++) {
        MeshVertex *vertex = &mesh->vertices[i];
        image[i] = i;
        if (!faceted && vertex->position[0] == 0) {
            vertex->normal[0] = 0;
            vec3_to_float(vec3_unit(vec3_from_float(vertex->normal)), vertex->normal);
            continue;
        }
        image[i] = (uint32_t)mesh->vertex_count++;
        mesh->vertices[image[i]] = *vertex;
        mesh->vertices[image[i]].position[0] = 0 - vertex->position[0];
        mesh->vertices[image[i]].normal[0] = 0 - vertex->normal[0];
    }
    for (size_t i = 0; i < indices; i += 3)
        for (size_t k = 0; k < 3; k++)
            mesh->indices[indices + i + k] = image[half->indices[i + (3 - k) % 3]];
    free(image);
    return true;
}

bool mesh_head(Mesh *mesh, HeadStyle style, Message *message)
{
    Cage cage = cage_open(POINT_COUNT, QUAD_COUNT);
    Mesh half = {0};
    *mesh = (Mesh){0};
    for (size_t i = 0; i < POINT_COUNT; i++)
        cage.points[i] = vec3_scale((Vec3){POINTS[i][0], POINTS[i][1], POINTS[i][2]}, 1.0 / UNITS);
    for (size_t i = 0; i < QUAD_COUNT; i++)
        for (size_t k = 0; k < 4; k++)
            cage.quads[i][k] = QUADS[i][k];
    const bool faceted = style == HEAD_FACETED;
    for (int step = 0; step < 2 && style == HEAD_SUBDIVIDED; step++)
        cage_subdivide(&cage);
    const bool done =
        half_open(&half, &cage, faceted, message) && mirror(mesh, &half, faceted, message);
    mesh_close(&half);
    cage_close(&cage);
    return done;
}
