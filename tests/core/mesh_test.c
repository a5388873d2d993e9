/*
 * The shapes: every vertex, every triangle, and what they enclose. No GL.
 */
#include "base/sanitized.h"
#include "core/mesh_make.h"
#include "support/testing.h"
#include "support/topology.h"

#include <float.h>
#include <sys/resource.h>

/* The cube. */

TEST(the_cube_has_the_corners_normals_and_split_of_the_lecture)
{
    static const char corners[6][4][4] = {
        {"+++", "-++", "--+", "+-+"}, {"+++", "+-+", "+--", "++-"}, {"+++", "++-", "-+-", "-++"},
        {"-++", "-+-", "---", "--+"}, {"---", "+--", "+-+", "--+"}, {"+--", "---", "-+-", "++-"}};
    static const float normals[6][3] = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                        {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    static const uint32_t split[6] = {0, 1, 2, 0, 2, 3};
    static const double half_sides[] = {1, 2, 0.1, 1e-30, 1e30};
    for (size_t h = 0; h < sizeof half_sides / sizeof half_sides[0]; h++) {
        CLOSED(mesh_close) Mesh mesh;
        const float half = (float)half_sides[h];
        SUCCEEDS(mesh_cube(&mesh, half_sides[h], message));
        assert_int_equal(mesh.vertex_count, 24);
        assert_int_equal(mesh.index_count, 36);
        for (uint32_t v = 0; v < 24; v++) {
            const char *signs = corners[v / 4][v % 4];
            for (int axis = 0; axis < 3; axis++) {
                assert_true(mesh.vertices[v].position[axis] == (signs[axis] == '+' ? half : -half));
                assert_true(mesh.vertices[v].normal[axis] == normals[v / 4][axis]);
            }
        }
        for (uint32_t i = 0; i < 36; i++)
            assert_int_equal(mesh.indices[i], 4 * (i / 6) + split[i % 6]);
    }
}

/* The sphere. */

typedef struct Tessellation {
    int slices, stacks;
    double radius;
} Tessellation;

static const Tessellation TESSELLATIONS[] = {
    {3, 2, 1},     {3, 3, 0.1},     {4, 2, 3},        {13, 13, 1},     {64, 32, 1e6},
    {5, 100, 0.7}, {255, 256, 1.0}, {256, 255, 1e-6}, {8192, 2, 1e20}, {3, 8192, 1e-18}};
enum { TESSELLATION_COUNT = sizeof TESSELLATIONS / sizeof TESSELLATIONS[0] };

static void open_sphere(Mesh *mesh, Tessellation t)
{
    Message message = {0};
    if (!mesh_sphere(mesh, t.radius, t.slices, t.stacks, &message))
        fail_msg("%dx%d: %s", t.slices, t.stacks, message.text);
}

TEST(a_sphere_has_the_documented_vertices)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        const Tessellation t = TESSELLATIONS[n];
        const size_t row = (size_t)t.slices + 1;
        CLOSED(mesh_close) Mesh mesh;
        open_sphere(&mesh, t);
        assert_int_equal(mesh.vertex_count, row * ((size_t)t.stacks + 1));
        assert_int_equal(mesh.index_count, 6 * (size_t)t.slices * ((size_t)t.stacks - 1));
        for (int j = 0; j <= t.stacks; j++)
            for (int i = 0; i <= t.slices; i++) {
                const double a = 2 * PI * i / t.slices, b = PI * j / t.stacks;
                const double expected[3] = {sin(a) * sin(b), cos(b), cos(a) * sin(b)};
                const MeshVertex *v = &mesh.vertices[(size_t)j * row + (size_t)i];
                for (int axis = 0; axis < 3; axis++) {
                    /* Half a step of a float below 1, and what is left of sin(pi) in double. */
                    assert_true(fabs(v->normal[axis] - expected[axis]) <= FLT_EPSILON / 4 + 1e-15);
                    /* That, and half a step of the position, whatever its power of two. */
                    assert_true(fabs(v->position[axis] / t.radius - v->normal[axis]) <=
                                FLT_EPSILON * 3 / 4 + 1e-15);
                }
            }
        topology_check_sound(&mesh);
    }
}

TEST(the_seam_and_the_poles_of_a_sphere_are_equal_bit_for_bit)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        const Tessellation t = TESSELLATIONS[n];
        const size_t row = (size_t)t.slices + 1, last = row * (size_t)t.stacks;
        const float radius = (float)t.radius;
        const MeshVertex north = {{0, radius, 0}, {0, 1, 0}}, south = {{0, -radius, 0}, {0, -1, 0}};
        CLOSED(mesh_close) Mesh mesh;
        open_sphere(&mesh, t);
        for (size_t first = 0; first <= last; first += row)
            assert_memory_equal(&mesh.vertices[first], &mesh.vertices[first + row - 1],
                                sizeof(MeshVertex));
        for (size_t i = 0; i < row; i++) {
            assert_memory_equal(&mesh.vertices[i], &north, sizeof north);
            assert_memory_equal(&mesh.vertices[last + i], &south, sizeof south);
        }
    }
}

TEST(a_sphere_is_closed_turned_outwards_and_has_no_triangle_without_area)
{
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        CLOSED(mesh_close) Mesh mesh;
        open_sphere(&mesh, TESSELLATIONS[n]);
        topology_check_indices(&mesh);
        /* For a convex shape around the origin. */
        for (size_t i = 0; i < mesh.index_count; i++) {
            const Vec3 face = topology_face(&mesh, i / 3);
            assert_true(vec3_length(face) > 0);
            assert_true(vec3_dot(topology_corner(&mesh, i), face) > 0);
        }
        assert_int_equal(topology_open_edges(&mesh), 0);
    }
}

TEST(a_sphere_too_large_for_memory_is_rejected)
{
    if (ADDRESS_SANITIZER)
        skip(); /* it ends the process where memory does */
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    /* 8192 x 8192 divisions want 3.2 GB, of which none is touched here. */
    const struct rlimit small = {.rlim_cur = (rlim_t)1 << 30, .rlim_max = before.rlim_max};
    Mesh mesh;
    Message message = {0};
    assert_int_equal(setrlimit(RLIMIT_AS, &small), 0);
    const bool opened = mesh_sphere(&mesh, 1, MESH_SPHERE_MAX, MESH_SPHERE_MAX, &message);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_false(opened);
    topology_check_zeroed(&mesh);
    assert_string_equal(message.text,
                        "mesh: not enough memory for 67125249 vertices and 402604032 indices");
}

/* The lecture's sphere. */

TEST(the_lecture_sphere_has_the_numbers_of_the_lecture)
{
    static const int divisions[] = {13, 3, 20, 100};
    for (size_t d = 0; d < sizeof divisions / sizeof divisions[0]; d++) {
        const int n = divisions[d];
        CLOSED(mesh_close) Mesh mesh;
        assert_true(mesh_sphere_lecture(&mesh, n, NULL));
        assert_int_equal(mesh.vertex_count, (n + 1) * (n + 1));
        assert_int_equal(mesh.index_count, 6 * n * n);
        const MeshVertex *v = mesh.vertices;
        for (int j = 0; j <= n; j++)
            for (int i = 0; i <= n; i++, v++) {
                const double a = 2 * PI * i / n, b = PI * j / n;
                const float expected[3] = {(float)(sin(a) * sin(b)), (float)cos(b),
                                           (float)(cos(a) * sin(b))};
                for (int axis = 0; axis < 3; axis++) /* the same formula, rounded once */
                    assert_true(v->position[axis] == expected[axis]);
                assert_memory_equal(v->normal, v->position, sizeof v->normal);
            }
        const uint32_t *index = mesh.indices;
        for (uint32_t j = 0; j < (uint32_t)n; j++)
            for (uint32_t i = 0; i < (uint32_t)n; i++, index += 6) {
                const uint32_t p1 = j * ((uint32_t)n + 1) + i, p2 = p1 + (uint32_t)n + 1;
                const uint32_t expected[6] = {p1, p2, p1 + 1, p1 + 1, p2, p2 + 1};
                assert_memory_equal(index, expected, sizeof expected);
            }
    }
}

/* Arguments and closing. */

TEST(a_cube_of_no_size_is_refused)
{
    static const double bad[] = {0, -0.0, -1, NAN, INFINITY, -INFINITY, 1e-60, 1e60};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK_REFUSED(mesh_cube(mesh, bad[i], message),
                      "cube: half side %g: must be more than 0 and finite", bad[i]);
    }
}

TEST(a_sphere_of_bad_arguments_is_refused)
{
    static const struct {
        Tessellation tessellation;
        const char *message;
    } bad[] = {
        {{13, 13, 0}, "sphere: radius 0: must be more than 0 and finite"},
        {{13, 13, -1}, "sphere: radius -1: must be more than 0 and finite"},
        {{13, 13, NAN}, "sphere: radius nan: must be more than 0 and finite"},
        {{13, 13, INFINITY}, "sphere: radius inf: must be more than 0 and finite"},
        {{13, 13, 1e-60}, "sphere: radius 1e-60: must be more than 0 and finite"},
        {{13, 13, 1e60}, "sphere: radius 1e+60: must be more than 0 and finite"},
        {{2, 13, 1}, "sphere: 2 slices: must be 3 to 8192"},
        {{0, 13, 1}, "sphere: 0 slices: must be 3 to 8192"},
        {{INT32_MIN, 13, 1}, "sphere: -2147483648 slices: must be 3 to 8192"},
        {{8193, 13, 1}, "sphere: 8193 slices: must be 3 to 8192"},
        {{13, 1, 1}, "sphere: 1 stacks: must be 2 to 8192"},
        {{13, -5, 1}, "sphere: -5 stacks: must be 2 to 8192"},
        {{13, 8193, 1}, "sphere: 8193 stacks: must be 2 to 8192"},
        {{13, INT32_MAX, 1}, "sphere: 2147483647 stacks: must be 2 to 8192"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const Tessellation t = bad[i].tessellation;
        CHECK_REFUSED(mesh_sphere(mesh, t.radius, t.slices, t.stacks, message), "%s",
                      bad[i].message);
    }
}

TEST(a_lecture_sphere_of_bad_divisions_is_refused)
{
    static const int bad[] = {2, 1, 0, -1, INT32_MIN, 8193, INT32_MAX};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK_REFUSED(mesh_sphere_lecture(mesh, bad[i], message),
                      "sphere: %d divisions: must be 3 to 8192", bad[i]);
    }
}

/* Copies, colors, and one color per triangle. */

/* A sphere with a color at each vertex that no other has. */
static void open_colored(Mesh *mesh)
{
    SUCCEEDS(mesh_sphere(mesh, 1, 8, 4, message) && mesh_open_colors(mesh, message));
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        mesh->colors[i][0] = (float)i / (float)mesh->vertex_count;
        mesh->colors[i][1] = 1 - mesh->colors[i][0];
    }
}

TEST(colors_are_black_at_first_and_stay)
{
    CLOSED(mesh_close) Mesh mesh;
    SUCCEEDS(mesh_cube(&mesh, 1, message));
    assert_null(mesh.colors);
    SUCCEEDS(mesh_open_colors(&mesh, message));
    for (size_t i = 0; i < mesh.vertex_count; i++)
        for (int k = 0; k < 3; k++)
            assert_true(mesh.colors[i][k] == 0);
    mesh.colors[7][1] = 0.5F;
    SUCCEEDS(mesh_open_colors(&mesh, message));
    assert_true(mesh.colors[7][1] == 0.5F);
}

TEST(colors_that_are_none_are_refused)
{
    static const float wrong[] = {-0.001F, 1.001F, NAN, INFINITY};
    CLOSED(mesh_close) Mesh mesh;
    open_colored(&mesh);
    SUCCEEDS(mesh_check(&mesh, message));
    for (int i = 0; i < 4; i++) {
        mesh.colors[3][2] = wrong[i];
        FAILS_WITH(mesh_check(&mesh, message) || mesh_flatten(&mesh, NULL) ||
                       mesh_provoke(&mesh, NULL),
                   "mesh: vertex 3: color (");
    }
}

TEST(a_copy_of_a_mesh_has_all_of_it_in_other_places)
{
    for (int kind = 0; kind < 3; kind++) {
        CLOSED(mesh_close) Mesh mesh;
        CLOSED(mesh_close) Mesh copy;
        open_colored(&mesh);
        if (kind == 2)
            SUCCEEDS(mesh_provoke(&mesh, message));
        if (kind == 0) {
            free(mesh.colors);
            mesh.colors = NULL;
        }
        SUCCEEDS(mesh_copy(&copy, &mesh, message));
        const size_t count = mesh.vertex_count, size = count * sizeof *mesh.colors;
        assert_int_equal(copy.vertex_count, count);
        assert_int_equal(copy.index_count, mesh.index_count);
        assert_memory_equal(copy.vertices, mesh.vertices, count * sizeof *mesh.vertices);
        assert_memory_equal(copy.indices, mesh.indices, mesh.index_count * sizeof *mesh.indices);
        assert_ptr_not_equal(copy.vertices, mesh.vertices);
        assert_true((copy.colors != NULL) == (kind > 0));
        assert_true((copy.lit_positions != NULL) == (kind == 2));
        if (kind > 0)
            assert_memory_equal(copy.colors, mesh.colors, size);
        if (kind == 2)
            assert_memory_equal(copy.lit_positions, mesh.lit_positions, size);
        assert_true(!copy.colors || copy.colors != mesh.colors);
    }
}

/* Its vertices are in the places of the triangle's, and lit as the last. */
TEST(provoked_triangles_are_lit_as_their_last_vertex)
{
    CLOSED(mesh_close) Mesh mesh;
    CLOSED(mesh_close) Mesh made;
    open_colored(&mesh);
    SUCCEEDS(mesh_copy(&made, &mesh, message) && mesh_provoke(&made, message));
    assert_int_equal(made.index_count, mesh.index_count);
    assert_int_equal(made.vertex_count, mesh.index_count);
    for (size_t i = 0; i < mesh.index_count; i++) {
        const uint32_t own = mesh.indices[i], last = mesh.indices[i / 3 * 3 + 2];
        const uint32_t k = made.indices[i];
        assert_memory_equal(made.vertices[k].position, mesh.vertices[own].position, 12);
        assert_memory_equal(made.vertices[k].normal, mesh.vertices[last].normal, 12);
        assert_memory_equal(made.lit_positions[k], mesh.vertices[last].position, 12);
        assert_memory_equal(made.colors[k], mesh.colors[last], 12);
    }
}

TEST(flat_triangles_keep_their_colors)
{
    CLOSED(mesh_close) Mesh mesh;
    CLOSED(mesh_close) Mesh flat;
    open_colored(&mesh);
    SUCCEEDS(mesh_copy(&flat, &mesh, message) && mesh_flatten(&flat, message));
    assert_int_equal(flat.index_count, mesh.index_count);
    for (size_t i = 0; i < mesh.index_count; i++)
        assert_memory_equal(flat.colors[flat.indices[i]], mesh.colors[mesh.indices[i]], 12);
}

TEST(a_mesh_may_be_closed_twice_and_nothing_may_be_closed)
{
    Mesh mesh = {0};
    mesh_close(NULL);
    mesh_close(&mesh);
    assert_true(mesh_cube(&mesh, 1, NULL));
    mesh_close(&mesh);
    topology_check_zeroed(&mesh);
    mesh_close(&mesh);
    topology_check_zeroed(&mesh);
}

/* Zero has two signs. */
TEST(vertices_that_are_equal_as_numbers_are_welded)
{
    MeshVertex vertices[] = {{{0, 1, 2}, {0, 0, 1}},
                             {{1, 1, 2}, {0, 0, 1}},
                             {{-0.0F, 1, 2}, {1, 0, 0}},
                             {{1, 1, 2}, {0, -0.0F, 1}}};
    const Mesh mesh = {.vertices = vertices, .vertex_count = 4};
    uint32_t first[4];
    assert_true(mesh_weld(&mesh, false, first));
    assert_memory_equal(first, ((const uint32_t[]){0, 1, 0, 1}), sizeof first);
    assert_true(mesh_weld(&mesh, true, first));
    assert_memory_equal(first, ((const uint32_t[]){0, 1, 2, 1}), sizeof first);
}

int main(void)
{
    return testing_run(0, "mesh", NULL, NULL);
}
