/*
 * Operations on any mesh: faces, bounds, normals. No GL.
 */
#include "base/sanitized.h"
#include "shapes/mesh_solids.h"
#include "support/testing.h"
#include "support/topology.h"

#include <float.h>

/* Half a step of a float below 1, plus the error of sine and cosine in double. */
static const double ROUNDED = FLT_EPSILON / 4 + 1e-15;

static unsigned short seed[3];

static Mesh teapot(double size, int divisions)
{
    Mesh mesh;
    SUCCEEDS(mesh_teapot(&mesh, size, divisions, message));
    return mesh;
}

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
            assert_true(topology_distance(topology_normal(&flat, i), normal) <= 2 * ROUNDED);
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
        worst = fmax(worst, topology_distance(topology_normal(welded, welded->indices[i]),
                                              topology_normal(truth, welded->indices[i])));
    return worst;
}

TEST(angle_weights_do_not_depend_on_how_faces_are_triangulated)
{
    const double third = 1 / sqrt(3);
    double worst[3] = {0, 0, 0};
    for (int round = 0; round < 64; round++)
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
    print_message("corners of a cube are off by %.3g (angle), %.3g (area), %.3g (Max)\n", worst[0],
                  worst[1], worst[2]);
    assert_true(worst[MESH_WEIGHT_ANGLE] <= 2 * ROUNDED);
    /* In the worst case two of three faces give a corner twice the area: (2, 2, 1) / 3 or (1, 1, 2)
     * / sqrt(6). */
    testing_near(worst[MESH_WEIGHT_AREA], sqrt(2 - 2 * 4 / sqrt(6) * third), 1e-6);
}

/* A sphere whose vertices, except the poles, have been moved on it at random by up to a fifth of
 * the distance to the next; with or without its exact normals. */
static void open_irregular_sphere(Mesh *mesh, Mesh *truth, int divisions)
{
    assert_true(mesh_sphere(mesh, 1, divisions, divisions, NULL));
    assert_true(mesh_sphere(truth, 1, divisions, divisions, NULL));
    weld(mesh);
    weld(truth);
    for (int j = 1; j < divisions; j++)
        for (int i = 0; i <= divisions; i++) {
            const size_t number = (size_t)(j * (divisions + 1) + i);
            const double a = 2 * PI * (i + 0.4 * (erand48(seed) - 0.5)) / divisions;
            const double b = PI * (j + 0.4 * (erand48(seed) - 0.5)) / divisions;
            const Vec3 p = {sin(a) * sin(b), cos(b), cos(a) * sin(b)};
            vec3_to_float(p, mesh->vertices[number].position);
        }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        vec3_to_float(topology_position(mesh, i), truth->vertices[i].normal);
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
    for (int w = 0; w < 3; w++)
        for (int s = 0; s < 2; s++) {
            CLOSED(mesh_close) Mesh mesh = teapot(1, 5), scaled = teapot(sizes[s], 5);
            assert_true(mesh_compute_normals(&mesh, WEIGHTS[w], false, NULL));
            assert_true(mesh_compute_normals(&scaled, WEIGHTS[w], false, NULL));
            for (size_t i = 0; i < mesh.vertex_count; i++)
                assert_memory_equal(mesh.vertices[i].normal, scaled.vertices[i].normal,
                                    sizeof mesh.vertices[i].normal);
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

int main(void)
{
    testing_seed48(seed);
    return testing_run(0, "mesh normals", NULL, NULL);
}
