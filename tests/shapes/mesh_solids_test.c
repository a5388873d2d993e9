/*
 * The solids. No GL.
 */
#include "shapes/mesh_solids.h"
#include "support/testing.h"
#include "support/topology.h"

#include <float.h>

/* Half a step of a float below 1, plus the error of sine and cosine in double. */
static const double ROUNDED = FLT_EPSILON / 4 + 1e-15;

/* A vertex lies where f is 0, and its normal is f's gradient. f is divided by the length of its
 * gradient, which to first order gives the distance from the surface. */
static void assert_on_surface(const MeshVertex *vertex, double f, Vec3 gradient, double size)
{
    Vec3 unit;
    const double slope = vec3_length(gradient);
    assert_true(vec3_normalize(gradient, &unit));
    /* At most half a step in each coordinate. */
    assert_true(fabs(f) / slope <= size * FLT_EPSILON);
    /* The gradient is computed at the rounded position, and the normal is rounded too. */
    assert_true(topology_distance(unit, vec3_from_float(vertex->normal)) <= 4 * FLT_EPSILON);
}

typedef struct Tessellation {
    int around, along;
} Tessellation;

static const Tessellation TESSELLATIONS[] = {{3, 1},   {3, 3},  {4, 2},    {13, 13},
                                             {64, 32}, {5, 50}, {8192, 3}, {3, 8192}};
enum { TESSELLATION_COUNT = sizeof TESSELLATIONS / sizeof TESSELLATIONS[0] };

static const double SIZES[] = {1, 0.1, 3, 1e-18, 1e20};
enum { SIZE_COUNT = sizeof SIZES / sizeof SIZES[0] };

/* The area of a regular polygon with n corners in a circle of radius 1. */
static double polygon(int n)
{
    return n / 2.0 * sin(2 * PI / n);
}

/* Cone, cylinder, torus, disc, quad. */

TEST(a_cone_lies_on_its_surface_with_the_normals_of_it)
{
    for (int n = 0; n <= TESSELLATION_COUNT; n++)
        for (int s = 0; s < SIZE_COUNT; s++) {
            const bool halving = n == TESSELLATION_COUNT; /* the textbook's rings */
            const Tessellation t = halving ? (Tessellation){64, 5} : TESSELLATIONS[n];
            const double r = SIZES[s], h = 2.5 * r;
            const size_t row = (size_t)t.around + 1, side = row * ((size_t)t.along + 1);
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(
                mesh_cone(&mesh, r, h, t.around, halving ? MESH_CONE_HALVING : t.along, message));
            assert_int_equal(mesh.vertex_count, side + 2 * row);
            topology_check_seam(mesh.vertices, (size_t)t.along + 3, row - 1);
            topology_check_outward(&mesh, 0);
            for (size_t i = row; i < side; i++) {
                const Vec3 p = topology_position(&mesh, i);
                const double wide = hypot(p.x, p.y);
                assert_on_surface(&mesh.vertices[i], wide + r * p.z / h - r,
                                  (Vec3){p.x / wide, p.y / wide, r / h}, h);
            }
            for (size_t i = 0; i < row; i++) { /* the apex: vertex i + 1 is that of slice i */
                const MeshVertex apex = {{0, 0, (float)h}, {0, 0, 0}};
                const double a = 2 * PI * ((double)i - 0.5) / t.around, l = hypot(r, h);
                const Vec3 normal = {h / l * cos(a), h / l * sin(a), r / l};
                assert_memory_equal(mesh.vertices[i].position, apex.position, sizeof apex.position);
                assert_true(topology_distance(topology_normal(&mesh, i), normal) <= 2 * ROUNDED);
            }
            const MeshVertex middle = {{0, 0, 0}, {0, 0, -1}};
            for (size_t i = side; i < mesh.vertex_count; i++) {
                assert_memory_equal(mesh.vertices[i].normal, middle.normal, sizeof middle.normal);
                assert_true(mesh.vertices[i].position[2] == 0);
                if (i >= side + row)
                    assert_memory_equal(&mesh.vertices[i], &middle, sizeof middle);
            }
        }
}

TEST(a_cylinder_lies_on_its_surface_with_the_normals_of_it)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++)
        for (int s = 0; s < SIZE_COUNT; s++) {
            const Tessellation t = TESSELLATIONS[n];
            const double r = SIZES[s], h = 0.7 * r;
            const size_t row = (size_t)t.around + 1, side = row * ((size_t)t.along + 1);
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_cylinder(&mesh, (MeshCylinder){r, h, t.around, t.along, MESH_CAP_BOTH},
                                   message));
            assert_int_equal(mesh.vertex_count, side + 4 * row);
            topology_check_seam(mesh.vertices, (size_t)t.along + 5, row - 1);
            for (size_t i = 0; i < side; i++) {
                const Vec3 p = topology_position(&mesh, i);
                assert_true(p.z >= 0 && p.z <= (float)h);
                assert_on_surface(&mesh.vertices[i], hypot(p.x, p.y) - r,
                                  (Vec3){p.x / r, p.y / r, 0}, r);
            }
            for (size_t i = side; i < mesh.vertex_count; i++) { /* the top's, then the bottom's */
                const bool top = i < side + 2 * row;
                const float *normal = mesh.vertices[i].normal;
                assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == (top ? 1 : -1));
                assert_true(mesh.vertices[i].position[2] == (top ? (float)h : 0));
            }
        }
}

TEST(a_cylinder_without_a_cap_is_open)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        const Tessellation t = TESSELLATIONS[n];
        const double r = 2, h = 3, side = 2 * t.around * r * sin(PI / t.around) * h;
        for (int caps = MESH_CAP_NONE; caps <= MESH_CAP_BOTH; caps++) {
            const bool bottom = caps & MESH_CAP_BOTTOM, top = caps & MESH_CAP_TOP;
            CLOSED(mesh_close) Mesh mesh;
            assert_true(mesh_cylinder(
                &mesh, (MeshCylinder){r, h, t.around, t.along, (MeshCaps)caps}, NULL));
            topology_check_outward(&mesh, (size_t)t.around * (size_t)(!bottom + !top));
            testing_near(topology_area(&mesh), side + (bottom + top) * polygon(t.around) * r * r,
                         4 * FLT_EPSILON);
            /* Seen from the origin, in the plane of the bottom: the bottom contributes nothing;
             * side and top enclose two thirds and one third of the prism. */
            testing_near(topology_volume(&mesh), polygon(t.around) * r * r * h * (2 + top) / 3,
                         4 * FLT_EPSILON);
            size_t down = 0;
            for (size_t i = 0; i < mesh.index_count / 3; i++)
                down += topology_face(&mesh, i).z < 0;
            assert_int_equal(down, bottom ? t.around : 0);
        }
    }
}

TEST(a_torus_lies_on_its_surface_with_the_normals_of_it)
{
    static const double thickness[] = {0.001, 0.3, 0.999999};
    for (int n = 1; n < TESSELLATION_COUNT; n++)
        for (int s = 0; s < SIZE_COUNT; s++) {
            const int rings = TESSELLATIONS[n].around;
            const int sides = TESSELLATIONS[n].along < 3 ? 3 : TESSELLATIONS[n].along;
            const double ring = SIZES[s], tube = thickness[s % 3] * ring;
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_torus(&mesh, tube, ring, sides, rings, message));
            assert_int_equal(mesh.vertex_count, (rings + 1) * (sides + 1));
            assert_int_equal(mesh.index_count, 6 * rings * sides);
            topology_check_seam(mesh.vertices, (size_t)sides + 1, (size_t)rings);
            if (thickness[s % 3] == 0.3)
                topology_check_outward(&mesh, 0);
            assert_memory_equal(mesh.vertices, mesh.vertices + (rings + 1) * sides,
                                ((size_t)rings + 1) * sizeof *mesh.vertices);
            for (size_t i = 0; i < mesh.vertex_count; i++) {
                /* The vector from the middle of the tube; the thinner the tube, the larger its
                 * relative rounding error. */
                const Vec3 p = topology_position(&mesh, i);
                const double wide = hypot(p.x, p.y);
                const Vec3 middle = {ring * p.x / wide, ring * p.y / wide, 0};
                const Vec3 out = vec3_scale(vec3_subtract(p, middle), 1 / tube);
                const double part = FLT_EPSILON * (1 + ring / tube);
                assert_true(fabs(vec3_length(out) - 1) <= part);
                if (wide > 0.01 * ring) /* near the axis it has no accurate direction */
                    assert_true(topology_distance(out, topology_normal(&mesh, i)) <= 2 * part);
            }
        }
}

TEST(a_disc_is_a_polygon_that_faces_up)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++)
        for (int s = 0; s < SIZE_COUNT; s++) {
            const Tessellation t = TESSELLATIONS[n];
            const double r = SIZES[s];
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_disc(&mesh, r, t.around, t.along, message));
            assert_int_equal(mesh.vertex_count, (t.around + 1) * (t.along + 1));
            assert_int_equal(mesh.index_count, 3 * t.around * (2 * t.along - 1));
            topology_check_seam(mesh.vertices, (size_t)t.along + 1, (size_t)t.around);
            topology_check_outward(&mesh, (size_t)t.around);
            testing_near(topology_area(&mesh), polygon(t.around) * r * r, 4 * FLT_EPSILON);
            for (size_t i = 0; i < mesh.vertex_count; i++) {
                const Vec3 p = topology_position(&mesh, i);
                const double loop = (double)(i / ((size_t)t.around + 1)) / t.along;
                const double angle = 2 * PI * (double)(i % ((size_t)t.around + 1)) / t.around;
                const Vec3 expected = {r * loop * cos(angle), r * loop * sin(angle), 0};
                assert_true(topology_distance(p, expected) <= 4 * r * ROUNDED && p.z == 0);
                assert_true(mesh.vertices[i].normal[2] == 1);
            }
        }
}

TEST(a_quad_is_a_square_that_faces_up)
{
    static const int divisions[] = {1, 2, 3, 10, 128};
    for (size_t n = 0; n < sizeof divisions / sizeof divisions[0]; n++) {
        const int d = divisions[n];
        CLOSED(mesh_close) Mesh mesh;
        assert_true(mesh_quad(&mesh, d, NULL));
        assert_int_equal(mesh.vertex_count, (d + 1) * (d + 1));
        assert_int_equal(mesh.index_count, 6 * d * d);
        topology_check_outward(&mesh, 4 * (size_t)d);
        testing_near(topology_area(&mesh), 4, 4 * FLT_EPSILON);
        for (int i = 0; i < (d + 1) * (d + 1); i++) { /* rows from the top, columns from the left */
            const MeshVertex expected = {{(float)((double)(2 * (i % (d + 1)) - d) / d),
                                          (float)((double)(d - 2 * (i / (d + 1))) / d), 0},
                                         {0, 0, 1}};
            assert_memory_equal(&mesh.vertices[i], &expected, sizeof expected);
        }
    }
}

/* Regular solids. */

static const struct {
    int faces, sides;
    double edge, volume; /* in a sphere of radius 1 */
    Vec3 corner, no_corner;
} REGULAR[] = {
    /* Edge and volume as in Coxeter, Regular polytopes, table I. */
    [MESH_TETRAHEDRON] =
        {4, 3, 1.6329931618554520655, 0.51320023928966731859, {1, 1, 1}, {-1, 1, 1}},
    [MESH_OCTAHEDRON] = {8, 3, 1.4142135623730950488, 1.3333333333333333333, {0, 0, 1}, {1, 1, 1}},
    [MESH_DODECAHEDRON] = {12,
                           5,
                           0.71364417954617988885,
                           2.7851638631226171,
                           {0, 0.61803398874989484820, 1.6180339887498948482},
                           {0, 1.6180339887498948482, 0.61803398874989484820}},
    [MESH_ICOSAHEDRON] = {20,
                          3,
                          1.0514622242382672121,
                          2.5361507101204095,
                          {1, 0, 1.6180339887498948482},
                          {1.6180339887498948482, 0, 1}},
};
enum { REGULAR_COUNT = sizeof REGULAR / sizeof REGULAR[0] };

static bool has_corner(const Mesh *mesh, Vec3 direction, double radius)
{
    Vec3 unit;
    vec3_normalize(direction, &unit);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        if (topology_distance(vec3_scale(topology_position(mesh, i), 1 / radius), unit) < 1e-6)
            return true;
    return false;
}

TEST(regular_solids_are_regular)
{
    for (int n = 0; n < REGULAR_COUNT; n++)
        for (int s = 0; s < SIZE_COUNT; s++) {
            const double r = SIZES[s];
            const size_t sides = (size_t)REGULAR[n].sides, faces = (size_t)REGULAR[n].faces;
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_regular(&mesh, (MeshRegular)n, r, message));
            assert_int_equal(mesh.vertex_count, faces * sides);
            assert_int_equal(mesh.index_count, 3 * faces * (sides - 2));
            topology_check_outward(&mesh, 0);
            testing_near(topology_volume(&mesh), REGULAR[n].volume * r * r * r, 4 * FLT_EPSILON);
            for (size_t i = 0; i < mesh.vertex_count; i++) {
                const size_t next = i % sides == sides - 1 ? i + 1 - sides : i + 1;
                const Vec3 p = topology_position(&mesh, i);
                const Vec3 q = topology_position(&mesh, next);
                const Vec3 normal = topology_normal(&mesh, i);
                testing_near(vec3_length(p), r, FLT_EPSILON);
                testing_near(topology_distance(p, q), REGULAR[n].edge * r, 2 * FLT_EPSILON);
                /* Flat: the normal is the face's, perpendicular to its edges. */
                assert_true(fabs(vec3_dot(vec3_subtract(q, p), normal)) <= 4 * FLT_EPSILON * r);
                assert_memory_equal(mesh.vertices[i].normal, mesh.vertices[next].normal,
                                    sizeof mesh.vertices[i].normal);
                /* Convex: no corner is above a face. */
                for (size_t other = 0; other < mesh.vertex_count; other++)
                    assert_true(vec3_dot(vec3_subtract(topology_position(&mesh, other), p),
                                         normal) <= 4 * FLT_EPSILON * r);
            }
            assert_true(has_corner(&mesh, REGULAR[n].corner, r));
            assert_false(has_corner(&mesh, REGULAR[n].no_corner, r));
        }
}

/* Arguments. */

enum { CONE, CYLINDER, TORUS, DISC, QUAD, TEAPOT, FIRST_REGULAR };

/* A shape of these lengths and counts, of which it may take fewer. */
static bool make(Mesh *mesh, int shape, const double length[2], const int count[2],
                 Message *message)
{
    switch (shape) {
    case CONE:
        return mesh_cone(mesh, length[0], length[1], count[0], count[1], message);
    case CYLINDER:
        return mesh_cylinder(
            mesh, (MeshCylinder){length[0], length[1], count[0], count[1], MESH_CAP_BOTH}, message);
    case TORUS:
        return mesh_torus(mesh, length[0], length[1], count[0], count[1], message);
    case DISC:
        return mesh_disc(mesh, length[0], count[0], count[1], message);
    case QUAD:
        return mesh_quad(mesh, count[0], message);
    case TEAPOT:
        return mesh_teapot(mesh, length[0], count[0], message);
    default:
        return mesh_regular(mesh, (MeshRegular)(shape - FIRST_REGULAR), length[0], message);
    }
}

static const struct {
    const char *name, *lengths[2], *counts[2];
    int min[2], max;
} SHAPES[] = {{"cone", {"radius", "height"}, {"slices", "stacks"}, {3, 1}, 8192},
              {"cylinder", {"radius", "height"}, {"slices", "stacks"}, {3, 1}, 8192},
              {"torus", {"tube radius", "ring radius"}, {"sides", "rings"}, {3, 3}, 8192},
              {"disc", {"radius"}, {"slices", "loops"}, {3, 1}, 8192},
              {"quad", {NULL}, {"divisions"}, {1}, 8192},
              {"teapot", {"size"}, {"divisions"}, {2}, 512},
              {"tetrahedron", {"radius"}, {NULL}, {0}, 0},
              {"octahedron", {"radius"}, {NULL}, {0}, 0},
              {"dodecahedron", {"radius"}, {NULL}, {0}, 0},
              {"icosahedron", {"radius"}, {NULL}, {0}, 0}};

TEST(lengths_and_counts_out_of_range_are_refused)
{
    static const double bad[] = {0, -0.0, -1, NAN, INFINITY, -INFINITY, 1e-60, 1e60};
    for (int shape = 0; shape < (int)(sizeof SHAPES / sizeof SHAPES[0]); shape++)
        for (int which = 0; which < 2; which++) {
            for (size_t i = 0; i < sizeof bad / sizeof bad[0] && SHAPES[shape].lengths[which];
                 i++) {
                const double length[2] = {which ? 1 : bad[i], which ? bad[i] : 1};
                CHECK_REFUSED(make(mesh, shape, length, (const int[2]){8, 8}, message),
                              "%s: %s %g: must be more than 0 and finite", SHAPES[shape].name,
                              SHAPES[shape].lengths[which], bad[i]);
            }
            for (int high = 0; high < 2 && SHAPES[shape].counts[which]; high++) {
                const int min = SHAPES[shape].min[which], max = SHAPES[shape].max;
                const int n = high ? max + 1 : min - 1;
                const int count[2] = {which ? 8 : n, which ? n : 8};
                CHECK_REFUSED(make(mesh, shape, (const double[2]){0.5, 1}, count, message),
                              "%s: %d %s: must be %d to %d", SHAPES[shape].name, n,
                              SHAPES[shape].counts[which], min, max);
            }
        }
}

TEST(a_torus_too_thin_or_too_thick_is_refused)
{
    static const double bad[] = {1, 2, 0.0009};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK_REFUSED(mesh_torus(mesh, bad[i], 1, 8, 8, message),
                      "torus: tube radius %g: must be less than the ring radius, 1, and at least "
                      "1/1000 of it",
                      bad[i]);
    }
}

TEST_MAIN("mesh solids", NULL, NULL)
