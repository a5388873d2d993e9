/*
 * Hard cases of geometry: more vertices than 16 bits number, poles and seams, triangles without
 * area, behind the eye and beyond the planes, vertices that are no numbers, meshes of any size,
 * pictures of a pixel, needles.
 */
#include "hard.h"

#include "picture_check.h"
#include "reference_trace.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 48, SEED = 20140401 };

static const double REACH = 4;    /* see normals_test.c */
static const double FAR_OFF = 64; /* for vertices that lie some sixteen times as far as the light */

static Hard hard;
static HardWorld world;
static Mesh sphere, quad;
static Mesh made[2]; /* by a test, until forget_made */

static int open_all(void **state)
{
    Message message = {0};
    (void)state;
    hard_open(&hard, SIZE, SIZE);
    if (mesh_sphere(&sphere, 1, 24, 12, &message) && mesh_quad(&quad, 2, &message))
        return 0;
    printf("%s\n", message.text);
    return 1;
}

static int close_all(void **state)
{
    (void)state;
    mesh_close(&quad);
    mesh_close(&sphere);
    hard_close(&hard);
    return 0;
}

static int forget_made(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        hard_forget(&hard, &made[i]);
        mesh_close(&made[i]);
    }
    if (hard.bytes.width != SIZE || hard.bytes.height != SIZE)
        hard_resize(&hard, SIZE, SIZE);
    return 0;
}

static void check(const char *name, double reach, int least_pixels)
{
    hard_check_reflections(&hard, name, &world, reach, least_pixels);
}

/* Rows `first` to `last` of a wavy sheet of 256 x 256 cells over -1.6..1.6, with its normals. */
static void make_sheet(Mesh *mesh, int first, int last)
{
    enum { CELLS = 256, ROW = CELLS + 1 };
    const int rows = last - first;
    assert_true(mesh_open(mesh, (size_t)(rows + 1) * ROW,
                          mesh_grid_size(rows, CELLS, MESH_POLE_NONE), NULL));
    for (int j = 0; j <= rows; j++) {
        for (int i = 0; i <= CELLS; i++) {
            const double x = 3.2 * i / CELLS - 1.6, y = 1.6 - 3.2 * (first + j) / CELLS;
            MeshVertex *vertex = &mesh->vertices[j * ROW + i];
            Vec3 normal;
            vec3_normalize((Vec3){-0.3 * cos(3 * x), 0.2 * sin(2 * y), 1}, &normal);
            vec3_to_float((Vec3){x, y, 0.1 * sin(3 * x) + 0.1 * cos(2 * y)}, vertex->position);
            vec3_to_float(normal, vertex->normal);
        }
    }
    mesh_grid(mesh->indices, 0, rows, CELLS, MESH_POLE_NONE);
}

static void a_mesh_of_66049_vertices_is_drawn_as_its_two_halves(void **state)
{
    enum { LARGE = 192 };
    const size_t bytes = 4 * (size_t)LARGE * LARGE;
    unsigned char *whole = malloc(bytes);
    assert_non_null(whole);
    (void)state;
    hard_resize(&hard, LARGE, LARGE);
    make_sheet(&made[0], 0, 256);
    assert_int_equal(made[0].vertex_count, 66049);
    hard_world(&world, &made[0]);
    world.scene.background = (Vec3){1, 0, 1};
    hard_check(&hard, "66049 vertices", &world.scene, HARD_HIGHP, 1, LARGE * LARGE * 9 / 10);
    memcpy(whole, hard.image.pixels, bytes);
    for (size_t i = 0; i < bytes; i += 4) /* nothing of the sheet is this red and this blue */
        assert_false(whole[i] == 255 && whole[i + 2] == 255);
    hard_forget(&hard, &made[0]);
    mesh_close(&made[0]);
    make_sheet(&made[0], 0, 128);
    make_sheet(&made[1], 128, 256);
    world.objects[1] = world.objects[0];
    world.objects[1].mesh = &made[1];
    world.scene.object_count = 2;
    hard_draw(&hard, &world.scene, HARD_HIGHP, NULL);
    const int same = memcmp(whole, hard.image.pixels, bytes);
    free(whole);
    assert_int_equal(same, 0);
    hard_report(&hard, "66049 vertices");
}

static void poles_have_areas_and_seams_do_not_show(void **state)
{
    static const Vec3 axes[] = {{0, 1, 0}, {1, 0, 0}};
    (void)state;
    for (int slices = 3; slices <= 48; slices *= 2) {
        const size_t row = (size_t)slices + 1;
        assert_true(mesh_sphere(&made[0], 1, slices, slices, NULL));
        for (size_t i = 0; i < made[0].index_count / 3; i++) {
            Vec3 normal;
            assert_true(mesh_face(&made[0], i, &normal));
        }
        for (size_t j = 0; j <= (size_t)slices; j++)
            assert_memory_equal(&made[0].vertices[j * row], &made[0].vertices[j * row + row - 1],
                                sizeof(MeshVertex));
        /* The seam faces the eye; then a pole does. */
        for (int i = 0; i < 2; i++) {
            hard_world(&world, &made[0]);
            mat4_rotate(90 * i, axes[i], &world.objects[0].world_from_object);
            check("seam and pole", REACH, SIZE);
        }
        forget_made(NULL);
    }
    /* Turned by one of its slices a sphere is the same, but its seam is elsewhere. */
    for (int interpolation = 0; interpolation < 2; interpolation++) {
        unsigned char before[4 * SIZE * SIZE];
        int apart = 0;
        hard_world(&world, &sphere);
        world.scene.interpolation = (Interpolation)interpolation;
        hard_draw(&hard, &world.scene, HARD_HIGHP, NULL);
        memcpy(before, hard.image.pixels, sizeof before);
        mat4_rotate(90, axes[0], &world.objects[0].world_from_object);
        hard_draw(&hard, &world.scene, HARD_HIGHP, NULL);
        for (size_t i = 0; i < sizeof before; i++)
            apart += abs(before[i] - ((unsigned char *)hard.image.pixels)[i]) > 1;
        assert_int_equal(apart, 0);
    }
    hard_report(&hard, "poles and seams");
}

static void triangles_without_area_draw_nothing(void **state)
{
    (void)state;
    for (int way = 0; way < 3; way++) {
        static const Interpolation ways[] = {INTERPOLATION_PHONG, INTERPOLATION_GOURAUD,
                                             INTERPOLATION_FLAT};
        /* Repeated corners, corners on a line, all corners in one place. */
        assert_true(mesh_open(&made[0], 9, 9, NULL));
        for (size_t i = 0; i < 9; i++) {
            MeshVertex *vertex = &made[0].vertices[i];
            vec3_to_float((Vec3){0, 0, 1}, vertex->normal);
            vertex->position[0] = i < 6 ? 0.25F * (float)(i % 3) : 0.5F;
            made[0].indices[i] = i == 2 ? 1 : (uint32_t)i;
        }
        hard_world(&world, &made[0]);
        world.scene.interpolation = ways[way];
        for (int precision = 0; precision < 2; precision++) {
            const HardResult result =
                hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
            assert_int_equal(result.not_finite, 0);
            assert_int_equal(result.interior_pixels, 0);
            for (size_t i = 0; i < 4 * (size_t)SIZE * SIZE; i += 4)
                assert_int_equal(((unsigned char *)hard.image.pixels)[i], 51);
        }
        forget_made(NULL);
    }
    /* The lecture's sphere has some at its poles. */
    assert_true(mesh_sphere_lecture(&made[0], 16, NULL));
    hard_world(&world, &made[0]);
    mat4_rotate(90, (Vec3){1, 0, 0}, &world.objects[0].world_from_object);
    check("lecture's sphere", REACH, SIZE);
    hard_report(&hard, "triangles without area");
}

static void set_vertex(MeshVertex *vertex, Vec3 position)
{
    vec3_to_float(position, vertex->position);
    vec3_to_float((Vec3){0, 1, 0}, vertex->normal);
}

/* A floor, one of whose corners lies behind the eye, in the plane of the eye, on the near plane, on
 * the far plane, or far beyond. Clipped, it keeps colours and normals. */
static void corners_may_lie_anywhere(void **state)
{
    static const double depths[] = {-50, -1, 0, 0.5, 0.5000001, 20, 21, 200, 2000};
    (void)state;
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++) {
        for (size_t k = 0; k < 2; k++) {
            static const uint32_t indices[3] = {0, 1, 2};
            char name[64];
            assert_true(mesh_open(&made[0], 3, 3, NULL));
            memcpy(made[0].indices, indices, sizeof indices);
            set_vertex(&made[0].vertices[0], (Vec3){-2, -0.5, 1});
            set_vertex(&made[0].vertices[1], (Vec3){2, -0.5, k ? 1.5 : 1});
            set_vertex(&made[0].vertices[2], (Vec3){0, -0.5, 4 - depths[i]});
            hard_world(&world, &made[0]);
            world.objects[0].two_sided = k;
            world.lights[0].position = (Vec3){0.5, 1.5, 1};
            snprintf(name, sizeof name, "corner at depth %g, %zu", depths[i], k);
            check(name, FAR_OFF, SIZE);
            forget_made(NULL);
        }
    }
    hard_report(&hard, "corners behind the eye, on the planes and beyond");
}

/* The message names the vertex. Nothing is checked again once a mesh has been uploaded. */
static void vertices_that_are_no_numbers_are_refused(void **state)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    (void)state;
    for (int i = 0; i < 54; i++) {
        Message message = {0};
        assert_true(mesh_sphere(&made[0], 1, 8, 4, NULL));
        MeshVertex *vertex = &made[0].vertices[7];
        *(i / 3 % 2 ? &vertex->normal[i % 3] : &vertex->position[i % 3]) = bad[i / 6 % 3];
        hard_world(&world, &made[0]);
        world.scene.interpolation = (Interpolation)(i / 18);
        assert_false(lighting_draw(hard.lightings[0], &world.scene, 1, false, &message));
        if (!strstr(message.text, i / 3 % 2 ? "vertex 7: normal (" : "vertex 7: position (") ||
            !strstr(message.text, "must be finite") || strchr(message.text, '\n'))
            fail_msg("\"%s\" is not about vertex 7", message.text);
        forget_made(NULL);
    }
    Message message = {0};
    assert_true(mesh_sphere(&made[0], 1, 8, 4, NULL));
    made[0].indices[10] = 45;
    assert_false(mesh_check(&made[0], &message));
    assert_string_equal(message.text, "mesh: triangle 3: vertex 45: there are 45");
}

/* All of it as large: mesh, camera, light. In mediump nothing beyond 65504 has a place, and the
 * square of nothing below 8e-3 or above 255 has all its digits: see precision_test.c. */
static void a_mesh_of_any_size_is_lit_alike(void **state)
{
    (void)state;
    for (int exponent = -14; exponent <= 14; exponent += 4) {
        const double size = pow(10, exponent);
        char name[64];
        assert_true(mesh_sphere(&made[0], size, 24, 12, NULL));
        hard_world(&world, &made[0]);
        world.lights[0].position = vec3_scale(world.lights[0].position, size);
        world.scene.camera.eye = vec3_scale(world.scene.camera.eye, size);
        world.scene.camera.near *= size;
        world.scene.camera.far *= size;
        snprintf(name, sizeof name, "mesh of size 1e%d", exponent);
        for (int way = 0; way < 4; way++) {
            world.scene.reflection = way & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
            world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            hard_check(&hard, name, &world.scene, HARD_HIGHP, 1, SIZE * SIZE / 8);
        }
        world.scene.interpolation = INTERPOLATION_GOURAUD;
        hard_check(&hard, name, &world.scene, HARD_MEDIUMP, 1.5, SIZE * SIZE / 8);
        forget_made(NULL);
    }
    hard_report(&hard, "meshes of sizes 1e-14 to 1e14");
}

/* Pixels that are as large as the object are no interior ones: they are compared at their centres,
 * where a driver samples them. */
static void check_centres(double most)
{
    Message message = {0};
    Trace *trace;
    const int width = hard.bytes.width, height = hard.bytes.height;
    if (!trace_open(&trace, &world.scene, true, width, height, NULL, &message))
        fail_msg("%s", message.text);
    for (int i = 0; i < width * height; i++) {
        Sample sample;
        trace_sample(trace, i % width + 0.5, i / width + 0.5, &sample);
        for (int c = 0; c < 3; c++) {
            const double error = fabs(((unsigned char *)hard.image.pixels)[4 * i + c] -
                                      255 * (double)sample.color[c]);
            if (error > most)
                fail_msg("%d x %d: pixel %d: %.3f of %.3f", width, height, i, error, most);
        }
    }
    trace_close(trace);
}

static void pictures_may_be_one_pixel_wide_or_high(void **state)
{
    static const int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {1, 64}, {64, 1}, {3, 1}, {1, 255}};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        hard_resize(&hard, sizes[i][0], sizes[i][1]);
        hard_world(&world, &quad);
        world.scene.camera.fovy = 20; /* the quad fills the picture's height */
        for (int way = 0; way < 4; way++) {
            const HardPrecision precision = way & 1 ? HARD_MEDIUMP : HARD_HIGHP;
            world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            assert_int_equal(hard_draw(&hard, &world.scene, precision, NULL).not_finite, 0);
            check_centres(precision ? hard_mediump_most(&world.scene, FAR_OFF) : 1);
        }
    }
}

static void an_object_may_fill_the_picture(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        hard_world(&world, i ? &sphere : &quad);
        world.scene.camera.fovy = 8;
        check("filled", REACH, i ? SIZE * SIZE / 2 : SIZE * SIZE * 9 / 10);
        hard_world(&world, &quad);
        world.scene.camera.eye = (Vec3){0.1, 0.1, 0.01 * (i + 1)};
        world.scene.camera.near = 0.001;
        world.scene.camera.center = (Vec3){0.1, 0.1, 0};
        check("filled, near", FAR_OFF, SIZE * SIZE * 9 / 10);
    }
    hard_report(&hard, "an object that fills the picture");
}

/* Triangles of which hardly any has a pixel's centre: a fan of them, and random ones. */
static void needles_are_finite_and_right_where_they_are_wide(void **state)
{
    HardRandom random = {SEED};
    (void)state;
    printf("seed %d\n", SEED);
    assert_true(mesh_disc(&made[0], 1.2, 1000, 1, NULL));
    hard_world(&world, &made[0]);
    check("fan of needles", REACH, SIZE * SIZE / 8);
    forget_made(NULL);
    for (int i = 0; i < 8; i++) {
        assert_true(mesh_open(&made[0], 3 * 64, 3 * 64, NULL));
        for (size_t k = 0; k < 3 * 64; k++) {
            MeshVertex *vertex = &made[0].vertices[k];
            made[0].indices[k] = (uint32_t)k;
            vec3_to_float(hard_random_direction(&random), vertex->normal);
            vec3_to_float(vec3_scale(hard_random_direction(&random), 1.2), vertex->position);
            if (k % 3 == 2) /* beside its neighbour */
                for (int axis = 0; axis < 3; axis++)
                    vertex->position[axis] =
                        vertex[-1].position[axis] + (float)hard_random(&random, -0.01, 0.01);
        }
        hard_world(&world, &made[0]);
        world.objects[0].two_sided = i & 1;
        for (int way = 0; way < 8; way++) {
            world.scene.reflection = way & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
            world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            hard_check(&hard, "needles", &world.scene, way & 4 ? HARD_MEDIUMP : HARD_HIGHP,
                       way & 4 ? 255 : 1, 0);
        }
        forget_made(NULL);
    }
    hard_report(&hard, "needles");
}

static void objects_without_triangles_are_refused(void **state)
{
    Message message = {0};
    (void)state;
    hard_world(&world, &made[0]);
    assert_false(scene_check(&world.scene, &message));
    assert_string_equal(message.text, "object 0: has no triangles");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_mesh_of_66049_vertices_is_drawn_as_its_two_halves, forget_made),
        cmocka_unit_test_teardown(poles_have_areas_and_seams_do_not_show, forget_made),
        cmocka_unit_test_teardown(triangles_without_area_draw_nothing, forget_made),
        cmocka_unit_test_teardown(corners_may_lie_anywhere, forget_made),
        cmocka_unit_test_teardown(vertices_that_are_no_numbers_are_refused, forget_made),
        cmocka_unit_test_teardown(a_mesh_of_any_size_is_lit_alike, forget_made),
        cmocka_unit_test_teardown(pictures_may_be_one_pixel_wide_or_high, forget_made),
        cmocka_unit_test_teardown(an_object_may_fill_the_picture, forget_made),
        cmocka_unit_test_teardown(needles_are_finite_and_right_where_they_are_wide, forget_made),
        cmocka_unit_test(objects_without_triangles_are_refused),
    };
    if (!picture_check_driver("hard geometry"))
        return EXIT_SKIPPED;
    return cmocka_run_group_tests_name("hard geometry", tests, open_all, close_all);
}
