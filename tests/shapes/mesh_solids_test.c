/*
 * The solids, the teapot, and operations on any mesh: faces, bounds, normals. No GL.
 */
#include "base/sanitized.h"
#include "shapes/mesh_solids.h"
#include "support/testing.h"
#include "support/topology.h"

#include <float.h>

static const double PI = 3.14159265358979323846;

/* Half a step of a float below 1, plus the error of sine and cosine in double. */
static const double ROUNDED = FLT_EPSILON / 4 + 1e-15;

static unsigned short seed[3];

/* Unit normals, triangles with an area that are counter-clockwise on the side of their corners'
 * normals, and the given number of open edges. */
static void assert_sound(const Mesh *mesh, size_t boundary)
{
    topology_check_sound(mesh);
    for (size_t triangle = 0; triangle < mesh->index_count / 3; triangle++) {
        const Vec3 face = topology_face(mesh, triangle);
        assert_true(vec3_length(face) > 0);
        for (size_t i = 3 * triangle; i < 3 * triangle + 3; i++)
            assert_true(vec3_dot(face, vec3_from_float(mesh->vertices[mesh->indices[i]].normal)) >
                        0);
    }
    assert_int_equal(topology_open_edges(mesh), boundary);
}

/* Each of `rows` rows ends with its first vertex. */
static void assert_seam(const MeshVertex *vertices, size_t rows, size_t columns)
{
    for (size_t j = 0; j < rows; j++)
        assert_memory_equal(&vertices[j * (columns + 1)], &vertices[j * (columns + 1) + columns],
                            sizeof *vertices);
}

/* `value` is `expected` to within `tolerance`, relative. */
static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%.17g instead of %.17g", value, expected);
}

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
    for (int n = 0; n <= TESSELLATION_COUNT; n++) {
        for (int s = 0; s < SIZE_COUNT; s++) {
            const bool halving = n == TESSELLATION_COUNT; /* the textbook's rings */
            const Tessellation t = halving ? (Tessellation){64, 5} : TESSELLATIONS[n];
            const double r = SIZES[s], h = 2.5 * r;
            const size_t row = (size_t)t.around + 1, side = row * ((size_t)t.along + 1);
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(
                mesh_cone(&mesh, r, h, t.around, halving ? MESH_CONE_HALVING : t.along, message));
            assert_int_equal(mesh.vertex_count, side + 2 * row);
            assert_seam(mesh.vertices, (size_t)t.along + 3, row - 1);
            assert_sound(&mesh, 0);
            for (size_t i = row; i < side; i++) {
                const Vec3 p = vec3_from_float(mesh.vertices[i].position);
                const double wide = hypot(p.x, p.y);
                assert_on_surface(&mesh.vertices[i], wide + r * p.z / h - r,
                                  (Vec3){p.x / wide, p.y / wide, r / h}, h);
            }
            for (size_t i = 0; i < row; i++) { /* the apex: vertex i + 1 is that of slice i */
                const MeshVertex apex = {{0, 0, (float)h}, {0, 0, 0}};
                const double a = 2 * PI * ((double)i - 0.5) / t.around, l = hypot(r, h);
                const Vec3 normal = {h / l * cos(a), h / l * sin(a), r / l};
                assert_memory_equal(mesh.vertices[i].position, apex.position, sizeof apex.position);
                assert_true(topology_distance(vec3_from_float(mesh.vertices[i].normal), normal) <=
                            2 * ROUNDED);
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
}

TEST(a_cylinder_lies_on_its_surface_with_the_normals_of_it)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        for (int s = 0; s < SIZE_COUNT; s++) {
            const Tessellation t = TESSELLATIONS[n];
            const double r = SIZES[s], h = 0.7 * r;
            const size_t row = (size_t)t.around + 1, side = row * ((size_t)t.along + 1);
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_cylinder(&mesh, (MeshCylinder){r, h, t.around, t.along, MESH_CAP_BOTH},
                                   message));
            assert_int_equal(mesh.vertex_count, side + 4 * row);
            assert_seam(mesh.vertices, (size_t)t.along + 5, row - 1);
            for (size_t i = 0; i < side; i++) {
                const Vec3 p = vec3_from_float(mesh.vertices[i].position);
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
            assert_sound(&mesh, (size_t)t.around * (size_t)(!bottom + !top));
            assert_near(topology_area(&mesh), side + (bottom + top) * polygon(t.around) * r * r,
                        4 * FLT_EPSILON);
            /* Seen from the origin, in the plane of the bottom: the bottom contributes nothing;
             * side and top enclose two thirds and one third of the prism. */
            assert_near(topology_volume(&mesh), polygon(t.around) * r * r * h * (2 + top) / 3,
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
    for (int n = 1; n < TESSELLATION_COUNT; n++) {
        for (int s = 0; s < SIZE_COUNT; s++) {
            const int rings = TESSELLATIONS[n].around;
            const int sides = TESSELLATIONS[n].along < 3 ? 3 : TESSELLATIONS[n].along;
            const double ring = SIZES[s], tube = thickness[s % 3] * ring;
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_torus(&mesh, tube, ring, sides, rings, message));
            assert_int_equal(mesh.vertex_count, (rings + 1) * (sides + 1));
            assert_int_equal(mesh.index_count, 6 * rings * sides);
            assert_seam(mesh.vertices, (size_t)sides + 1, (size_t)rings);
            if (thickness[s % 3] == 0.3)
                assert_sound(&mesh, 0);
            assert_memory_equal(mesh.vertices, mesh.vertices + (rings + 1) * sides,
                                ((size_t)rings + 1) * sizeof *mesh.vertices);
            for (size_t i = 0; i < mesh.vertex_count; i++) {
                /* The vector from the middle of the tube; the thinner the tube, the larger its
                 * relative rounding error. */
                const Vec3 p = vec3_from_float(mesh.vertices[i].position);
                const double wide = hypot(p.x, p.y);
                const Vec3 middle = {ring * p.x / wide, ring * p.y / wide, 0};
                const Vec3 out = vec3_scale(vec3_subtract(p, middle), 1 / tube);
                const double part = FLT_EPSILON * (1 + ring / tube);
                assert_true(fabs(vec3_length(out) - 1) <= part);
                if (wide > 0.01 * ring) /* near the axis it has no accurate direction */
                    assert_true(topology_distance(out, vec3_from_float(mesh.vertices[i].normal)) <=
                                2 * part);
            }
        }
    }
}

TEST(a_disc_is_a_polygon_that_faces_up)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        for (int s = 0; s < SIZE_COUNT; s++) {
            const Tessellation t = TESSELLATIONS[n];
            const double r = SIZES[s];
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_disc(&mesh, r, t.around, t.along, message));
            assert_int_equal(mesh.vertex_count, (t.around + 1) * (t.along + 1));
            assert_int_equal(mesh.index_count, 3 * t.around * (2 * t.along - 1));
            assert_seam(mesh.vertices, (size_t)t.along + 1, (size_t)t.around);
            assert_sound(&mesh, (size_t)t.around);
            assert_near(topology_area(&mesh), polygon(t.around) * r * r, 4 * FLT_EPSILON);
            for (size_t i = 0; i < mesh.vertex_count; i++) {
                const Vec3 p = vec3_from_float(mesh.vertices[i].position);
                const double loop = (double)(i / ((size_t)t.around + 1)) / t.along;
                const double angle = 2 * PI * (double)(i % ((size_t)t.around + 1)) / t.around;
                const Vec3 expected = {r * loop * cos(angle), r * loop * sin(angle), 0};
                assert_true(topology_distance(p, expected) <= 4 * r * ROUNDED && p.z == 0);
                assert_true(mesh.vertices[i].normal[2] == 1);
            }
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
        assert_sound(&mesh, 4 * (size_t)d);
        assert_near(topology_area(&mesh), 4, 4 * FLT_EPSILON);
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
        if (topology_distance(vec3_scale(vec3_from_float(mesh->vertices[i].position), 1 / radius),
                              unit) < 1e-6)
            return true;
    return false;
}

TEST(regular_solids_are_regular)
{
    for (int n = 0; n < REGULAR_COUNT; n++) {
        for (int s = 0; s < SIZE_COUNT; s++) {
            const double r = SIZES[s];
            const size_t sides = (size_t)REGULAR[n].sides, faces = (size_t)REGULAR[n].faces;
            CLOSED(mesh_close) Mesh mesh;
            SUCCEEDS(mesh_regular(&mesh, (MeshRegular)n, r, message));
            assert_int_equal(mesh.vertex_count, faces * sides);
            assert_int_equal(mesh.index_count, 3 * faces * (sides - 2));
            assert_sound(&mesh, 0);
            assert_near(topology_volume(&mesh), REGULAR[n].volume * r * r * r, 4 * FLT_EPSILON);
            for (size_t i = 0; i < mesh.vertex_count; i++) {
                const size_t next = i % sides == sides - 1 ? i + 1 - sides : i + 1;
                const Vec3 p = vec3_from_float(mesh.vertices[i].position);
                const Vec3 q = vec3_from_float(mesh.vertices[next].position);
                const Vec3 normal = vec3_from_float(mesh.vertices[i].normal);
                assert_near(vec3_length(p), r, FLT_EPSILON);
                assert_near(topology_distance(p, q), REGULAR[n].edge * r, 2 * FLT_EPSILON);
                /* Flat: the normal is the face's, perpendicular to its edges. */
                assert_true(fabs(vec3_dot(vec3_subtract(q, p), normal)) <= 4 * FLT_EPSILON * r);
                assert_memory_equal(mesh.vertices[i].normal, mesh.vertices[next].normal,
                                    sizeof mesh.vertices[i].normal);
                /* Convex: no corner is above a face. */
                for (size_t other = 0; other < mesh.vertex_count; other++)
                    assert_true(
                        vec3_dot(vec3_subtract(vec3_from_float(mesh.vertices[other].position), p),
                                 normal) <= 4 * FLT_EPSILON * r);
            }
            assert_true(has_corner(&mesh, REGULAR[n].corner, r));
            assert_false(has_corner(&mesh, REGULAR[n].no_corner, r));
        }
    }
}

/* The teapot. */

/* Its grids: columns around, rows down; the mirror plane contains column 0 and the middle column.
 */
static const struct {
    const char *name;
    int down, around;
} PARTS[] = {{"body", 4, 4}, {"lid", 2, 4}, {"handle", 2, 2}, {"spout", 2, 2}};
enum { PART_COUNT = sizeof PARTS / sizeof PARTS[0], BODY = 0, LID, HANDLE, SPOUT };

static Mesh teapot(double size, int divisions)
{
    Mesh mesh;
    SUCCEEDS(mesh_teapot(&mesh, size, divisions, message));
    return mesh;
}

/* Vertex (row, column) of a part; both may be fractions of a patch's divisions. */
static const MeshVertex *part_vertex(const Mesh *mesh, int divisions, int part, int row, int column)
{
    size_t first = 0;
    for (int i = 0; i < part; i++)
        first +=
            (size_t)(PARTS[i].down * divisions + 1) * (size_t)(PARTS[i].around * divisions + 1);
    return &mesh->vertices[first + (size_t)row * (size_t)(PARTS[part].around * divisions + 1) +
                           (size_t)column];
}

TEST(a_teapot_has_32_patches_whose_seams_are_equal_bit_for_bit)
{
    static const int divisions[] = {2, 3, 8, 14, 33};
    for (size_t n = 0; n < sizeof divisions / sizeof divisions[0]; n++) {
        const int d = divisions[n];
        CLOSED(mesh_close) Mesh mesh = teapot(1, d);
        size_t vertex_count = 0, patches = 0;
        for (int part = 0; part < PART_COUNT; part++) {
            const size_t rows = (size_t)(PARTS[part].down * d + 1);
            const size_t columns = (size_t)(PARTS[part].around * d);
            assert_seam(mesh.vertices + vertex_count, rows, columns);
            vertex_count += rows * (columns + 1);
            patches += (size_t)(PARTS[part].down * PARTS[part].around);
        }
        assert_int_equal(patches, MESH_TEAPOT_PATCHES);
        assert_int_equal(mesh.vertex_count, vertex_count);
        /* Two triangles for each part of each patch; at each of the two poles one less. */
        assert_int_equal(mesh.index_count, 3 * (MESH_TEAPOT_PATCHES * 2 * d * d - 2 * 4 * d));
        /* Open: rim and lid, and the two ends of both tubes. */
        assert_int_equal(topology_open_edges(&mesh), 2 * 4 * d + 2 * 2 * 2 * d);
        for (size_t i = 0; i < mesh.index_count / 3; i++)
            assert_true(vec3_length(topology_face(&mesh, i)) > 0);
    }
}

TEST(a_teapot_turns_its_triangles_outwards)
{
    /* If coarser, some triangles lie across the surface where handle and lid bend most. */
    static const int divisions[] = {8, 14, 40};
    for (size_t n = 0; n < sizeof divisions / sizeof divisions[0]; n++) {
        const int d = divisions[n];
        CLOSED(mesh_close) Mesh mesh = teapot(1, d);
        assert_sound(&mesh, 16 * (size_t)d);
        /* Within a part all triangles have the side of their normals, and no edge joins two that
         * disagree: one normal of each part tells. */
        static const struct {
            int part, row, column; /* in halves of a patch */
            Vec3 side;
        } outer[] = {{BODY, 4, 4, {-1, 0, 0}},
                     {LID, 3, 0, {0, 1, 0}},
                     {HANDLE, 2, 1, {0, 0, 1}},
                     {SPOUT, 1, 1, {0, 0, 1}}};
        for (int i = 0; i < PART_COUNT; i++) {
            const MeshVertex *vertex =
                part_vertex(&mesh, d, outer[i].part, outer[i].row * d / 2, outer[i].column * d / 2);
            assert_true(vec3_dot(vec3_from_float(vertex->normal), outer[i].side) > 0.5);
        }
    }
}

/* By hand, from Newell's control points: in the middle of a patch's side a cubic is (a + 3b +
 * 3c + d) / 8; in the middle of a quarter turn x = y = (4 + 3 * 0.56) / 8 radius. Here as (x, z
 * - 1.5, -y) / 2. Rows and columns in halves of a patch. */
static const struct {
    int part, row, column;
    Vec3 position;
} KNOWN[] = {
    {BODY, 0, 0, {0.7, 0.45, 0}},
    {BODY, 1, 0, {0.7015625, 0.49921875, 0}},
    {BODY, 3, 0, {0.921875, 0.0609375, 0}},
    {BODY, 3, 1, {0.65453125, 0.0609375, -0.65453125}},
    {BODY, 4, 2, {0, -0.3, -1}},
    {BODY, 4, 4, {-1, -0.3, 0}},
    {BODY, 4, 6, {0, -0.3, 1}},
    {BODY, 5, 0, {0.875, -0.5578125, 0}},
    {BODY, 7, 1, {0.455953125, -0.7265625, -0.455953125}},
    {BODY, 8, 0, {0, -0.75, 0}},
    {LID, 0, 0, {0, 0.825, 0}},
    {LID, 1, 0, {0.1625, 0.740625, 0}},
    {LID, 1, 1, {0.115515625, 0.740625, -0.115515625}},
    {LID, 2, 0, {0.1, 0.6, 0}},
    {LID, 3, 0, {0.4125, 0.525, 0}},
    {LID, 4, 2, {0, 0.45, -0.65}},
    {HANDLE, 0, 0, {-0.75, 0.375, 0}},
    {HANDLE, 0, 2, {-0.8, 0.2625, 0}},
    {HANDLE, 1, 0, {-1.3125, 0.346875, 0}},
    {HANDLE, 1, 1, {-1.259375, 0.29765625, 0.1125}},
    {HANDLE, 2, 0, {-1.5, 0.15, 0}},
    {HANDLE, 2, 1, {-1.425, 0.15, 0.1125}},
    {HANDLE, 3, 0, {-1.365625, -0.17109375, 0}},
    {HANDLE, 3, 2, {-1.26875, -0.075, 0}},
    {HANDLE, 3, 3, {-1.3171875, -0.123046875, -0.1125}},
    {HANDLE, 4, 2, {-1, -0.3, 0}},
    {SPOUT, 0, 0, {0.85, -0.45, 0}},
    {SPOUT, 1, 0, {1.34375, -0.028125, 0}},
    {SPOUT, 1, 1, {1.26875, 0.0609375, 0.170625}},
    {SPOUT, 1, 2, {1.19375, 0.15, 0}},
    {SPOUT, 2, 2, {1.35, 0.45, 0}},
    {SPOUT, 3, 0, {1.7140625, 0.488671875, 0}},
    {SPOUT, 3, 1, {1.56328125, 0.4833984375, 0.075}},
    {SPOUT, 3, 2, {1.4125, 0.478125, 0}},
    {SPOUT, 4, 0, {1.6, 0.45, 0}},
    {SPOUT, 4, 1, {1.5, 0.45, 0.05625}},
    {SPOUT, 4, 3, {1.5, 0.45, -0.05625}},
};

TEST(a_teapot_passes_through_known_points)
{
    static const double sizes[] = {1, 0.3, 1e-15, 1e20};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        const int divisions = 10;
        CLOSED(mesh_close) Mesh mesh = teapot(sizes[s], divisions);
        for (size_t i = 0; i < sizeof KNOWN / sizeof KNOWN[0]; i++) {
            const MeshVertex *vertex =
                part_vertex(&mesh, divisions, KNOWN[i].part, KNOWN[i].row * divisions / 2,
                            KNOWN[i].column * divisions / 2);
            const Vec3 p = vec3_scale(vec3_from_float(vertex->position), 1 / sizes[s]);
            /* Coordinates below 2 are rounded to float once: half a step in each. */
            if (!(topology_distance(p, KNOWN[i].position) <= FLT_EPSILON))
                fail_msg("%s %d %d: %.9g %.9g %.9g", PARTS[KNOWN[i].part].name, KNOWN[i].row,
                         KNOWN[i].column, p.x, p.y, p.z);
        }
    }
}

/* The sine of the angle between the normal and the surface, estimated from the neighbours on both
 * sides in one direction. */
static double tilt(const MeshVertex *before, const MeshVertex *vertex, const MeshVertex *after)
{
    const Vec3 along =
        vec3_subtract(vec3_from_float(after->position), vec3_from_float(before->position));
    return fabs(vec3_dot(along, vec3_from_float(vertex->normal))) / vec3_length(along);
}

static double worst_tilt(int divisions)
{
    Mesh mesh = teapot(1, divisions);
    double worst = 0;
    for (int part = 0; part < PART_COUNT; part++) {
        for (int row = 0; row < PARTS[part].down * divisions; row++) {
            for (int column = 0; column < PARTS[part].around * divisions; column++) {
                const MeshVertex *at = part_vertex(&mesh, divisions, part, row, column);
                /* The spacing changes across the side of a patch. */
                if (column % divisions > 0 && !(part == LID && row == 0))
                    worst = fmax(worst, tilt(at - 1, at, at + 1));
                if (row % divisions > 0)
                    worst =
                        fmax(worst, tilt(part_vertex(&mesh, divisions, part, row - 1, column), at,
                                         part_vertex(&mesh, divisions, part, row + 1, column)));
            }
        }
    }
    mesh_close(&mesh);
    return worst;
}

TEST(the_normals_of_a_teapot_are_perpendicular_to_it)
{
    double before = 0;
    for (int divisions = 16; divisions <= 128; divisions *= 2) {
        const double worst = worst_tilt(divisions);
        print_message("%d divisions: differences are %.3g off at most\n", divisions, worst);
        /* Central differences of a cubic have an error of second order, so a quarter each time,
         * plus that of rounded positions, which weighs more the closer they are. */
        if (before > 0)
            assert_true(worst < before / 3.3);
        before = worst;
    }
    assert_true(before < 1e-3);
}

TEST(the_poles_of_a_teapot_have_the_normals_of_the_limit)
{
    const MeshVertex tip = {{0, 0.825F, 0}, {0, 1, 0}}, bottom = {{0, -0.75F, 0}, {0, -1, 0}};
    static const int divisions[] = {2, 7, 256};
    double before = 2;
    for (size_t n = 0; n < sizeof divisions / sizeof divisions[0]; n++) {
        const int d = divisions[n];
        CLOSED(mesh_close) Mesh mesh = teapot(1, d);
        double farthest = 0;
        for (int column = 0; column <= 4 * d; column++) {
            assert_memory_equal(part_vertex(&mesh, d, LID, 0, column), &tip, sizeof tip);
            assert_memory_equal(part_vertex(&mesh, d, BODY, 4 * d, column), &bottom, sizeof bottom);
            const Vec3 lid = vec3_from_float(part_vertex(&mesh, d, LID, 1, column)->normal);
            const Vec3 body =
                vec3_from_float(part_vertex(&mesh, d, BODY, 4 * d - 1, column)->normal);
            farthest = fmax(farthest, fmax(topology_distance(lid, (Vec3){0, 1, 0}),
                                           topology_distance(body, (Vec3){0, -1, 0})));
        }
        assert_true(farthest < before); /* the neighbours move to it */
        before = farthest;
    }
    /* The outline falls by 3 * 0.3 t^2 over a distance of 2.4 t: a slope of 0.75 t. */
    assert_near(before, 0.75 / 256, 0.02);
}

/* Any mesh. */

TEST(bounds_contain_all_vertices)
{
    MeshVertex vertices[] = {{{1, -2, 3}, {0, 0, 1}}, {{-4, 5, 0.5F}, {0, 0, 1}}};
    MeshBox box = mesh_bounds(&(Mesh){.vertices = vertices, .vertex_count = 2});
    assert_true(box.low.x == -4 && box.low.y == -2 && box.low.z == 0.5);
    assert_true(box.high.x == 1 && box.high.y == 5 && box.high.z == 3);
    box = mesh_bounds(&(Mesh){.vertices = vertices, .vertex_count = 1});
    assert_true(topology_distance(box.low, box.high) == 0 && box.low.z == 3);
    box = mesh_bounds(&(Mesh){.vertices = NULL});
    assert_true(vec3_length(box.low) == 0 && vec3_length(box.high) == 0);
}

TEST(a_flat_mesh_has_its_triangles_and_their_normals)
{
    CLOSED(mesh_close) Mesh smooth = teapot(1, 6), flat = teapot(1, 6);
    const size_t count = smooth.index_count;
    for (int twice = 0; twice < 2; twice++) {
        assert_true(mesh_flatten(&flat, NULL));
        assert_int_equal(flat.index_count, count);
        assert_int_equal(flat.vertex_count, count);
        for (size_t i = 0; i < count; i++) {
            Vec3 normal;
            assert_int_equal(flat.indices[i], i);
            assert_memory_equal(flat.vertices[i].position,
                                smooth.vertices[smooth.indices[i]].position,
                                sizeof flat.vertices[i].position);
            assert_true(mesh_face(&smooth, i / 3, &normal));
            assert_true(topology_distance(vec3_from_float(flat.vertices[i].normal), normal) <=
                        2 * ROUNDED);
            assert_true(fabs(vec3_dot(topology_face(&smooth, i / 3), normal) -
                             vec3_length(topology_face(&smooth, i / 3))) < 1e-15);
        }
    }
}

TEST(a_flat_sphere_has_no_triangle_without_area)
{
    Mesh sphere;
    /* The lecture's sphere has 2 * 13 at the poles. At the south pole sin(pi) is not quite 0, so in
     * floats these triangles are slivers; at the north pole the area is exactly 0. */
    assert_true(mesh_sphere_lecture(&sphere, 13, NULL));
    const size_t before = sphere.index_count / 3;
    size_t without = 0;
    for (size_t i = 0; i < before; i++) {
        Vec3 normal;
        without += !mesh_face(&sphere, i, &normal);
    }
    assert_true(without >= 13);
    assert_true(mesh_flatten(&sphere, NULL));
    assert_int_equal(sphere.index_count / 3, before - without);
    for (size_t i = 0; i < sphere.index_count / 3; i++)
        assert_true(vec3_length(topology_face(&sphere, i)) > 0);
    mesh_close(&sphere);
}

static const MeshWeight WEIGHTS[] = {MESH_WEIGHT_ANGLE, MESH_WEIGHT_AREA, MESH_WEIGHT_MAX};

/* Merges vertices at the same place, and clears the normals. */
static void weld(Mesh *mesh)
{
    uint32_t *vertex = topology_representatives(mesh);
    for (size_t i = 0; i < mesh->index_count; i++)
        mesh->indices[i] = vertex[mesh->indices[i]];
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].normal[0] = NAN;
    free(vertex);
}

/* How far the normals of a welded mesh are from the true ones, which are a copy. */
static double worst_normal(const Mesh *welded, const Mesh *truth)
{
    double worst = 0;
    for (size_t i = 0; i < welded->index_count; i++)
        worst = fmax(
            worst, topology_distance(vec3_from_float(welded->vertices[welded->indices[i]].normal),
                                     vec3_from_float(truth->vertices[welded->indices[i]].normal)));
    return worst;
}

TEST(angle_weights_do_not_depend_on_how_faces_are_triangulated)
{
    const double third = 1 / sqrt(3);
    double worst[3] = {0, 0, 0};
    for (int round = 0; round < 64; round++) {
        for (int w = 0; w < 3; w++) {
            CLOSED(mesh_close) Mesh mesh;
            assert_true(mesh_cube(&mesh, 1, NULL));
            for (uint32_t face = 0; face < 6; face++) {
                static const uint32_t other[6] = {1, 2, 3, 1, 3, 0};
                if (round >> face & 1)
                    for (uint32_t i = 0; i < 6; i++)
                        mesh.indices[6 * face + i] = 4 * face + other[i];
            }
            weld(&mesh);
            assert_true(mesh_compute_normals(&mesh, WEIGHTS[w], false, NULL));
            for (size_t i = 0; i < mesh.index_count; i++) {
                const MeshVertex *vertex = &mesh.vertices[mesh.indices[i]];
                const Vec3 exact = vec3_scale(vec3_from_float(vertex->position), third);
                worst[w] =
                    fmax(worst[w], topology_distance(exact, vec3_from_float(vertex->normal)));
            }
        }
    }
    print_message("corners of a cube are off by %.3g (angle), %.3g (area), %.3g (Max)\n", worst[0],
                  worst[1], worst[2]);
    assert_true(worst[MESH_WEIGHT_ANGLE] <= 2 * ROUNDED);
    /* In the worst case two of three faces give a corner twice the area: (2, 2, 1) / 3 or (1, 1, 2)
     * / sqrt(6). */
    assert_near(worst[MESH_WEIGHT_AREA], sqrt(2 - 2 * 4 / sqrt(6) * third), 1e-6);
}

/* A sphere whose vertices, except the poles, have been moved on it at random by up to a fifth of
 * the distance to the next; with or without its exact normals. */
static void open_irregular_sphere(Mesh *mesh, Mesh *truth, int divisions)
{
    assert_true(mesh_sphere(mesh, 1, divisions, divisions, NULL));
    assert_true(mesh_sphere(truth, 1, divisions, divisions, NULL));
    weld(mesh);
    weld(truth);
    for (int j = 1; j < divisions; j++) {
        for (int i = 0; i <= divisions; i++) {
            const size_t number = (size_t)(j * (divisions + 1) + i);
            const double a = 2 * PI * (i + 0.4 * (erand48(seed) - 0.5)) / divisions;
            const double b = PI * (j + 0.4 * (erand48(seed) - 0.5)) / divisions;
            const Vec3 p = {sin(a) * sin(b), cos(b), cos(a) * sin(b)};
            vec3_to_float(p, mesh->vertices[number].position);
        }
    }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        vec3_to_float(vec3_from_float(mesh->vertices[i].position), truth->vertices[i].normal);
}

TEST(max_weights_are_exact_on_any_triangulated_sphere)
{
    for (int divisions = 8; divisions <= 32; divisions *= 2) {
        double worst[3];
        for (int w = 0; w < 3; w++) {
            CLOSED(mesh_close) Mesh mesh, truth;
            open_irregular_sphere(&mesh, &truth, divisions);
            assert_true(mesh_compute_normals(&mesh, WEIGHTS[w], false, NULL));
            worst[w] = worst_normal(&mesh, &truth);
        }
        print_message("%d divisions: off by %.3g (angle), %.3g (area), %.3g (Max)\n", divisions,
                      worst[0], worst[1], worst[2]);
        /* The effect of rounding a sphere's positions on Max's normals: an error of at most
         * FLT_EPSILON / 2 relative to the shortest edges, those around the poles, which are 2 pi /
         * n * sin(pi / n) long, or 0.6 of that where vertices were moved. */
        assert_true(worst[MESH_WEIGHT_MAX] <=
                    FLT_EPSILON / 2 / (0.6 * 2 * PI / divisions * sin(PI / divisions)));
        assert_true(worst[MESH_WEIGHT_ANGLE] > 0.01 && worst[MESH_WEIGHT_AREA] > 0.01);
    }
}

TEST(triangles_without_area_do_not_count)
{
    for (int w = 0; w < 3; w++) {
        CLOSED(mesh_close) Mesh with, without;
        assert_true(mesh_torus(&with, 0.5, 1, 8, 8, NULL));
        assert_true(mesh_torus(&without, 0.5, 1, 8, 8, NULL));
        /* The same triangles, and before each of them three that have collapsed to its edges. */
        uint32_t *indices = calloc(4 * with.index_count, sizeof *indices);
        assert_non_null(indices);
        for (size_t i = 0; i < with.index_count; i += 3) {
            const uint32_t *c = &with.indices[i];
            const uint32_t all[12] = {c[0], c[1], c[0], c[1], c[2], c[2],
                                      c[0], c[0], c[0], c[0], c[1], c[2]};
            memcpy(indices + 4 * i, all, sizeof all);
        }
        free(with.indices);
        with.indices = indices;
        with.index_count *= 4;
        assert_true(mesh_compute_normals(&with, WEIGHTS[w], false, NULL));
        assert_true(mesh_compute_normals(&without, WEIGHTS[w], false, NULL));
        assert_memory_equal(with.vertices, without.vertices,
                            with.vertex_count * sizeof *with.vertices);
    }
}

TEST(a_cancelled_normal_is_the_first_faces_and_an_unused_one_is_up)
{
    for (int w = 0; w < 3; w++) {
        /* Both sides of a sheet in a plane that is no coordinate plane; a vertex that no triangle
         * uses, and one used only by a triangle without area. */
        MeshVertex vertices[] = {{{0.1F, 0.2F, 0.3F}, {1, 0, 0}},
                                 {{1.7F, 0.1F, 0.9F}, {1, 0, 0}},
                                 {{0.4F, 2.3F, 1.1F}, {1, 0, 0}},
                                 {{9, 9, 9}, {1, 0, 0}},
                                 {{5, 5, 5}, {1, 0, 0}}};
        uint32_t indices[] = {0, 1, 2, 1, 0, 2, 0, 4, 4};
        Mesh mesh = {.vertices = vertices, .indices = indices, .vertex_count = 5, .index_count = 9};
        Vec3 first;
        assert_true(mesh_face(&mesh, 0, &first));
        assert_true(mesh_compute_normals(&mesh, WEIGHTS[w], false, NULL));
        for (int i = 0; i < 3; i++)
            assert_true(topology_distance(vec3_from_float(vertices[i].normal), first) <=
                        2 * ROUNDED);
        for (int i = 3; i < 5; i++)
            assert_true(vertices[i].normal[0] == 0 && vertices[i].normal[2] == 1);
        assert_false(mesh_face(&mesh, 2, &first));
        assert_true(vec3_length(first) == 0);
    }
    assert_true(mesh_compute_normals(&(Mesh){.vertices = NULL}, MESH_WEIGHT_ANGLE, false, NULL));
}

TEST(normals_do_not_depend_on_the_size_of_a_mesh)
{
    /* Powers of two, so that nothing else is rounded. */
    static const double sizes[] = {0x1p-100, 0x1p100};
    for (int w = 0; w < 3; w++) {
        for (int s = 0; s < 2; s++) {
            CLOSED(mesh_close) Mesh mesh = teapot(1, 5), scaled = teapot(sizes[s], 5);
            assert_true(mesh_compute_normals(&mesh, WEIGHTS[w], false, NULL));
            assert_true(mesh_compute_normals(&scaled, WEIGHTS[w], false, NULL));
            for (size_t i = 0; i < mesh.vertex_count; i++)
                assert_memory_equal(mesh.vertices[i].normal, scaled.vertices[i].normal,
                                    sizeof mesh.vertices[i].normal);
        }
    }
}

TEST(out_of_memory_leaves_a_mesh_unchanged)
{
    if (ADDRESS_SANITIZER) /* it ends the process when memory is exhausted */
        skip();
    /* Sizes that exceed any machine's memory; nothing is allocated. */
    const Mesh huge = {.vertex_count = SIZE_MAX / sizeof(MeshVertex), .index_count = SIZE_MAX / 64};
    Mesh mesh = huge;
    Message message = {0};
    assert_false(mesh_flatten(&mesh, &message));
    assert_memory_equal(&mesh, &huge, sizeof mesh);
    assert_memory_equal(message.text, "mesh: not enough memory for ", 28);
    message = (Message){0};
    assert_false(mesh_compute_normals(&mesh, MESH_WEIGHT_ANGLE, false, &message));
    assert_memory_equal(&mesh, &huge, sizeof mesh);
    assert_memory_equal(message.text, "mesh: not enough memory for the normals of ", 43);
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
    for (int shape = 0; shape < (int)(sizeof SHAPES / sizeof SHAPES[0]); shape++) {
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

int main(void)
{
    testing_seed48(seed);
    return testing_run(0, "mesh solids", NULL, NULL);
}
