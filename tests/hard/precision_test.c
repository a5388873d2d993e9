/*
 * The effect of the fragment shader's precision on highlights. highp is right everywhere. mediump,
 * 11 significant bits from 6.1e-5 to 65504, has bounds but no expected values: which operations are
 * computed in it depends on the driver's compiler.
 */
#include "hard/hard.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 128 };

static HardWorld world;
static Mesh sphere;
static Lighting *cosine[2]; /* as hard_open made them */

FIXTURE(open_all)
{
    hard_open(SIZE, SIZE);
    memcpy(cosine, hard.lightings, sizeof cosine);
    SUCCEEDS(mesh_sphere(&sphere, 1, 96, 48, message));
}

FIXTURE(close_all)
{
    mesh_close(&sphere);
    hard_close();
}

static double worst_of(double shininess, Reflection reflection, HardPrecision precision)
{
    /* Only a highlight, as bright as a light can be. */
    hard_world(&world, &sphere);
    world.scene.global_ambient = (Vec3){0, 0, 0};
    world.scene.reflection = reflection;
    world.lights[0].ambient = world.lights[0].diffuse = (Vec3){0, 0, 0};
    world.objects[0].front.specular = (Vec3){1, 1, 1};
    world.objects[0].front.shininess = shininess;
    const HardResult result = hard_draw(&world.scene, precision, NULL);
    assert_int_equal(result.not_finite, 0);

    assert_true(result.interior_pixels > SIZE * SIZE / 8);
    return result.byte_error;
}

/* Lagrange's identity: the highlight is (1 - q^2)^(s / 2), where q is the length of a cross
 * product. With u = 2^-11, oracle_mediump_max gives the errors e of the two vectors: 17 u for
 * normal and half vector, 54 u for reflection and viewer; the error of q is no larger. The slope of
 * the power over q is at most s / sqrt(s - 1) ((s - 2) / (s - 1))^(s / 2 - 1), about sqrt(s).
 * Rounding 1 - q^2 by u / 2 near 1 adds s u / 4; the square, the power and the product with a color
 * add 9 u. For s below 2 the slope has no bound where the cosine is 0, but the result is bounded by
 * about the square root of the error. The cosine's own form has s e instead of sqrt(s) e. */
static double cross_max(double s, bool phong)
{
    const double u = 0x1p-11, e = (phong ? 54 : 17) * u;
    const double moved = s < 2
                             ? pow(2 * e + 4 * u, s / 2)
                             : s / sqrt(s - 1) * pow((s - 2) / (s - 1), s / 2 - 1) * e + s * u / 4;
    return 0.5 + 255 * (moved + 9 * u);
}

TEST(the_cross_product_keeps_the_digits_of_a_highlight)
{
    static const ShaderReplacement replacements[] = {
        {"lighting/highlight.glsl", "study/highlight_cross.glsl"}, {NULL, NULL}};
    static const char *const precisions[] = {"highp", "mediump"};
    static const double shininesses[] = {1, 8, 32, 128};
    Lighting *cross[2];
    for (int i = 0; i < 2; i++) {
        const ShaderLoader loader = {.precision = precisions[i], .replacements = replacements};
        SUCCEEDS(lighting_open(&cross[i], &loader, message));
    }
    for (size_t i = 0; i < sizeof shininesses / sizeof shininesses[0]; i++) {
        const double s = shininesses[i];
        for (int reflection = 0; reflection < 2; reflection++) {
            const double derived = cross_max(s, reflection);
            const double by_cosine = worst_of(s, (Reflection)reflection, HARD_MEDIUMP);
            memcpy(hard.lightings, cross, sizeof cross);
            const double medium = worst_of(s, (Reflection)reflection, HARD_MEDIUMP);
            const double high = worst_of(s, (Reflection)reflection, HARD_HIGHP);
            memcpy(hard.lightings, cosine, sizeof cosine);
            printf("shininess %g, %s, by the cross product: %.2f in highp, %.2f in mediump "
                   "(derived: at most %.1f), by the cosine %.2f\n",
                   s, reflection ? "Phong" : "Blinn-Phong", high, medium, derived, by_cosine);
            /* Of vectors derived for s = 1 nothing is left: at most 15.5 was measured (lavapipe).
             * The cosine's own form is up to 75 off. */
            if (high > 1 || medium > derived || medium > 25)
                fail_msg("shininess %g, reflection %d", s, reflection);
        }
    }
    for (int i = 0; i < 2; i++)
        lighting_close(cross[i]);
}

PICTURE_TEST_MAIN("hard precision", open_all, close_all)
