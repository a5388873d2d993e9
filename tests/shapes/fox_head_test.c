/*
 * The head in its three styles, and Catmull-Clark subdivision against closed forms. No GL.
 */
#include "shapes/fox_head.h"
#include "support/testing.h"
#include "support/topology.h"

static unsigned short seed[3];

/* The cage has Q = 110 quadrilaterals and 112 points; each step adds Q points and 2 Q edges'. */
static const struct Style {
    HeadStyle style;
    size_t points, vertices, triangles;
} STYLES[] = {
    {HEAD_FACETED, 112, 4 * 110, 2 * 110},
    {HEAD_SMOOTH, 112, 112, 2 * 110},
    {HEAD_SUBDIVIDED, 112 + 3 * 110 + 3 * 440, 112 + 3 * 110 + 3 * 440, 2 * 16 * 110},
};
enum { STYLE_COUNT = sizeof STYLES / sizeof STYLES[0] };

TEST(the_head_is_closed_and_oriented_outwards)
{
    for (size_t s = 0; s < STYLE_COUNT; s++) {
        CLOSED(mesh_close) Mesh mesh;
        SUCCEEDS(mesh_head(&mesh, STYLES[s].style, message));
        assert_int_equal(mesh.vertex_count, STYLES[s].vertices);
        assert_int_equal(mesh.index_count, 3 * STYLES[s].triangles);
        assert_int_equal(topology_open_edges(&mesh), 0);
        assert_true(topology_volume(&mesh) > 0);

        /* Euler's formula, for a surface like a sphere: V - E + F = 2, with E = 3/2 F. */
        uint32_t *same = topology_representatives(&mesh);
        size_t points = 0;
        for (uint32_t i = 0; i < mesh.vertex_count; i++)
            points += same[i] == i;
        free(same);
        assert_int_equal(points, STYLES[s].points);
        assert_int_equal(points, 2 + STYLES[s].triangles / 2);
    }
}

TEST(the_head_fits_the_unit_sphere_and_its_normals_point_outwards)
{
    for (size_t s = 0; s < STYLE_COUNT; s++) {
        CLOSED(mesh_close) Mesh mesh;
        double far = 0;
        SUCCEEDS(mesh_head(&mesh, STYLES[s].style, message));
        topology_check_sound(&mesh);
        for (size_t i = 0; i < mesh.vertex_count; i++)
            far = fmax(far, vec3_length(topology_position(&mesh, i)));
        assert_true(far > 0.9 && far <= 1);
        /* A quadrilateral's halves are less than 30 degrees from its plane; smooth normals are on
         * the outer side of each triangle, even where the rim of an ear is thin. */
        const double least = STYLES[s].style == HEAD_FACETED ? sqrt(0.75) : 0;
        for (size_t i = 0; i < mesh.index_count; i++) {
            Vec3 face;
            assert_true(mesh_face(&mesh, i / 3, &face));
            assert_true(vec3_dot(face, topology_normal(&mesh, mesh.indices[i])) > least);
        }
    }
}

/* Six times the volume of a tetrahedron, with the sign of its orientation. */
static double volume(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    return vec3_dot(vec3_subtract(a, d), vec3_cross(vec3_subtract(b, d), vec3_subtract(c, d)));
}

static bool crosses(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c)
{
    if ((volume(a, b, c, p) > 0) == (volume(a, b, c, q) > 0))
        return false;
    const bool side = volume(p, q, a, b) > 0;
    return (volume(p, q, b, c) > 0) == side && (volume(p, q, c, a) > 0) == side;
}

/* Whether p and q both lie below a, b and c on an axis, or above them. */
static bool apart(double p, double q, double a, double b, double c)
{
    return fmax(p, q) < fmin(a, fmin(b, c)) || fmin(p, q) > fmax(a, fmax(b, c));
}

TEST(no_edge_of_the_head_crosses_a_triangle)
{
    for (size_t s = 0; s < STYLE_COUNT; s++) {
        CLOSED(mesh_close) Mesh mesh;
        SUCCEEDS(mesh_head(&mesh, STYLES[s].style, message));
        uint32_t *same = topology_representatives(&mesh);
        for (size_t e = 0; e < mesh.index_count; e++) {
            const size_t next = e % 3 == 2 ? e - 2 : e + 1;
            const Vec3 p = topology_corner(&mesh, e), q = topology_corner(&mesh, next);
            const uint32_t from = same[mesh.indices[e]], to = same[mesh.indices[next]];
            for (size_t t = 0; from < to && t < mesh.index_count; t += 3) {
                const Vec3 a = topology_corner(&mesh, t), b = topology_corner(&mesh, t + 1);
                const Vec3 c = topology_corner(&mesh, t + 2);
                if (apart(p.x, q.x, a.x, b.x, c.x) || apart(p.y, q.y, a.y, b.y, c.y) ||
                    apart(p.z, q.z, a.z, b.z, c.z))
                    continue;
                bool touches = false;
                for (size_t k = t; k < t + 3; k++)
                    touches |= same[mesh.indices[k]] == from || same[mesh.indices[k]] == to;
                assert_true(touches || !crosses(p, q, a, b, c));
            }
        }
        free(same);
    }
}

/* Subdivision. */

/* The cube of side 2 around (2, 0, 0); corner i has the signs of i's bits. */
static const Vec3 CORNERS[8] = {{1, -1, -1}, {3, -1, -1}, {1, 1, -1}, {3, 1, -1},
                                {1, -1, 1},  {3, -1, 1},  {1, 1, 1},  {3, 1, 1}};
static const uint32_t SIDES[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                     {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};

static Cage open_cage(const Vec3 *points, size_t point_count, const uint32_t (*quads)[4],
                      size_t quad_count)
{
    Cage cage = {calloc(point_count, sizeof *points), calloc(quad_count, sizeof *quads),
                 point_count, quad_count};
    assert_true(cage.points && cage.quads);
    memcpy(cage.points, points, point_count * sizeof *points);
    memcpy(cage.quads, quads, quad_count * sizeof *quads);
    return cage;
}

static void assert_at(Vec3 point, Vec3 expected, double tolerance)
{
    if (!(topology_distance(point, expected) <= tolerance))
        fail_msg("(%.17g, %.17g, %.17g) instead of (%.17g, %.17g, %.17g)", point.x, point.y,
                 point.z, expected.x, expected.y, expected.z);
}

/* Where a point of a closed cage ends: with its valence n, the other ends E of its edges and the
 * opposite corners F of its quadrilaterals, (n^2 P + 4 sum E + sum F) / (n (n + 5)) (Halstead, Kass
 * and DeRose, Efficient, fair interpolation using Catmull-Clark surfaces, SIGGRAPH 1993). */
static Vec3 limit(const Cage *cage, uint32_t point)
{
    Vec3 sum = {0, 0, 0};
    int n = 0;
    for (size_t q = 0; q < cage->quad_count; q++)
        for (uint32_t k = 0; k < 4; k++) {
            const uint32_t *quad = cage->quads[q];
            if (quad[k] != point)
                continue;
            /* Each edge belongs to two quadrilaterals, and begins at the point in one of them. */
            sum = vec3_add(sum, vec3_scale(cage->points[quad[(k + 1) % 4]], 4));
            sum = vec3_add(sum, cage->points[quad[(k + 2) % 4]]);
            n++;
        }
    sum = vec3_add(sum, vec3_scale(cage->points[point], n * n));
    return vec3_scale(sum, 1.0 / (n * (n + 5)));
}

/* Rounding: some ten sums of numbers up to 8. */
static const double ROUNDED = 1e-14;

/* The limit of a cube is known: half its corner, and 68/81 of the way to the middle of a side. */
TEST(a_step_moves_no_point_of_the_limit)
{
    testing_seed48(seed);
    for (int run = 0; run < 20; run++) {
        CLOSED(cage_close) Cage cage = open_cage(CORNERS, 8, SIDES, 6);
        for (size_t i = 0; i < 8 && run > 0; i++)
            cage.points[i] =
                vec3_add(cage.points[i], (Vec3){erand48(seed) / 2, erand48(seed), erand48(seed)});
        for (size_t step = 0; step < 3; step++) {
            Vec3 before[98];
            const uint32_t count = (uint32_t)cage.point_count;
            for (uint32_t i = 0; i < count; i++)
                before[i] = limit(&cage, i);
            cage_subdivide(&cage);
            assert_int_equal(cage.quad_count, 6u << 2 * (step + 1));
            assert_int_equal(cage.point_count, cage.quad_count + 2);
            for (uint32_t i = 0; i < count; i++)
                assert_at(limit(&cage, i), before[i], ROUNDED);
        }
        if (run == 0) {
            assert_at(limit(&cage, 7), (Vec3){2.5, 0.5, 0.5}, ROUNDED);
            assert_at(limit(&cage, 8), (Vec3){2 + 68.0 / 81, 0, 0}, ROUNDED);
        }
    }
}

/* A box cut in two, once as its half, once whole and shifted away from the plane x = 0. */
TEST(half_a_surface_is_subdivided_as_the_whole)
{
    const Vec3 shift = {8, 0, 0};
    Vec3 points[12];
    uint32_t quads[10][4];
    testing_seed48(seed);
    for (size_t i = 0; i < 4; i++) {
        const Vec3 corner = CORNERS[2 * i], more = {erand48(seed), erand48(seed), erand48(seed)};
        points[i] = (Vec3){0, corner.y + more.x, corner.z + more.y};
        points[4 + i] = (Vec3){1 + more.z, corner.y, corner.z};
        points[8 + i] = (Vec3){-1 - more.z, corner.y, corner.z};
    }
    /* Of the cube's sides all but that at low x. Corner i lies at high x if it is odd. */
    for (size_t q = 0, side = 0; side < 6; side++) {
        if (side == 1)
            continue;
        for (size_t k = 0; k < 4; k++) {
            const uint32_t corner = SIDES[side][k], at = corner / 2;
            quads[q][k] = corner % 2 == 1 ? 4 + at : at;
            quads[5 + q][3 - k] = corner % 2 == 1 ? 8 + at : at;
        }
        q++;
    }
    CLOSED(cage_close) Cage half = open_cage(points, 8, quads, 5);
    for (size_t i = 0; i < 12; i++)
        points[i] = vec3_add(points[i], shift);
    CLOSED(cage_close) Cage whole = open_cage(points, 12, quads, 10);
    for (int step = 0; step < 3; step++) {
        cage_subdivide(&half);
        cage_subdivide(&whole);
        /* The first half of the quadrilaterals is the half's, corner by corner. */
        for (size_t q = 0; q < half.quad_count; q++)
            for (size_t k = 0; k < 4; k++)
                assert_at(vec3_subtract(whole.points[whole.quads[q][k]], shift),
                          half.points[half.quads[q][k]], ROUNDED);
    }
}

TEST_MAIN("fox head", NULL, NULL)
