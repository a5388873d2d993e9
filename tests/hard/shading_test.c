/*
 * Hard cases of the equation itself: powers of 0 and to 0, opposite directions, light and eye on
 * the surface or behind it, more light than can be shown, transparency, emission, sRGB.
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

enum { SIZE = 48, SEED = 20140301 };

static const double REACH = 4;      /* see normals_test.c */
static const double NO_REACH = 1e9; /* eye or light on the surface: in mediump no digit is left */

static Hard hard;
static HardWorld world;
static Mesh sphere, quad, cube;

static int open_all(void **state)
{
    Message message = {0};
    (void)state;
    hard_open(&hard, SIZE, SIZE);
    if (mesh_sphere(&sphere, 1, 24, 12, &message) && mesh_quad(&quad, 2, &message) &&
        mesh_cube(&cube, 0.8, &message))
        return 0;
    printf("%s\n", message.text);
    return 1;
}

static int close_all(void **state)
{
    (void)state;
    mesh_close(&cube);
    mesh_close(&quad);
    mesh_close(&sphere);
    hard_close(&hard);
    return 0;
}

static void check(const char *name, double reach)
{
    hard_check_reflections(&hard, name, &world, reach, SIZE * SIZE / 8);
}

static const unsigned char *pixel(int x, int y)
{
    return (unsigned char *)hard.image.pixels + 4 * (y * SIZE + x);
}

/* A light with nothing but a highlight. */
static void only_specular(const Mesh *mesh, double shininess)
{
    hard_world(&world, mesh);
    world.scene.global_ambient = (Vec3){0, 0, 0};
    world.lights[0].ambient = world.lights[0].diffuse = (Vec3){0, 0, 0};
    world.objects[0].front.shininess = world.objects[0].back.shininess = shininess;
}

/* Any cosine to the power of 0 is 1, 0 and what is below 0 too; where light falls. */
static void a_shininess_of_0_is_a_highlight_wherever_light_falls(void **state)
{
    static const int expected[] = {255, 128, 64}; /* of 255, 127.5, 63.75 */
    (void)state;
    for (int way = 0; way < 8; way++) {
        only_specular(&quad, 0);
        world.objects[0].front.specular = (Vec3){1, 0.5, 0.25};
        world.scene.reflection = way & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
        world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
        world.scene.distant_viewer = way & 4;
        for (int precision = 0; precision < 2; precision++) {
            /* Slanting, so that R.V is negative over a part of the quad. */
            world.lights[0].position = (Vec3){-3, 0, 0.05};
            hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
            for (int x = SIZE / 4; x < SIZE; x += SIZE / 4) {
                for (int c = 0; c < 3; c++)
                    if (pixel(x, SIZE / 2)[c] != expected[c])
                        fail_msg("way %d, precision %d, column %d: %d for %d", way, precision, x,
                                 pixel(x, SIZE / 2)[c], expected[c]);
            }
            world.lights[0].position = (Vec3){-3, 0, -0.05};
            hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
            for (int x = SIZE / 4; x < SIZE; x += SIZE / 4)
                for (int c = 0; c < 3; c++)
                    assert_int_equal(pixel(x, SIZE / 2)[c], 0);
        }
        only_specular(&sphere, 0);
        check("shininess 0", REACH);
    }
    hard_report(&hard, "shininess 0");
}

/* With a shininess of 1, 3, 5 a negative cosine would darken, and pow is undefined for it. */
static void negative_cosines_make_no_highlight(void **state)
{
    static const double odd[] = {1, 3, 5, 0.5, 1e-3, 127};
    static const Vec3 lights[] = {{1.5, 2, 3.5}, {-4, 1, 0.5}, {0.5, 3, -2}};
    (void)state;
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        for (size_t k = 0; k < sizeof lights / sizeof lights[0]; k++) {
            hard_world(&world, k == 1 ? &cube : &sphere);
            world.lights[0].position = lights[k];
            world.objects[0].front.shininess = odd[i];
            /* Light and viewer lie far apart: where it turns dark the highlight has not ended, and
             * signs may differ there in mediump. */
            char name[64];
            snprintf(name, sizeof name, "negative cosines, shininess %g, light %zu", odd[i], k);
            check(name, k ? NO_REACH : REACH);
        }
    }
    hard_report(&hard, "negative cosines");
}

/* Light exactly behind the surface, as seen from the eye: L + V is zero. */
static void opposite_light_and_viewer_make_no_highlight(void **state)
{
    (void)state;
    for (int way = 0; way < 16; way++) {
        const double shininess = way & 1 ? 0 : 8;
        only_specular(&quad, shininess);
        world.scene.reflection = way & 2 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
        world.scene.interpolation = way & 4 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
        world.scene.distant_viewer = way & 8;
        world.lights[0].position = world.lights[0].direction = (Vec3){0, 0, -4};
        for (int kind = 0; kind < 2; kind++) {
            world.lights[0].kind = (LightKind)kind;
            for (int precision = 0; precision < 2; precision++) {
                const HardResult result =
                    hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
                assert_int_equal(result.not_finite, 0);
                for (int i = SIZE / 3; i < 2 * SIZE / 3; i++)
                    assert_int_equal(pixel(i, i)[0], 0);
            }
        }
    }
}

/* Of both reflections, from the side on which the surface is not lit. */
static void there_is_no_highlight_where_light_does_not_fall(void **state)
{
    HardRandom random = {SEED};
    (void)state;
    printf("seed %d\n", SEED);
    for (int i = 0; i < 24; i++) {
        only_specular(&quad, i % 3 == 0 ? 1 : 8);
        world.objects[0].front.specular = (Vec3){1, 1, 1};
        world.lights[0].position = hard_random_direction(&random);
        world.lights[0].position.z = -0.01 - fabs(world.lights[0].position.z);
        world.scene.reflection = (Reflection)(i & 1);
        world.scene.interpolation = (Interpolation)(i >> 1 & 1);
        for (int precision = 0; precision < 2; precision++) {
            const HardResult result =
                hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
            assert_int_equal(result.not_finite, 0);
            assert_true(result.byte_error == 0 && result.interior_pixels > SIZE * SIZE / 4);
        }
    }
}

static void the_eye_may_be_within_the_object_and_on_it(void **state)
{
    static const Vec3 eyes[] = {{0, 0, 0}, {0.3, 0.2, 0.1}, {0, 0, 1}, {0, 0.6, 0.8}};
    (void)state;
    for (size_t i = 0; i < sizeof eyes / sizeof eyes[0]; i++) {
        for (int two_sided = 0; two_sided < 2; two_sided++) {
            hard_world(&world, &sphere);
            world.objects[0].two_sided = two_sided;
            world.objects[0].closed = true;
            world.lights[0].position = (Vec3){0.2, 0.5, 0.1};
            world.scene.camera.eye = eyes[i];
            world.scene.camera.center = (Vec3){0.1, 0.1, -2};
            world.scene.camera.near = 0.01;
            check("eye within", NO_REACH);
        }
    }
    hard_report(&hard, "eye on and within the object");
}

static void grazing_light_and_view_are_exact(void **state)
{
    static const double degrees[] = {1, 0.1, 0.01};
    (void)state;
    for (size_t i = 0; i < sizeof degrees / sizeof degrees[0]; i++) {
        const double sine = sin(degrees[i] * acos(-1) / 180);
        hard_world(&world, &quad);
        world.lights[0].kind = LIGHT_DIRECTIONAL;
        world.lights[0].direction = (Vec3){1, 0, sine};
        check("grazing light", NO_REACH);
        hard_world(&world, &quad);
        mat4_rotate(90 - 20 * degrees[i], (Vec3){1, 0, 0}, &world.objects[0].world_from_object);
        world.scene.camera.fovy = 0.6 + 40 * sine;
        world.lights[0].position = (Vec3){1, 2, -3};
        for (int precision = 0; precision < 2; precision++)
            hard_check(&hard, "grazing view", &world.scene, (HardPrecision)precision,
                       precision ? 255 : 1, SIZE / 4);
    }
    hard_report(&hard, "grazing light and view");
}

/* The sum is clamped once, at the end: what is above 1 in one term does not hide another. */
static void over_exposure_is_clamped_once(void **state)
{
    (void)state;
    for (int way = 0; way < 8; way++) {
        hard_world(&world, &sphere);
        world.lights[0].diffuse = (Vec3){3, 2, 1};
        world.lights[0].specular = (Vec3){1, 2, 3};
        world.scene.clamp_vertex = way & 1;
        world.scene.linear = way & 2;
        world.objects[0].two_sided = way & 4;
        if (!world.scene.linear)
            check("over-exposed", REACH);
        for (int i = 0; i < 2; i++) {
            world.scene.interpolation = (Interpolation)i;
            hard_check(&hard, "over-exposed", &world.scene, HARD_HIGHP, 1, SIZE * SIZE / 8);
        }
    }
    hard_report(&hard, "over-exposure");
}

/* Emission k / 255 is byte k, of each channel, in either precision: half a step is 2^-9, and the
 * rounding of k / 255 to 11 bits 2^-12 at most. */
static void every_byte_survives(void **state)
{
    (void)state;
    for (int precision = 0; precision < 2; precision++) {
        for (int k = 0; k < 256; k++) {
            hard_world(&world, &quad);
            world.scene.light_count = 0;
            world.scene.global_ambient = (Vec3){0, 0, 0};
            world.objects[0].front.emission =
                (Vec3){k / 255.0, (255 - k) / 255.0, (k ^ 85) / 255.0};
            hard_check(&hard, "emission", &world.scene, (HardPrecision)precision,
                       precision ? 0.07 : 0.001, SIZE * SIZE / 4);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[0], k);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[1], 255 - k);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[2], k ^ 85);
        }
    }
    hard_report(&hard, "emission of k / 255");
}

/* From .5 to .52: bytes 128 to 133, each once more than the one before, and no other. */
static void a_ramp_of_a_fiftieth_has_six_levels(void **state)
{
    Mesh *mesh = &quad;
    (void)state;
    for (int precision = 0; precision < 2; precision++) {
        int last = 0, levels = 0;
        for (int i = 0; i <= 100; i++) {
            const double value = 0.5 + 0.02 * i / 100;
            hard_world(&world, mesh);
            world.scene.light_count = 0;
            world.scene.global_ambient = (Vec3){0, 0, 0};
            world.objects[0].front.emission = (Vec3){value, value, value};
            hard_draw(&hard, &world.scene, (HardPrecision)precision, NULL);
            const int now = pixel(SIZE / 2, SIZE / 2)[0];
            assert_true(now == last || now == last + 1 || i == 0);
            assert_true(fabs(now - 255 * value) <= (precision ? 0.57 : 0.5001));
            levels += now != last;
            last = now;
        }
        assert_int_equal(levels, 6);
    }
}

static void alpha_is_kept_and_colours_are_not_multiplied_by_it(void **state)
{
    static const double alphas[] = {0, 1e-30, 0.25, 1};
    (void)state;
    for (size_t i = 0; i < sizeof alphas / sizeof alphas[0]; i++) {
        for (int precision = 0; precision < 2; precision++) {
            hard_world(&world, &sphere);
            world.objects[0].front.alpha = alphas[i];
            hard_check(&hard, "alpha", &world.scene, (HardPrecision)precision,
                       precision ? hard_mediump_most(&world.scene, REACH) : 1, SIZE * SIZE / 8);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[3], (int)lrint(255 * alphas[i]));
        }
    }
    hard_report(&hard, "alpha 0 to 1");
}

static double encoded(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* At 0 and 1, at the knee, beside it, and beyond what can be shown. In mediump the power is 2 to
 * the power of log2(x) / 2.4: log2 of .0031308 is -8.3, known to 2^-8 or half its last digit, which
 * is .0027 / 2.4 of the value; and 3 units for the rest, over 1.055 times 255. */
static void srgb_is_encoded_from_end_to_end(void **state)
{
    static const double values[] = {0,         1e-7,  1e-4, 0.003130, 0.0031308, 0.0031309, 0.0032,
                                    0.0044366, 0.018, 0.2,  0.5,      0.999,     1,         1};
    static const double mediump = 0.5 + 255 * 1.055 * (2 * 0x1p-8 / 2.4 + 4 * 0x1p-11);
    (void)state;
    for (int precision = 0; precision < 2; precision++) {
        for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
            hard_world(&world, &quad);
            world.scene.linear = true;
            world.scene.light_count = 0;
            world.scene.global_ambient = (Vec3){0, 0, 0};
            world.objects[0].front.emission = (Vec3){values[i], values[i], values[i]};
            if (i == sizeof values / sizeof values[0] - 1) { /* 1.5 in all */
                world.scene.global_ambient = (Vec3){1, 1, 1};
            }
            hard_check(&hard, "sRGB", &world.scene, (HardPrecision)precision,
                       precision ? mediump : 0.51, SIZE * SIZE / 4);
            if (precision == HARD_HIGHP)
                assert_true(fabs(pixel(SIZE / 2, SIZE / 2)[0] - 255 * encoded(values[i])) < 0.51);
        }
    }
    hard_report(&hard, "sRGB from 0 to 1");
}

static void assert_refused(const char *beginning)
{
    Message message = {0};
    assert_false(scene_check(&world.scene, &message));
    if (strncmp(message.text, beginning, strlen(beginning)) != 0 || strchr(message.text, '\n'))
        fail_msg("\"%s\" where one line \"%s...\" was expected", message.text, beginning);
}

static void materials_and_cameras_without_meaning_are_refused_by_name(void **state)
{
    static const double bad[] = {NAN, INFINITY, -INFINITY, -1e-300, 129};
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        hard_world(&world, &sphere);
        world.objects[0].front.shininess = bad[i];
        assert_refused("object 0: front: shininess");
        hard_world(&world, &sphere);
        world.objects[0].front.alpha = bad[i];
        assert_refused("object 0: front: alpha");
        hard_world(&world, &sphere);
        world.objects[0].front.emission.z = bad[i];
        assert_refused("object 0: front: emission");
        hard_world(&world, &sphere);
        world.scene.global_ambient.x = i == 4 ? 2e6 : bad[i];
        assert_refused("scene: global ambient");
    }
    hard_world(&world, &sphere);
    world.scene.camera.center = world.scene.camera.eye;
    assert_refused("camera: eye");
    hard_world(&world, &sphere);
    world.scene.camera.up = (Vec3){0, 0, -3};
    assert_refused("camera: eye");
    hard_world(&world, &sphere);
    world.scene.camera.fovy = 180;
    assert_refused("camera: fovy");
    hard_world(&world, &sphere);
    world.scene.camera.near = 0;
    assert_refused("camera: fovy");
    hard_world(&world, &sphere);
    world.objects[0].world_from_object.m[5] = NAN;
    assert_refused("object 0: its matrix");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shininess_of_0_is_a_highlight_wherever_light_falls),
        cmocka_unit_test(negative_cosines_make_no_highlight),
        cmocka_unit_test(opposite_light_and_viewer_make_no_highlight),
        cmocka_unit_test(there_is_no_highlight_where_light_does_not_fall),
        cmocka_unit_test(the_eye_may_be_within_the_object_and_on_it),
        cmocka_unit_test(grazing_light_and_view_are_exact),
        cmocka_unit_test(over_exposure_is_clamped_once),
        cmocka_unit_test(every_byte_survives),
        cmocka_unit_test(a_ramp_of_a_fiftieth_has_six_levels),
        cmocka_unit_test(alpha_is_kept_and_colours_are_not_multiplied_by_it),
        cmocka_unit_test(srgb_is_encoded_from_end_to_end),
        cmocka_unit_test(materials_and_cameras_without_meaning_are_refused_by_name),
    };
    if (!picture_check_driver("hard shading"))
        return EXIT_SKIPPED;
    return cmocka_run_group_tests_name("hard shading", tests, open_all, close_all);
}
