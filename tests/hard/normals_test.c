/*
 * Hard cases of normals: of no length, very short and very long, cancelled between the corners,
 * turned the wrong way, turned over at silhouettes, mirrored.
 */
#include "hard.h"

#include "picture_check.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 48, SEED = 20140101 };

/* (|light| + |point| + d) / d on a unit sphere, or on a quad of that size, in hard_world. */
static const double REACH = 4;

static Hard hard;
static HardWorld world;
static Mesh sphere, quad, tube;
static Mesh made; /* by a test, until forget */

static int open_all(void **state)
{
    Message message = {0};
    (void)state;
    hard_open(&hard, SIZE, SIZE);
    if (mesh_sphere(&sphere, 1, 24, 12, &message) && mesh_quad(&quad, 2, &message) &&
        mesh_cylinder(&tube, 0.8, 1.6, 24, 4, MESH_CAP_NONE, &message))
        return 0;
    printf("%s\n", message.text);
    return 1;
}

static int close_all(void **state)
{
    (void)state;
    mesh_close(&tube);
    mesh_close(&quad);
    mesh_close(&sphere);
    hard_close(&hard);
    return 0;
}

static int forget_made(void **state)
{
    (void)state;
    hard_forget(&hard, &made);
    mesh_close(&made);
    if (hard.bytes.width != SIZE)
        hard_resize(&hard, SIZE, SIZE);
    return 0;
}

/* `made`, a copy, in the world. */
static void make_copy(const Mesh *mesh)
{
    forget_made(NULL);
    assert_true(mesh_open(&made, mesh->vertex_count, mesh->index_count, NULL));
    memcpy(made.vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    memcpy(made.indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    hard_world(&world, &made);
}

static void scale_normal(MeshVertex *vertex, float factor)
{
    for (int axis = 0; axis < 3; axis++)
        vertex->normal[axis] *= factor;
}

static void scale_normals(float factor)
{
    for (size_t i = 0; i < made.vertex_count; i++)
        scale_normal(&made.vertices[i], factor);
}

static void check(const char *name, int least_pixels)
{
    hard_check_reflections(&hard, name, &world, REACH, least_pixels);
}

static void a_normal_of_no_length_gives_ambient_light_exactly(void **state)
{
    (void)state;
    make_copy(&sphere);
    scale_normals(0);
    world.lights[0].ambient = (Vec3){0.25, 0.5, 0};
    world.scene.global_ambient = (Vec3){0, 0, 0};
    world.objects[0].front.ambient = (Vec3){1, 1, 1};
    world.objects[0].front.emission = (Vec3){0, 0, 0.75};
    check("zero normals", SIZE * SIZE / 4);
    for (int precision = 0; precision < 2; precision++) {
        for (int way = 0; way < 3; way++) {
            world.scene.interpolation = way == 1 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            world.objects[0].world_from_object =
                mat4_scale(way == 2 ? (Vec3){1, 0.5, 2} : (Vec3){1, 1, 1});
            hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
            const unsigned char *middle =
                (unsigned char *)hard.image.pixels + 4 * (SIZE / 2 * SIZE + SIZE / 2);
            assert_int_equal(middle[0], 64);  /* 63.75 */
            assert_int_equal(middle[1], 128); /* 127.5 goes to the even one */
            assert_int_equal(middle[2], 191); /* 191.25 */
        }
    }
    hard_report(&hard, "normals of no length");
}

static void normals_of_any_length_are_those_of_length_one(void **state)
{
    (void)state;
    for (int exponent = -20; exponent <= 20; exponent += 4) {
        make_copy(&sphere);
        scale_normals(powf(10, (float)exponent));
        check("normals' lengths", SIZE * SIZE / 8);
        world.objects[0].world_from_object = mat4_scale((Vec3){1, 0.6, 0.8});
        check("normals' lengths, scaled", SIZE * SIZE / 8);
    }
    hard_report(&hard, "normals of lengths 1e-20 to 1e20");
}

/* At every vertex another length: nothing of that may be left between them. */
static void lengths_that_differ_do_not_matter(void **state)
{
    HardRandom random = {SEED};
    (void)state;
    printf("seed %d\n", SEED);
    make_copy(&sphere);
    for (size_t i = 0; i < made.vertex_count; i++)
        scale_normal(&made.vertices[i], (float)pow(10, hard_random(&random, -3, 3)));
    check("lengths that differ", SIZE * SIZE / 8);
    hard_report(&hard, "normals of differing lengths");
}

static void a_transform_of_any_size_lights_alike(void **state)
{
    (void)state;
    for (int exponent = -20; exponent <= 20; exponent += 5) {
        const double factor = pow(10, exponent);
        forget_made(NULL);
        assert_true(mesh_sphere(&made, 1 / factor, 24, 12, NULL));
        hard_world(&world, &made);
        world.objects[0].world_from_object = mat4_scale((Vec3){factor, factor, factor});
        char name[64];
        snprintf(name, sizeof name, "transform of size 1e%d", exponent);
        check(name, SIZE * SIZE / 8);
        world.objects[0].world_from_object =
            mat4_scale((Vec3){factor, 0.6 * factor, -0.8 * factor});
        check(name, SIZE * SIZE / 8);
    }
    hard_report(&hard, "transforms of sizes 1e-20 to 1e20");
}

/* A sphere that its mesh has flattened and its transform restores. */
static void a_transform_may_stretch_by_any_factor(void **state)
{
    (void)state;
    for (int exponent = -14; exponent <= 14; exponent += 4) {
        const double factor = pow(10, exponent);
        char name[64];
        make_copy(&sphere);
        for (size_t i = 0; i < made.vertex_count; i++) {
            MeshVertex *vertex = &made.vertices[i];
            const float *n = vertex->normal;
            Vec3 normal;
            vec3_normalize((Vec3){(double)n[0] * factor, (double)n[1], (double)n[2]}, &normal);
            vec3_to_float(normal, vertex->normal);
            vertex->position[0] = (float)((double)vertex->position[0] / factor);
        }
        world.objects[0].world_from_object = mat4_scale((Vec3){factor, 1, 1});
        snprintf(name, sizeof name, "transform that stretches by 1e%d", exponent);
        check(name, SIZE * SIZE / 8);
    }
    hard_report(&hard, "transforms that stretch by 1e-14 to 1e14");
}

/* Opposite normals at the left and at the right of a quad: in the middle they cancel. */
static void normals_that_cancel_stay_finite_at_every_width(void **state)
{
    (void)state;
    make_copy(&quad);
    for (size_t i = 0; i < made.vertex_count; i++)
        scale_normal(&made.vertices[i], made.vertices[i].position[0] > 0 ? -1 : 1);
    for (int width = 1; width <= 128; width++) {
        hard_resize(&hard, width, 8);
        check("normals that cancel", width >= 32 ? width / 16 : 0);
    }
    hard_report(&hard, "normals that cancel, widths 1 to 128");
}

/* Where three random normals nearly cancel, their direction changes from pixel to pixel by more
 * than an interior pixel's colour may: what is left there is right. */
static void random_normals_stay_finite(void **state)
{
    HardRandom random = {SEED + 1};
    (void)state;
    printf("seed %d\n", SEED + 1);
    for (int i = 0; i < 24; i++) {
        make_copy(&quad);
        for (size_t v = 0; v < made.vertex_count; v++)
            vec3_to_float(hard_random_direction(&random), made.vertices[v].normal);
        world.objects[0].two_sided = i % 2;
        check("random normals", SIZE / 2);
    }
    hard_report(&hard, "random normals");
}

static void normals_that_point_inwards_are_lit_as_given(void **state)
{
    (void)state;
    make_copy(&sphere);
    scale_normals(-1);
    for (int way = 0; way < 4; way++) {
        world.objects[0].two_sided = way & 1;
        world.objects[0].closed = way & 2;
        check("inward normals", SIZE * SIZE / 8);
    }
    hard_report(&hard, "inward normals");
}

/* Inside and outside of an open tube: at its silhouettes N.V changes its sign within triangles,
 * and a side chosen by that sign would leave spots. */
static void sides_turn_over_with_the_triangle_not_with_the_normal(void **state)
{
    HardRandom random = {SEED + 2};
    (void)state;
    printf("seed %d\n", SEED + 2);
    for (int i = 0; i < 12; i++) {
        hard_world(&world, i % 3 == 2 ? &quad : &tube);
        world.objects[0].two_sided = true;
        /* The tube anyhow, the quad within 70 degrees of facing the eye or facing away. */
        if (i % 3 == 2)
            mat4_rotate(180 * (i & 1) + hard_random(&random, -70, 70), (Vec3){1, 1, 0},
                        &world.objects[0].world_from_object);
        else
            mat4_rotate(hard_random(&random, 0, 360), hard_random_direction(&random),
                        &world.objects[0].world_from_object);
        check("two sides", SIZE / 2);
    }
    hard_report(&hard, "two sides");
}

static void mirrored_objects_are_lit_as_the_mirrored_mesh(void **state)
{
    HardRandom random = {SEED + 3};
    (void)state;
    printf("seed %d\n", SEED + 3);
    for (int i = 0; i < 16; i++) {
        Mat4 turn;
        hard_world(&world, i & 1 ? &tube : &sphere);
        world.objects[0].two_sided = i & 2;
        world.objects[0].closed = !(i & 1) && i & 4;
        assert_true(
            mat4_rotate(hard_random(&random, 0, 360), hard_random_direction(&random), &turn));
        world.objects[0].world_from_object =
            mat4_product(turn, mat4_scale(i & 8 ? (Vec3){-1, -0.5, -0.9} : (Vec3){1, -1, 1}));
        check("mirrored", SIZE);
    }
    hard_report(&hard, "mirrored objects");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_normal_of_no_length_gives_ambient_light_exactly, forget_made),
        cmocka_unit_test_teardown(normals_of_any_length_are_those_of_length_one, forget_made),
        cmocka_unit_test_teardown(lengths_that_differ_do_not_matter, forget_made),
        cmocka_unit_test_teardown(a_transform_of_any_size_lights_alike, forget_made),
        cmocka_unit_test_teardown(a_transform_may_stretch_by_any_factor, forget_made),
        cmocka_unit_test_teardown(normals_that_cancel_stay_finite_at_every_width, forget_made),
        cmocka_unit_test_teardown(random_normals_stay_finite, forget_made),
        cmocka_unit_test_teardown(normals_that_point_inwards_are_lit_as_given, forget_made),
        cmocka_unit_test_teardown(sides_turn_over_with_the_triangle_not_with_the_normal,
                                  forget_made),
        cmocka_unit_test_teardown(mirrored_objects_are_lit_as_the_mirrored_mesh, forget_made),
    };
    if (!picture_check_driver("hard normals"))
        return EXIT_SKIPPED;
    return cmocka_run_group_tests_name("hard normals", tests, open_all, close_all);
}
