/*
 * Hard cases of geometry: more vertices than 16-bit indices reach, poles and seams, triangles
 * without area, behind the eye and beyond the planes, NaN vertices, meshes of any size, pictures of
 * one pixel, needles.
 */
#include "core/mesh_make.h"
#include "hard/hard.h"
#include "reference/reference_trace.h"
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
    if (hard.bytes.width != SIZE || hard.bytes.height != SIZE)
        hard_resize(SIZE, SIZE);
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

TEST_WITH(0, triangles_without_area_draw_nothing, NULL, forget_made)
{
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
        for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
            const HardResult result = hard_draw(&world.scene, precision, NULL);

            assert_true(result.interior_pixels == 0 && result.not_finite == 0);
            for (size_t i = 0; i < 4 * (size_t)SIZE * SIZE; i += 4)
                assert_int_equal(((unsigned char *)hard.image.pixels)[i], 51);
        }
        forget_made(NULL);
    }
    /* The lecture's sphere has some at its poles. */
    assert_true(mesh_sphere_lecture(&made[0], 16, NULL));
    hard_world(&world, &made[0]);
    world.objects[0].world_from_object = mat4_rotate(90, (Vec3){1, 0, 0});
    check("lecture's sphere", REACH, SIZE);
    hard_report("triangles without area");
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

/* Pixels as large as the object are not interior: they are compared at their centres, where a
 * driver samples them. */
static void check_centres(double max)
{
    Trace *trace;
    const int width = hard.bytes.width, height = hard.bytes.height;
    SUCCEEDS(trace_open(
        &trace, &world.scene,
        &(ReferenceOptions){.width = width, .height = height, .meshes = true, .threads = 1},
        message));
    for (int i = 0; i < width * height; i++) {
        Sample sample;
        trace_sample(trace, i % width + 0.5, i / width + 0.5, &sample);
        for (int c = 0; c < 3; c++) {
            const double error = fabs(((unsigned char *)hard.image.pixels)[4 * i + c] -
                                      255 * (double)sample.color[c]);
            if (error > max)
                fail_msg("%d x %d: pixel %d: %.3f of %.3f", width, height, i, error, max);
        }
    }
    trace_close(trace);
}

TEST_WITH(0, pictures_may_be_one_pixel_wide_or_high, NULL, forget_made)
{
    static const int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {1, 64}, {64, 1}, {3, 1}, {1, 255}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        hard_resize(sizes[i][0], sizes[i][1]);
        hard_world(&world, &hard.quad);
        world.scene.camera.fovy = 20; /* the quad fills the picture's height */
        for (int way = 0; way < 4; way++) {
            const HardPrecision precision = way & 1 ? HARD_MEDIUMP : HARD_HIGHP;
            world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            hard_draw_finite(&world.scene, precision);
            check_centres(precision ? oracle_mediump_max(&world.scene, FAR_OFF) : 1);
        }
    }
}

/* A triangle from bottom left to top right, 32 pixels long, over the centers of pixels, whose other
 * end is `width` pixels wide: its red is 0 at the tip and 1 there, in the drawn picture. The
 * largest error, from 0 to 1. */
static double sliver_error(double width)
{
    const double side = width * 4 * tan(acos(-1) / 9) / SIZE / sqrt(2); /* half of it */
    const Vec3 corners[] = {{-1, -1, 0}, {1 + side, 1 - side, 0}, {1 - side, 1 + side, 0}};
    double largest = 0;
    assert_true(mesh_open(&made[0], 3, 3, NULL) && mesh_open_colors(&made[0], NULL));
    for (size_t i = 0; i < 3; i++) {
        made[0].indices[i] = (uint32_t)i;
        vec3_to_float(corners[i], made[0].vertices[i].position);
        vec3_to_float((Vec3){0, 0, 1}, made[0].vertices[i].normal);
        made[0].colors[i][0] = i > 0;
    }
    hard_world(&world, &made[0]);
    world.scene.background = (Vec3){0, 1, 0};
    world.scene.global_ambient = (Vec3){1, 1, 1};
    world.scene.light_count = 0;
    hard_draw_finite(&world.scene, HARD_HIGHP);
    for (int i = 0; i < SIZE; i++) {
        const unsigned char *pixel =
            (const unsigned char *)hard.image.pixels + 4 * ((SIZE - 1 - i) * SIZE + i);
        const double at = (i + 0.5 - SIZE / 2.0) * 2 / SIZE * 4 * tan(acos(-1) / 9); /* -1 to 1 */
        if (pixel[1] == 0)
            largest = fmax(largest, fabs(pixel[0] / 255.0 - (at + 1) / 2));
    }
    forget_made(NULL);
    return largest;
}

/* The quad's diagonal passes the centers of pixels. Clipping makes slivers along it, of any width,
 * which drivers draw whose corners are not on a grid; those that divide by the area are wrong
 * there.
 */
static void leave_out_slivers(void)
{
    for (int bits = 6; bits < 18 && !hard.skip_diagonal; bits++) {
        const double off = 255 * sliver_error(ldexp(1, -bits));
        hard.skip_diagonal = off > 1;
        if (hard.skip_diagonal)
            print_message("not supported: colors in triangles 2^-%d of a pixel wide, %.0f steps "
                          "off, which clipping makes of a quad: its diagonal is left out\n",
                          bits, off);
    }
}

TEST_WITH(0, an_object_may_fill_the_picture, NULL, forget_made)
{
    leave_out_slivers();
    for (int i = 0; i < 2; i++) {
        hard_world(&world, i ? &hard.sphere : &hard.quad);
        world.scene.camera.fovy = 8;
        check("filled", REACH, i ? SIZE * SIZE / 2 : SIZE * SIZE * 9 / 10);
        hard_world(&world, &hard.quad);
        world.scene.camera.eye = (Vec3){0.1, 0.1, 0.01 * (i + 1)};
        world.scene.camera.near = 0.001;
        world.scene.camera.center = (Vec3){0.1, 0.1, 0};
        check("filled, near", FAR_OFF, SIZE * SIZE * 9 / 10);
    }
    hard.skip_diagonal = false;
    hard_report("an object that fills the picture");
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
