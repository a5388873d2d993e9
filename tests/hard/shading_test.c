/*
 * Hard cases of the lighting equation: powers of 0 and to 0, opposite directions, light and eye on
 * the surface or behind it, overexposure, transparency, emission, sRGB.
 */
#include "hard/hard.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 48, SEED = 20140301 };

static const double REACH = 4;      /* see normals_test.c */
static const double NO_REACH = 1e9; /* eye or light on the surface: in mediump no correct digit */

static HardWorld world;

static void check(const char *name, double reach)
{
    hard_check_reflections(name, &world, reach, SIZE * SIZE / 8);
}

static const unsigned char *pixel(int x, int y)
{
    return (unsigned char *)hard.image.pixels + 4 * (y * SIZE + x);
}

/* A light with only a highlight. */
static void only_specular(const Mesh *mesh, double shininess)
{
    hard_world(&world, mesh);
    world.scene.global_ambient = (Vec3){0, 0, 0};
    world.lights[0].ambient = world.lights[0].diffuse = (Vec3){0, 0, 0};
    world.objects[0].front.shininess = world.objects[0].back.shininess = shininess;
}

/* Any cosine to the power of 0 is 1, also 0 and negative ones, if the surface faces the light. */
TEST(a_shininess_of_0_is_a_highlight_on_all_lit_points)
{
    static const int expected[] = {255, 128, 64}; /* of 255, 127.5, 63.75 */
    for (int way = 0; way < 8; way++) {
        only_specular(&hard.quad, 0);
        world.objects[0].front.specular = (Vec3){1, 0.5, 0.25};
        world.scene.reflection = way & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
        world.scene.interpolation = way & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
        world.scene.distant_viewer = way & 4;
        for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
            /* Oblique, so that R.V is negative over a part of the quad. */
            world.lights[0].position = (Vec3){-3, 0, 0.05};
            hard_draw_finite(&world.scene, precision);
            for (int x = SIZE / 4; x < SIZE; x += SIZE / 4)
                for (int c = 0; c < 3; c++)
                    if (pixel(x, SIZE / 2)[c] != expected[c])
                        fail_msg("way %d, precision %d, column %d: %d for %d", way, precision, x,
                                 pixel(x, SIZE / 2)[c], expected[c]);
            world.lights[0].position = (Vec3){-3, 0, -0.05};
            hard_draw_finite(&world.scene, precision);
            for (int x = SIZE / 4; x < SIZE; x += SIZE / 4)
                for (int c = 0; c < 3; c++)
                    assert_int_equal(pixel(x, SIZE / 2)[c], 0);
        }
        only_specular(&hard.sphere, 0);
        check("shininess 0", REACH);
    }
    hard_report("shininess 0");
}

/* With a shininess of 1, 3 or 5 a negative cosine would darken the picture, and pow is undefined
 * for it. */
TEST(negative_cosines_make_no_highlight)
{
    static const double odd[] = {1, 3, 5, 0.5, 1e-3, 127};
    static const Vec3 lights[] = {{1.5, 2, 3.5}, {-4, 1, 0.5}, {0.5, 3, -2}};
    CLOSED(mesh_close) Mesh cube;
    SUCCEEDS(mesh_cube(&cube, 0.8, message));
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++)
        for (size_t k = 0; k < sizeof lights / sizeof lights[0]; k++) {
            hard_world(&world, k == 1 ? &cube : &hard.sphere);
            world.lights[0].position = lights[k];
            world.objects[0].front.shininess = odd[i];
            /* Light and viewer are far apart: the highlight is still visible where the surface
             * turns dark, and there signs may differ in mediump. */
            check(formatted("negative cosines, shininess %g, light %zu", odd[i], k),
                  k ? NO_REACH : REACH);
        }
    hard_forget(&cube);
    hard_report("negative cosines");
}

/* Light exactly behind the surface, as seen from the eye: L + V is zero. */
TEST(opposite_light_and_viewer_make_no_highlight)
{
    for (int way = 0; way < 16; way++) {
        const double shininess = way & 1 ? 0 : 8;
        only_specular(&hard.quad, shininess);
        world.scene.reflection = way & 2 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
        world.scene.interpolation = way & 4 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
        world.scene.distant_viewer = way & 8;
        world.lights[0].position = world.lights[0].direction = (Vec3){0, 0, -4};
        for (int kind = 0; kind < 2; kind++) {
            world.lights[0].kind = (LightKind)kind;
            for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
                hard_draw_finite(&world.scene, precision);

                for (int i = SIZE / 3; i < 2 * SIZE / 3; i++)
                    assert_int_equal(pixel(i, i)[0], 0);
            }
        }
    }
}

/* Both reflections, from the unlit side. */
TEST(unlit_points_have_no_highlight)
{
    Random random = {SEED};
    printf("seed %d\n", SEED);
    for (int i = 0; i < 24; i++) {
        only_specular(&hard.quad, i % 3 == 0 ? 1 : 8);
        world.objects[0].front.specular = (Vec3){1, 1, 1};
        world.lights[0].position = hard_random_direction(&random);
        world.lights[0].position.z = -0.01 - fabs(world.lights[0].position.z);
        world.scene.reflection = (Reflection)(i & 1);
        world.scene.interpolation = (Interpolation)(i >> 1 & 1);
        for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
            const HardResult result = hard_draw(&world.scene, precision, NULL);

            assert_true(result.byte_error == 0 && result.not_finite == 0 &&
                        result.interior_pixels > SIZE * SIZE / 4);
        }
    }
}

TEST(the_eye_may_be_within_the_object_and_on_it)
{
    static const Vec3 eyes[] = {{0, 0, 0}, {0.3, 0.2, 0.1}, {0, 0, 1}, {0, 0.6, 0.8}};
    for (size_t i = 0; i < sizeof eyes / sizeof eyes[0]; i++)
        for (int two_sided = 0; two_sided < 2; two_sided++) {
            hard_world(&world, &hard.sphere);
            world.objects[0].two_sided = two_sided;
            world.objects[0].closed = true;
            world.lights[0].position = (Vec3){0.2, 0.5, 0.1};
            world.scene.camera.eye = eyes[i];
            world.scene.camera.center = (Vec3){0.1, 0.1, -2};
            world.scene.camera.near = 0.01;
            check("eye within", NO_REACH);
        }
    hard_report("eye on and within the object");
}

TEST(grazing_light_and_view_are_exact)
{
    static const double degrees[] = {1, 0.1, 0.01};
    for (size_t i = 0; i < sizeof degrees / sizeof degrees[0]; i++) {
        const double sine = sin(degrees[i] * acos(-1) / 180);
        hard_world(&world, &hard.quad);
        world.lights[0].kind = LIGHT_DIRECTIONAL;
        world.lights[0].direction = (Vec3){1, 0, sine};
        check("grazing light", NO_REACH);
        hard_world(&world, &hard.quad);
        world.objects[0].world_from_object = mat4_rotate(90 - 20 * degrees[i], (Vec3){1, 0, 0});
        world.scene.camera.fovy = 0.6 + 40 * sine;
        world.lights[0].position = (Vec3){1, 2, -3};
        for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++)
            hard_check("grazing view", &world.scene, precision, precision ? 255 : 1, SIZE / 4);
    }
    hard_report("grazing light and view");
}

/* The sum is clamped once, at the end: an excess in one term does not hide another. */
TEST(over_exposure_is_clamped_once)
{
    for (int way = 0; way < 8; way++) {
        hard_world(&world, &hard.sphere);
        world.lights[0].diffuse = (Vec3){3, 2, 1};
        world.lights[0].specular = (Vec3){1, 2, 3};
        world.scene.clamp_vertex = way & 1;
        world.scene.linear = way & 2;
        world.objects[0].two_sided = way & 4;
        if (!world.scene.linear)
            check("over-exposed", REACH);
        for (int i = 0; i < 2; i++) {
            world.scene.interpolation = (Interpolation)i;
            hard_check("over-exposed", &world.scene, HARD_HIGHP, 1, SIZE * SIZE / 8);
        }
    }
    hard_report("over-exposure");
}

/* Emission k / 255 is byte k, in each channel and precision: half a step is 2^-9, and k / 255
 * rounded to 11 bits has an error of at most 2^-12. */
TEST(every_byte_is_reproduced)
{
    for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++)
        for (int k = 0; k < 256; k += testing_step(15)) {
            hard_world(&world, &hard.quad);
            world.scene.light_count = 0;
            world.scene.global_ambient = (Vec3){0, 0, 0};
            world.objects[0].front.emission =
                (Vec3){k / 255.0, (255 - k) / 255.0, (k ^ 85) / 255.0};
            hard_check("emission", &world.scene, precision, precision ? 0.07 : 0.001,
                       SIZE * SIZE / 4);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[0], k);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[1], 255 - k);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[2], k ^ 85);
        }
    hard_report("emission of k / 255");
}

TEST(alpha_is_kept_and_colours_are_not_premultiplied)
{
    static const double alphas[] = {0, 1e-30, 0.25, 1};
    for (size_t i = 0; i < sizeof alphas / sizeof alphas[0]; i++)
        for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
            hard_world(&world, &hard.sphere);
            world.objects[0].front.alpha = alphas[i];
            hard_check("alpha", &world.scene, precision,
                       precision ? oracle_mediump_max(&world.scene, REACH) : 1, SIZE * SIZE / 8);
            assert_int_equal(pixel(SIZE / 2, SIZE / 2)[3], (int)lrint(255 * alphas[i]));
        }
    hard_report("alpha 0 to 1");
}

static double encoded(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* At 0 and 1, at the knee, beside it, and overexposed. In mediump the power is computed as 2 to the
 * power of log2(x) / 2.4: log2(0.0031308) is -8.3, known to 2^-8, half its last digit, which is
 * 0.0027 / 2.4 of the value; plus 3 units for the other operations, times 1.055 * 255. */
TEST(srgb_is_encoded_from_end_to_end)
{
    static const double values[] = {0,         1e-7,  1e-4, 0.003130, 0.0031308, 0.0031309, 0.0032,
                                    0.0044366, 0.018, 0.2,  0.5,      0.999,     1,         1};
    static const double mediump = 0.5 + 255 * 1.055 * (2 * 0x1p-8 / 2.4 + 4 * 0x1p-11);
    for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++)
        for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
            hard_world(&world, &hard.quad);
            world.scene.linear = true;
            world.scene.light_count = 0;
            world.scene.global_ambient = (Vec3){0, 0, 0};
            world.objects[0].front.emission = (Vec3){values[i], values[i], values[i]};
            if (i == sizeof values / sizeof values[0] - 1) /* 1.5 in all */
                world.scene.global_ambient = (Vec3){1, 1, 1};
            hard_check("sRGB", &world.scene, precision, precision ? mediump : 0.51,
                       SIZE * SIZE / 4);
            if (precision == HARD_HIGHP)
                assert_true(fabs(pixel(SIZE / 2, SIZE / 2)[0] - 255 * encoded(values[i])) < 0.51);
        }
    hard_report("sRGB from 0 to 1");
}

HARD_TEST_MAIN("hard shading", SIZE)
