/*
 * Hard cases of lights: far away, on the surface and within the object; attenuation and cones at
 * the ends of their ranges; directions of any length; no light, black ones, and the maximum number.
 */
#include "hard/hard.h"
#include "reference/reference_trace.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 48, SEED = 20140201 };

static const double RADIANS = 0.017453292519943295;
static const double REACH = 4;        /* see normals_test.c */
static const double NEXT_TO_IT = 1e9; /* the light: in mediump its direction has no correct digit */

static HardWorld world;
static unsigned char before[4 * SIZE * SIZE];

static void check(const char *name, double reach)
{
    hard_check_reflections(name, &world, reach, SIZE * SIZE / 8);
}

/* Keeps the byte picture for comparison. */
static void draw_before(HardPrecision precision)
{
    hard_draw_finite(&world.scene, precision);
    memcpy(before, hard.image.pixels, sizeof before);
}

/* How many pixels are more than `levels` from the kept picture. */
static int draw_after(HardPrecision precision, int levels)
{
    hard_draw_finite(&world.scene, precision);
    return pixels_apart(before, hard.image.pixels, SIZE * SIZE, levels);
}

TEST(a_point_light_far_away_is_a_directional_one)
{
    static const Vec3 way = {0.4, 0.5, 0.8};
    for (int interpolation = 0; interpolation < 2; interpolation++)
        for (int exponent = 8; exponent <= 14; exponent += 3) {
            hard_world(&world, &hard.sphere);
            world.scene.interpolation = (Interpolation)interpolation;
            world.lights[0].kind = LIGHT_DIRECTIONAL;
            world.lights[0].direction = way;
            draw_before(HARD_HIGHP);
            world.lights[0].kind = LIGHT_POINT;
            world.lights[0].position = vec3_scale(way, pow(10, exponent));
            assert_int_equal(draw_after(HARD_HIGHP, 1), 0);
            hard_check("far light", &world.scene, HARD_HIGHP, 1, SIZE * SIZE / 8);
        }
    hard_report("point lights at 1e8 to 1e14");
}

/* In mediump a square of more than 65504 is infinite, so a light farther than 255.9 has no
 * direction. At the vertices, which are highp, it has one. */
TEST(in_mediump_lights_are_near_or_at_infinity)
{
    static const Vec3 way = {0.39036, 0.48795, 0.78072};
    for (int exponent = 0; exponent < 3; exponent++) {
        hard_world(&world, &hard.sphere);
        world.lights[0].position = vec3_scale(way, 3 * pow(9, exponent)); /* 3, 27, 243 */
        check("light within reach of mediump", REACH);
    }
    hard_world(&world, &hard.sphere);
    world.lights[0].position = vec3_scale(way, 1e8);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    hard_check("light beyond mediump, at vertices", &world.scene, HARD_MEDIUMP, 1.5,
               SIZE * SIZE / 8);
    world.scene.interpolation = INTERPOLATION_PHONG;
    const HardResult result = hard_draw(&world.scene, HARD_MEDIUMP, NULL);
    assert_int_equal(result.not_finite, 0);
    printf("a light at 1e8, at fragments in mediump: error %.1f\n", result.byte_error);

    hard_report("lights within reach of mediump");
}

TEST(a_light_may_touch_the_object_or_be_inside)
{
    /* In the quad's plane and above it, at vertices of both objects: the middle and a corner of the
     * quad, the sphere's pole and the vertex that faces the eye. */
    static const struct {
        bool on_sphere;
        Vec3 position;
    } places[] = {
        {false, {0.3, 0.2, 0}},     {false, {0.3, 0.2, 0.001}}, {false, {0.3, 0.2, 1e-6}},
        {false, {0, 0, 0}},         {false, {-1, 1, 0}},        {true, {0, 0, 0}},
        {true, {0, 1, 0}},          {true, {0, 0, 1}},          {true, {0.3, 0.2, 0.93}},
        {true, {0.5, 0.25, -0.25}}, {true, {0, 0, 4}},
    };
    CLOSED(mesh_close) Mesh fine_quad;
    SUCCEEDS(solid_mesh(&(Solid){.kind = SOLID_QUAD}, 16, &fine_quad, message));
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        for (int fades = 0; fades < 2; fades++) {
            hard_world(&world, places[i].on_sphere ? &hard.sphere : &fine_quad);
            world.lights[0].position = places[i].position;
            world.lights[0].constant = fades ? 1 : 0;
            world.lights[0].quadratic = fades ? 0.5 : 0;
            check(formatted("light on the object, %zu", i), NEXT_TO_IT);
        }
    hard_forget(&fine_quad);
    hard_report("lights on and within the object");
}

/* In mediump the inverse of less than 1 / 65504 is infinite, and infinity times a cosine of 0 is
 * NaN: the denominator must be larger. */
static bool fit_for_mediump(Vec3 factors, double nearest)
{
    return (factors.x == 0 && factors.y == 0 && factors.z == 0) ||
           factors.x + nearest * (factors.y + nearest * factors.z) > 1.6e-5;
}

static void check_at_fragments_and_vertices(const char *name, HardPrecision precision)
{
    const bool half = precision == HARD_MEDIUMP;
    for (int reflection = 0; reflection < 2; reflection++) {
        world.scene.reflection = (Reflection)reflection;
        world.scene.interpolation = INTERPOLATION_PHONG;
        hard_check(name, &world.scene, precision,
                   half ? oracle_mediump_max(&world.scene, NEXT_TO_IT) : 1, SIZE * SIZE / 8);
        world.scene.interpolation = INTERPOLATION_GOURAUD;
        hard_check(name, &world.scene, precision, half ? 1.5 : 1, SIZE * SIZE / 8);
    }
}

TEST(attenuation_of_any_size_is_finite)
{
    static const Vec3 factors[] = {
        {0, 0, 0},       {1e-30, 0, 0},   {0, 1e-30, 0},   {0, 0, 1e-30}, {1e-3, 1e-3, 1e-3},
        {0.5, 0.2, 0.1}, {0, 0, 1},       {1e30, 0, 0},    {0, 1e30, 0},  {0, 0, 1e30},
        {1, 1e30, 1e30}, {1e-30, 1, 0.1}, {1e30, 1e30, 1}, {0, 1e-3, 0},  {1e4, 1e4, 1e4},
    };
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++)
        for (int touches = 0; touches < 2; touches++) {
            hard_world(&world, touches ? &hard.quad : &hard.sphere);
            world.lights[0].constant = factors[i].x;
            world.lights[0].linear = factors[i].y;
            world.lights[0].quadratic = factors[i].z;
            if (touches)
                world.lights[0].position = (Vec3){0, 0, 0};
            const char *name = formatted("attenuation %zu%s", i, touches ? ", touching" : "");
            check_at_fragments_and_vertices(name, HARD_HIGHP);
            if (fit_for_mediump(factors[i], touches ? 0 : 2))
                check_at_fragments_and_vertices(name, HARD_MEDIUMP);
            else
                hard_draw_finite(&world.scene, HARD_MEDIUMP);
        }
    hard_report("attenuation of 1e-30 to 1e30");
}

/* Compares every pixel of the object at its centre: within `max` steps of the exact colour, except
 * where the cosine of its angle from the axis is within `margin` of the cone's edge. */
static double compare_centres(HardPrecision precision, double margin, int *compared)
{
    Trace *trace;
    double worst = 0;
    Vec3 axis;
    const Light *light = &world.lights[0];
    hard_draw_finite(&world.scene, precision);
    SUCCEEDS(trace_open(
        &trace, &world.scene,
        &(ReferenceOptions){.width = SIZE, .height = SIZE, .meshes = true, .threads = 1}, message));
    vec3_normalize(light->direction, &axis);
    for (int i = 0; i < SIZE * SIZE; i++) {
        Sample sample;
        Vec3 way;
        trace_sample(trace, i % SIZE + 0.5, i / SIZE + 0.5, &sample);
        if (sample.object < 0)
            continue;
        vec3_normalize(
            vec3_subtract(vec3_add(sample.position, world.scene.camera.eye), light->position),
            &way);
        if (fabs(vec3_dot(way, axis) - cos(light->cutoff * RADIANS)) <= margin)
            continue;
        ++*compared;
        for (int c = 0; c < 3; c++)
            worst = fmax(worst, fabs(((unsigned char *)hard.image.pixels)[4 * i + c] -
                                     255 * (double)sample.color[c]));
    }
    trace_close(trace);
    return worst;
}

/* In highp a cosine near 1 has a last digit of 6e-8, and the direction an error of a few of them;
 * in mediump the direction's error is that of oracle_mediump_max, plus 3 units for the product.
 * Then the power: its error is exp(exponent * error) - 1 of the light. */
TEST(a_cone_has_its_exact_edge)
{
    static const double cutoffs[] = {0, 0.001, 1, 7.3, 13.7, 45, 60, 89, 90};
    static const double exponents[] = {0, 1, 7.5, 128};
    static const double MEDIUMP = (4 + 3.5 + 3) * 0x1p-11;
    double worst[2] = {0, 0};
    int compared = 0;
    for (size_t i = 0; i < sizeof cutoffs / sizeof cutoffs[0]; i++)
        for (size_t k = 0; k < sizeof exponents / sizeof exponents[0]; k++) {
            hard_world(&world, &hard.quad);
            world.lights[0].kind = LIGHT_SPOT;
            world.lights[0].position = (Vec3){0.6, 0.8, 1.2};
            world.lights[0].direction = (Vec3){-0.3, -0.4, -0.7};
            world.lights[0].cutoff = cutoffs[i];
            world.lights[0].exponent = exponents[k];
            for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
                const double margin = precision == HARD_HIGHP ? 5e-7 : MEDIUMP;
                const double max = precision == HARD_HIGHP
                                       ? 1
                                       : fmin(255, oracle_mediump_max(&world.scene, REACH) +
                                                       255 * expm1(exponents[k] * MEDIUMP));
                const double error = compare_centres(precision, margin, &compared);
                worst[precision] = fmax(worst[precision], error);
                if (error > max)
                    fail_msg("cutoff %g, exponent %g, precision %d: %.3f of %.3f", cutoffs[i],
                             exponents[k], precision, error, max);
            }
        }
    assert_true(compared > SIZE * SIZE * 30);
    printf("cones: %d pixels, largest error %.2f in highp, %.2f in mediump\n", compared, worst[0],
           worst[1]);
}

TEST(the_length_of_a_direction_does_not_matter)
{
    static const double lengths[] = {1e-307, 1e-300, 1e-160, 1e-20, 1e20, 1e160, 1e300, 1e307};
    for (int kind = 0; kind < 2; kind++)
        for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
            hard_world(&world, &hard.sphere);
            world.lights[0].kind = kind ? LIGHT_SPOT : LIGHT_DIRECTIONAL;
            world.lights[0].cutoff = 14.3;
            world.lights[0].direction = kind ? (Vec3){-1.4, -1.8, -3.5} : (Vec3){1.4, 1.8, 3.5};
            const Vec3 unit = world.lights[0].direction;
            draw_before(precision);
            for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
                world.lights[0].direction = vec3_scale(unit, lengths[i]);
                assert_int_equal(draw_after(precision, precision == HARD_HIGHP), 0);
            }
        }
}

/* In mediump no number is above 65504: at the fragments the light is limited to less, and colours
 * have no bound. At the vertices colours are finite, and clamped once they are infinite. */
TEST(intensities_of_any_size_are_finite)
{
    static const double intensities[] = {0, 1e-30, 1e-3, 1, 100, 1e4, 1e5, 1e6};
    for (size_t i = 0; i < sizeof intensities / sizeof intensities[0]; i++)
        for (int interpolation = 0; interpolation < 2; interpolation++) {
            const double much = intensities[i];
            hard_world(&world, &hard.sphere);
            world.scene.interpolation = (Interpolation)interpolation;
            world.lights[0].diffuse = world.lights[0].specular = (Vec3){much, much, much};
            const char *name = formatted("intensity %g", much);
            hard_check(name, &world.scene, HARD_HIGHP, 1, SIZE * SIZE / 8);
            if (much < 65504)
                hard_check(name, &world.scene, HARD_MEDIUMP,
                           interpolation ? fmin(255, 1.5 + much)
                                         : oracle_mediump_max(&world.scene, REACH),
                           SIZE * SIZE / 8);
            else
                hard_draw_finite(&world.scene, HARD_MEDIUMP);
        }
    hard_report("intensities of 0 to 1e6");
}

static void random_light(Random *random, Light *light)
{
    light->kind = random_below(random, 2) ? LIGHT_POINT : LIGHT_DIRECTIONAL;
    light->direction = hard_random_direction(random);
    light->position = vec3_scale(hard_random_direction(random), 4);
    light->position.z = fabs(light->position.z) + 1;
    light->direction.z = fabs(light->direction.z) + 0.3;
    light->constant = 1;
    light->linear = random_below(random, 2);
    for (int c = 0; c < 3; c++) {
        double *const channels[] = {&light->diffuse.x, &light->specular.y, &light->ambient.z};
        *channels[c] = random_between(random, 0, 0.05);
    }
}

TEST(thirty_two_lights_add_up)
{
    Random random = {SEED};
    const int factor = testing_step(2) == 1 ? 1 : 32; /* or 0, 32 */
    printf("seed %d\n", SEED);
    for (int count = 0; count <= 32; count = (count ? 2 * count : 1) * factor) {
        hard_world(&world, &hard.sphere);
        world.scene.light_count = count;
        for (int i = 0; i < count; i++)
            random_light(&random, &world.lights[i]);
        check("many lights", REACH);
    }
    hard_report("0 to 32 lights");
}

HARD_TEST_MAIN("hard lights", SIZE)
