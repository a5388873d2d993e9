/*
 * The shapes: every vertex, every triangle, and what they enclose. No GL.
 */
#include "mesh.h"
#include "sanitized.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* The product of two floats is exact in double; sums and differences of three of them lose at most
 * a few of its last bits. */
typedef struct Vector {
    double x, y, z;
} Vector;

static Vector vector(const float v[3])
{
    return (Vector){v[0], v[1], v[2]};
}

static Vector minus(Vector a, Vector b)
{
    return (Vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static Vector cross(Vector a, Vector b)
{
    return (Vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double dot(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double length(Vector a)
{
    return sqrt(dot(a, a));
}

typedef struct Triangle {
    Vector a, b, c;
    Vector normal; /* its length is twice the area */
} Triangle;

static Triangle triangle(const Mesh *mesh, size_t number)
{
    const uint32_t *index = &mesh->indices[3 * number];
    Triangle t = {vector(mesh->vertices[index[0]].position),
                  vector(mesh->vertices[index[1]].position),
                  vector(mesh->vertices[index[2]].position),
                  {0, 0, 0}};
    t.normal = cross(minus(t.b, t.a), minus(t.c, t.a));
    return t;
}

static double area(const Mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->index_count / 3; i++)
        sum += length(triangle(mesh, i).normal) / 2;
    return sum;
}

/* By the divergence theorem: the signed volumes of the tetrahedra from the origin. */
static double volume(const Mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->index_count / 3; i++) {
        const Triangle t = triangle(mesh, i);
        sum += dot(t.a, t.normal) / 6;
    }
    return sum;
}

static void assert_indices_in_range(const Mesh *mesh)
{
    assert_int_equal(mesh->index_count % 3, 0);
    for (size_t i = 0; i < mesh->index_count; i++)
        assert_true(mesh->indices[i] < mesh->vertex_count);
}

/* A shape that holds the origin and is convex: outwards is away from the origin. */
static void assert_counter_clockwise_from_outside(const Mesh *mesh)
{
    for (size_t i = 0; i < mesh->index_count / 3; i++) {
        const Triangle t = triangle(mesh, i);
        assert_true(length(t.normal) > 0);
        assert_true(dot(t.a, t.normal) > 0 && dot(t.b, t.normal) > 0 && dot(t.c, t.normal) > 0);
    }
}

static const Mesh *sorted_mesh;

static int compare_positions(const void *a, const void *b)
{
    return memcmp(sorted_mesh->vertices[*(const uint32_t *)a].position,
                  sorted_mesh->vertices[*(const uint32_t *)b].position,
                  sizeof sorted_mesh->vertices->position);
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

/* A number for each vertex, the same where the bits of the position are. */
static uint32_t *number_positions(const Mesh *mesh)
{
    uint32_t *order = calloc(mesh->vertex_count, sizeof *order);
    uint32_t *numbers = calloc(mesh->vertex_count, sizeof *numbers);
    assert_true(order && numbers);
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        order[i] = i;
    sorted_mesh = mesh;
    qsort(order, mesh->vertex_count, sizeof *order, compare_positions);
    for (size_t i = 1; i < mesh->vertex_count; i++)
        numbers[order[i]] =
            numbers[order[i - 1]] + (compare_positions(&order[i - 1], &order[i]) != 0);
    free(order);
    return numbers;
}

/* Every edge belongs to two triangles, which run through it in opposite directions: the surface has
 * no hole, no fold and no triangle twice. */
static void assert_closed(const Mesh *mesh)
{
    uint32_t *numbers = number_positions(mesh);
    uint64_t *edges = calloc(mesh->index_count, sizeof *edges);
    assert_non_null(edges);
    for (size_t i = 0; i < mesh->index_count; i++) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        edges[i] = (uint64_t)numbers[mesh->indices[i]] << 32 | numbers[mesh->indices[next]];
    }
    qsort(edges, mesh->index_count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < mesh->index_count; i++) {
        const uint64_t back = edges[i] << 32 | edges[i] >> 32;
        assert_true(i == 0 || edges[i] != edges[i - 1]);
        assert_non_null(bsearch(&back, edges, mesh->index_count, sizeof back, compare_edges));
    }
    free(edges);
    free(numbers);
}

static void assert_zeroed(const Mesh *mesh)
{
    assert_null(mesh->vertices);
    assert_null(mesh->indices);
    assert_int_equal(mesh->vertex_count, 0);
    assert_int_equal(mesh->index_count, 0);
}

/* The cube. */

static void the_cube_has_the_corners_normals_and_split_of_the_lecture(void **state)
{
    (void)state;
    static const char corners[6][4][4] = {
        {"+++", "-++", "--+", "+-+"}, {"+++", "+-+", "+--", "++-"}, {"+++", "++-", "-+-", "-++"},
        {"-++", "-+-", "---", "--+"}, {"---", "+--", "+-+", "--+"}, {"+--", "---", "-+-", "++-"}};
    static const float normals[6][3] = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                        {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    static const uint32_t split[6] = {0, 1, 2, 0, 2, 3};
    static const double half_sides[] = {1, 2, 0.1, 1e-30, 1e30};
    for (size_t h = 0; h < sizeof half_sides / sizeof half_sides[0]; h++) {
        Mesh mesh;
        Message message = {0};
        const float half = (float)half_sides[h];
        assert_true(mesh_cube(&mesh, half_sides[h], &message));
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
        mesh_close(&mesh);
    }
}

static void the_cube_is_closed_and_turns_its_triangles_outwards(void **state)
{
    (void)state;
    Mesh mesh;
    assert_true(mesh_cube(&mesh, 1.5, NULL));
    assert_indices_in_range(&mesh);
    assert_counter_clockwise_from_outside(&mesh);
    assert_closed(&mesh);
    for (size_t i = 0; i < 12; i++) {
        const Triangle t = triangle(&mesh, i);
        const Vector normal = vector(mesh.vertices[mesh.indices[3 * i]].normal);
        assert_true(dot(t.normal, normal) == length(t.normal));
    }
    /* 1.5 and what is made of it here have few bits: nothing is rounded. */
    assert_true(area(&mesh) == 6 * 9);
    assert_true(volume(&mesh) == 27);
    mesh_close(&mesh);
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

static void a_sphere_has_its_vertices_where_the_header_says(void **state)
{
    (void)state;
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        const Tessellation t = TESSELLATIONS[n];
        const size_t row = (size_t)t.slices + 1;
        Mesh mesh;
        open_sphere(&mesh, t);
        assert_int_equal(mesh.vertex_count, row * ((size_t)t.stacks + 1));
        assert_int_equal(mesh.index_count, 6 * (size_t)t.slices * ((size_t)t.stacks - 1));
        for (int j = 0; j <= t.stacks; j++) {
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
                /* Three components, each wrong by at most a quarter of FLT_EPSILON: sqrt(3) / 4. */
                assert_true(fabs(length(vector(v->normal)) - 1) <= 0.44 * FLT_EPSILON);
            }
        }
        mesh_close(&mesh);
    }
}

static void the_seam_and_the_poles_of_a_sphere_are_equal_bit_for_bit(void **state)
{
    (void)state;
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        const Tessellation t = TESSELLATIONS[n];
        const size_t row = (size_t)t.slices + 1, last = row * (size_t)t.stacks;
        const float radius = (float)t.radius;
        const MeshVertex north = {{0, radius, 0}, {0, 1, 0}}, south = {{0, -radius, 0}, {0, -1, 0}};
        Mesh mesh;
        open_sphere(&mesh, t);
        for (size_t first = 0; first <= last; first += row)
            assert_memory_equal(&mesh.vertices[first], &mesh.vertices[first + row - 1],
                                sizeof(MeshVertex));
        for (size_t i = 0; i < row; i++) {
            assert_memory_equal(&mesh.vertices[i], &north, sizeof north);
            assert_memory_equal(&mesh.vertices[last + i], &south, sizeof south);
        }
        mesh_close(&mesh);
    }
}

static void a_sphere_is_closed_turned_outwards_and_has_no_triangle_without_area(void **state)
{
    (void)state;
    for (int n = 0; n < TESSELLATION_COUNT; n++) {
        Mesh mesh;
        open_sphere(&mesh, TESSELLATIONS[n]);
        assert_indices_in_range(&mesh);
        assert_counter_clockwise_from_outside(&mesh);
        assert_closed(&mesh);
        mesh_close(&mesh);
    }
}

static void area_and_volume_of_a_sphere_converge_with_the_square_of_the_divisions(void **state)
{
    (void)state;
    double area_before = 0, volume_before = 0;
    for (int divisions = 16; divisions <= 256; divisions *= 2) {
        Mesh mesh;
        open_sphere(&mesh, (Tessellation){divisions, divisions, 2});
        const double area_error = 4 * PI * 4 - area(&mesh);
        const double volume_error = 4 * PI * 8 / 3 - volume(&mesh);
        mesh_close(&mesh);
        assert_true(area_error > 0 && volume_error > 0); /* all of it is inside the sphere */
        /* Twice the divisions, a quarter of the error, but for a term of the fourth order: its part
         * is about the square of the angle of a division, (2 pi / 16)^2 = 0.15 at the coarsest. */
        if (divisions > 16) {
            assert_true(fabs(area_before / area_error - 4) < 0.15);
            assert_true(fabs(volume_before / volume_error - 4) < 0.15);
        }
        area_before = area_error;
        volume_before = volume_error;
    }
}

static void a_sphere_of_three_million_vertices_has_all_its_triangles(void **state)
{
    (void)state;
    Mesh mesh;
    open_sphere(&mesh, (Tessellation){2000, 1500, 1});
    assert_int_equal(mesh.vertex_count, 2001 * 1501);
    assert_int_equal(mesh.index_count, 6 * 2000 * 1499);
    assert_indices_in_range(&mesh);
    assert_counter_clockwise_from_outside(&mesh);
    /* A quad of angles h and k lacks less than (h^2 + k^2) / 2 of its area and of its volume. */
    const double lack = (pow(2 * PI / 2000, 2) + pow(PI / 1500, 2)) / 2;
    assert_true(fabs(area(&mesh) / (4 * PI) - 1) < lack);
    assert_true(fabs(volume(&mesh) / (4 * PI / 3) - 1) < lack);
    mesh_close(&mesh);
}

static void a_sphere_too_big_for_the_memory_is_refused(void **state)
{
    (void)state;
    if (ADDRESS_SANITIZER)
        skip(); /* it ends the process where memory does */
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    /* 8192 x 8192 divisions want 3.2 GB, of which none is touched here. */
    const struct rlimit small = {.rlim_cur = (rlim_t)1 << 30, .rlim_max = before.rlim_max};
    Mesh mesh;
    Message message = {0};
    assert_int_equal(setrlimit(RLIMIT_AS, &small), 0);
    const bool opened = mesh_sphere(&mesh, 1, MESH_SPHERE_MOST, MESH_SPHERE_MOST, &message);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_false(opened);
    assert_zeroed(&mesh);
    assert_string_equal(message.text,
                        "mesh: not enough memory for 67125249 vertices and 402604032 indices");
}

/* The lecture's sphere. */

static void the_lecture_sphere_has_the_numbers_of_the_lecture(void **state)
{
    (void)state;
    static const int divisions[] = {13, 3, 20, 100};
    for (size_t d = 0; d < sizeof divisions / sizeof divisions[0]; d++) {
        const int n = divisions[d];
        Mesh mesh;
        assert_true(mesh_sphere_lecture(&mesh, n, NULL));
        assert_int_equal(mesh.vertex_count, (n + 1) * (n + 1));
        assert_int_equal(mesh.index_count, 6 * n * n);
        const MeshVertex *v = mesh.vertices;
        for (int j = 0; j <= n; j++) {
            for (int i = 0; i <= n; i++, v++) {
                const double a = 2 * PI * i / n, b = PI * j / n;
                const float expected[3] = {(float)(sin(a) * sin(b)), (float)cos(b),
                                           (float)(cos(a) * sin(b))};
                for (int axis = 0; axis < 3; axis++) /* the same formula, rounded once */
                    assert_true(v->position[axis] == expected[axis]);
                assert_memory_equal(v->normal, v->position, sizeof v->normal);
            }
        }
        const uint32_t *index = mesh.indices;
        for (uint32_t j = 0; j < (uint32_t)n; j++) {
            for (uint32_t i = 0; i < (uint32_t)n; i++, index += 6) {
                const uint32_t p1 = j * ((uint32_t)n + 1) + i, p2 = p1 + (uint32_t)n + 1;
                const uint32_t expected[6] = {p1, p2, p1 + 1, p1 + 1, p2, p2 + 1};
                assert_memory_equal(index, expected, sizeof expected);
            }
        }
        mesh_close(&mesh);
    }
}

static void the_lecture_sphere_is_the_sphere_and_triangles_without_area_at_the_poles(void **state)
{
    (void)state;
    enum { DIVISIONS = 13 };
    Mesh lecture, sphere;
    assert_true(mesh_sphere_lecture(&lecture, DIVISIONS, NULL));
    open_sphere(&sphere, (Tessellation){DIVISIONS, DIVISIONS, 1});
    size_t kept = 0;
    for (size_t i = 0; i < lecture.index_count; i += 3) {
        /* The poles' vertices are apart by what is left of sin(pi), 1.2e-16: so are their areas
         * nothing against those of the other triangles, the smallest of which is 0.01. */
        if (length(triangle(&lecture, i / 3).normal) < 1e-6)
            continue;
        assert_memory_equal(&lecture.indices[i], &sphere.indices[kept],
                            3 * sizeof *lecture.indices);
        kept += 3;
    }
    assert_int_equal(kept, sphere.index_count);
    assert_int_equal(lecture.vertex_count, sphere.vertex_count);
    for (size_t i = 0; i < sphere.vertex_count; i++) {
        const Vector apart =
            minus(vector(lecture.vertices[i].position), vector(sphere.vertices[i].position));
        /* The seam: 13 * 2 pi / 13 is 2 pi to a step of a double, 8.9e-16. */
        assert_true(length(apart) < 1.2e-15);
    }
    mesh_close(&lecture);
    mesh_close(&sphere);
}

/* Arguments and closing. */

static void a_cube_of_no_size_is_refused(void **state)
{
    (void)state;
    static const double bad[] = {0, -0.0, -1, NAN, INFINITY, -INFINITY, 1e-60, 1e60};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        Mesh mesh;
        Message message = {0};
        char expected[128];
        memset(&mesh, 0xa5, sizeof mesh);
        assert_false(mesh_cube(&mesh, bad[i], &message));
        assert_zeroed(&mesh);
        snprintf(expected, sizeof expected, "cube: half side %g: must be more than 0 and finite",
                 bad[i]);
        assert_string_equal(message.text, expected);
    }
}

static void a_sphere_of_bad_arguments_is_refused(void **state)
{
    (void)state;
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
        Mesh mesh;
        Message message = {0};
        memset(&mesh, 0xa5, sizeof mesh);
        assert_false(mesh_sphere(&mesh, t.radius, t.slices, t.stacks, &message));
        assert_zeroed(&mesh);
        assert_string_equal(message.text, bad[i].message);
    }
}

static void a_lecture_sphere_of_bad_divisions_is_refused(void **state)
{
    (void)state;
    static const int bad[] = {2, 1, 0, -1, INT32_MIN, 8193, INT32_MAX};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        Mesh mesh;
        Message message = {0};
        char expected[128];
        memset(&mesh, 0xa5, sizeof mesh);
        assert_false(mesh_sphere_lecture(&mesh, bad[i], &message));
        assert_zeroed(&mesh);
        snprintf(expected, sizeof expected, "sphere: %d divisions: must be 3 to 8192", bad[i]);
        assert_string_equal(message.text, expected);
    }
}

static void a_mesh_may_be_closed_twice_and_nothing_may_be_closed(void **state)
{
    (void)state;
    Mesh mesh = {0};
    mesh_close(NULL);
    mesh_close(&mesh);
    assert_true(mesh_cube(&mesh, 1, NULL));
    mesh_close(&mesh);
    assert_zeroed(&mesh);
    mesh_close(&mesh);
    assert_zeroed(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cube_has_the_corners_normals_and_split_of_the_lecture),
        cmocka_unit_test(the_cube_is_closed_and_turns_its_triangles_outwards),
        cmocka_unit_test(a_sphere_has_its_vertices_where_the_header_says),
        cmocka_unit_test(the_seam_and_the_poles_of_a_sphere_are_equal_bit_for_bit),
        cmocka_unit_test(a_sphere_is_closed_turned_outwards_and_has_no_triangle_without_area),
        cmocka_unit_test(area_and_volume_of_a_sphere_converge_with_the_square_of_the_divisions),
        cmocka_unit_test(a_sphere_of_three_million_vertices_has_all_its_triangles),
        cmocka_unit_test(a_sphere_too_big_for_the_memory_is_refused),
        cmocka_unit_test(the_lecture_sphere_has_the_numbers_of_the_lecture),
        cmocka_unit_test(the_lecture_sphere_is_the_sphere_and_triangles_without_area_at_the_poles),
        cmocka_unit_test(a_cube_of_no_size_is_refused),
        cmocka_unit_test(a_sphere_of_bad_arguments_is_refused),
        cmocka_unit_test(a_lecture_sphere_of_bad_divisions_is_refused),
        cmocka_unit_test(a_mesh_may_be_closed_twice_and_nothing_may_be_closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
