/*
 * The search for scenes that are drawn wrongly: it finds what is known to be wrong and makes it
 * small; of what is right it finds nothing, in as many steps as there is time for here. `adversary`
 * goes on for longer.
 *
 * HARD_SEED and HARD_STEPS in the environment choose another search.
 */
#include "picture_check.h"
#include "search.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

enum { SIZE = 24, STEPS = 700, MOST_STEPS = 1500 };

static Search search; /* that of the test that runs */
static unsigned long long seed = 1;
static int steps = STEPS;

/* Lights a quarter too far to one side. */
static Vec3 wrong_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world)
{
    return vec3_add(scene_eye_point(camera, eye_from_world, point_world), (Vec3){0.25, 0, 0});
}

static Mat4 clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object)
{
    (void)eye_from_world, (void)world_from_object;
    return mat4_product(clip_from_eye, eye_from_object);
}

static void what_is_wrong_is_found_and_made_small(void **state)
{
    static const LightingTransforms wrong = {scene_eye_from_object, wrong_point, clip_from_object};
    (void)state;
    search_open(&search, SIZE, 1);
    search.tame = true;
    lighting_use_transforms(search.hard.lightings[HARD_HIGHP], &wrong);
    while (search.error < 8 && search.steps < MOST_STEPS)
        if (search_step(&search))
            search.error = -1;
    const double error = search.error;
    RandomScene small = search.current;
    assert_true(error >= 8);
    search_shrink(&search, &small, 5);
    assert_true(search_error(&search, &small, 0) >= 5);
    assert_int_equal(small.scene.object_count, 1);
    assert_int_equal(small.scene.light_count, 1);
    assert_true(small.lights[0].kind != LIGHT_DIRECTIONAL);
    /* The cause gone, it is right. */
    lighting_use_transforms(search.hard.lightings[HARD_HIGHP], NULL);
    assert_true(search_error(&search, &small, 0) < 0.5);
    print_message("%.3g steps of 1/255 after %lld scenes\n", error, search.judged);
}

static void the_same_seed_searches_the_same(void **state)
{
    double errors[2] = {0, 0};
    (void)state;
    for (int i = 0; i < 2; i++) {
        search_open(&search, 8, 5);
        for (int k = 0; k < 20; k++) {
            search_step(&search);
            errors[i] += search.error * (k + 1);
        }
        if (i == 0)
            search_close(&search);
    }
    assert_true(errors[0] == errors[1]);
}

static void nothing_is_found_in_what_is_right(void **state)
{
    double worst = 0;
    (void)state;
    search_open(&search, SIZE, seed);
    search.tame = true;
    while (search.steps < steps) {
        const bool done = search_step(&search);
        worst = fmax(worst, search.error);
        if (worst > 0.5) {
            RandomScene small = search.current;
            search_shrink(&search, &small, 0.5);
            random_scene_print(&small, "FOUND", stdout);
            fail_msg("seed %llu: wrong by %g steps of 1/255", seed, worst);
        }
        if (done)
            search.error = -1;
    }
    print_message("HARD_SEED=%llu HARD_STEPS=%d: %lld scenes, at most %.3g steps of 1/255 beyond "
                  "rounding\n",
                  seed, steps, search.judged, worst);
}

static int close_search(void **state)
{
    (void)state;
    search_close(&search);
    return 0;
}

int main(void)
{
    const char *given = getenv("HARD_SEED"), *given_steps = getenv("HARD_STEPS");
    if (!picture_check_driver("hard search"))
        return EXIT_SKIPPED;
    seed = given ? strtoull(given, NULL, 10) : seed;
    steps = given_steps ? atoi(given_steps) : steps;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(what_is_wrong_is_found_and_made_small, close_search),
        cmocka_unit_test_teardown(the_same_seed_searches_the_same, close_search),
        cmocka_unit_test_teardown(nothing_is_found_in_what_is_right, close_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
