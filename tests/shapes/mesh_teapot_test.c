/*
 * The teapot: its patches, seams, known points and normals. No GL.
 */
#include "shapes/mesh_solids.h"
#include "support/testing.h"
#include "support/topology.h"

#include <float.h>

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
            topology_check_seam(mesh.vertices + vertex_count, rows, columns);
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
        topology_check_outward(&mesh, 16 * (size_t)d);
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
    for (int part = 0; part < PART_COUNT; part++)
        for (int row = 0; row < PARTS[part].down * divisions; row++)
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
    testing_near(before, 0.75 / 256, 0.02);
}

TEST_MAIN("mesh teapot", NULL, NULL)
