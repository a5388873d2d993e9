/*
 * Hard cases of geometry: poles and seams, triangles behind the eye and beyond the planes, NaN
 * vertices, needles.
 */
#include "core/mesh_make.h"
#include "hard/hard.h"
#include "shapes/mesh_solids.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 48, SEED = 20140401 };

static const double REACH = 4;    /* see normals_test.c */
static const double FAR_OFF = 64; /* for vertices about sixteen times as far away as the light */

static HardWorld world;
static Mesh made[2]; /* of the current test, until forget_made */

FIXTURE(forget_made)
{
    for (int i = 0; i < 2; i++) {
        hard_forget(&made[i]);
        mesh_close(&made[i]);
    }
}

static void check(const char *name, double reach, int min_pixels)
{
    hard_check_reflections(name, &world, reach, min_pixels);
}

TEST_WITH(0, poles_and_seams_do_not_show, NULL, forget_made)
{
    static const Vec3 axes[] = {{0, 1, 0}, {1, 0, 0}};
    for (int slices = 3; slices <= 48; slices *= 2) {
        assert_true(mesh_sphere(&made[0], 1, slices, slices, NULL));
        /* The seam faces the eye; then a pole does. */
        for (int i = 0; i < 2; i++) {
            hard_world(&world, &made[0]);
            world.objects[0].world_from_object = mat4_rotate(90 * i, axes[i]);
            check("seam and pole", REACH, SIZE);
        }
        forget_made(NULL);
    }
    /* Rotated by one slice a sphere is the same, but its seam is elsewhere. */
    for (int interpolation = 0; interpolation < 2; interpolation++) {
        unsigned char before[4 * SIZE * SIZE];
        hard_world(&world, &hard.sphere);
        world.scene.interpolation = (Interpolation)interpolation;
        hard_draw_finite(&world.scene, HARD_HIGHP);
        memcpy(before, hard.image.pixels, sizeof before);
        world.objects[0].world_from_object = mat4_rotate(90, axes[0]);
        hard_draw_finite(&world.scene, HARD_HIGHP);
        assert_int_equal(pixels_apart(before, hard.image.pixels, SIZE * SIZE, 1), 0);
    }
    hard_report("poles and seams");
}

static void set_vertex(MeshVertex *vertex, Vec3 position)
{
    vec3_to_float(position, vertex->position);
    vec3_to_float((Vec3){0, 1, 0}, vertex->normal);
}

/* A floor with one corner behind the eye, in the plane of the eye, on the near plane, on the far
 * plane, or far beyond it. Clipping keeps colours and normals. */
TEST_WITH(0, corners_may_be_anywhere, NULL, forget_made)
{
    static const double depths[] = {-50, -1, 0, 0.5, 0.5000001, 20, 21, 200, 2000};
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++)
        for (size_t k = 0; k < 2; k++) {
            static const uint32_t indices[3] = {0, 1, 2};
            assert_true(mesh_open(&made[0], 3, 3, NULL));
            memcpy(made[0].indices, indices, sizeof indices);
            set_vertex(&made[0].vertices[0], (Vec3){-2, -0.5, 1});
            set_vertex(&made[0].vertices[1], (Vec3){2, -0.5, k ? 1.5 : 1});
            set_vertex(&made[0].vertices[2], (Vec3){0, -0.5, 4 - depths[i]});
            hard_world(&world, &made[0]);
            world.objects[0].two_sided = k;
            world.lights[0].position = (Vec3){0.5, 1.5, 1};
            check(formatted("corner at depth %g, %zu", depths[i], k), FAR_OFF, SIZE);
            forget_made(NULL);
        }
    hard_report("corners behind the eye, on the planes and beyond");
}

/* The message names the vertex. An uploaded mesh is not checked again. */
TEST_WITH(0, vertices_that_are_not_finite_are_refused, NULL, forget_made)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 54; i++) {
        Message message = {0};
        assert_true(mesh_sphere(&made[0], 1, 8, 4, NULL));
        MeshVertex *vertex = &made[0].vertices[7];
        *(i / 3 % 2 ? &vertex->normal[i % 3] : &vertex->position[i % 3]) = bad[i / 6 % 3];
        hard_world(&world, &made[0]);
        world.scene.interpolation = (Interpolation)(i / 18);
        assert_false(lighting_show(hard.lightings[0],
                                   &(LightingFrame){.scene = &world.scene, .aspect = 1}, &message));
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

/* Triangles that contain few pixel centres: a fan, and random ones. */
TEST_WITH(0, needles_are_finite_and_right_where_they_are_wide, NULL, forget_made)
{
    Random random = {SEED};
    printf("seed %d\n", SEED);
    assert_true(mesh_disc(&made[0], 1.2, 1000, 1, NULL));
    hard_world(&world, &made[0]);
    check("fan of needles", REACH, SIZE * SIZE / 8);
    forget_made(NULL);
    for (int i = 0; i < 8; i += testing_step(9)) {
        assert_true(mesh_open(&made[0], 3 * 64, 3 * 64, NULL));
        for (size_t k = 0; k < 3 * 64; k++) {
            MeshVertex *vertex = &made[0].vertices[k];
            made[0].indices[k] = (uint32_t)k;
            vec3_to_float(hard_random_direction(&random), vertex->normal);
            vec3_to_float(vec3_scale(hard_random_direction(&random), 1.2), vertex->position);
            if (k % 3 == 2) /* beside its neighbour */
                for (int axis = 0; axis < 3; axis++)
                    vertex->position[axis] =
                        vertex[-1].position[axis] + (float)random_between(&random, -0.01, 0.01);
        }
        hard_world(&world, &made[0]);
        world.objects[0].two_sided = i & 1;
        for (int way = 0; way < 8; way++) {
            world.scene.reflection = way & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
            world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            hard_check("needles", &world.scene, way & 4 ? HARD_MEDIUMP : HARD_HIGHP,
                       way & 4 ? 255 : 1, 0);
        }
        forget_made(NULL);
    }
    hard_report("needles");
}

HARD_TEST_MAIN("hard geometry", SIZE)
