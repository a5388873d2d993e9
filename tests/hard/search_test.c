/*
 * The search finds and shrinks a known error, and finds none in correct lighting. `adversary` runs
 * longer. HARD_SEED and HARD_STEPS choose another search.
 */
#include "hard/search.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 24, STEPS = 700, MAX_STEPS = 1500 };

static Search search; /* of the test that runs */
static unsigned long long seed = 1;
static int steps = STEPS;

/* Lights moved to one side by a quarter. */
static Vec3 wrong_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world)
{
    return vec3_add(scene_eye_point(camera, eye_from_world, point_world), (Vec3){0.25, 0, 0});
}

FIXTURE(close_search)
{
    search_close(&search);
    return 0;
}

static Mat4 clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object)
{
    (void)eye_from_world, (void)world_from_object;
    return mat4_product(clip_from_eye, eye_from_object);
}

TEST_WITH(0, a_known_error_is_found_and_shrunk, NULL, close_search)
{
    static const LightingTransforms wrong = {scene_eye_from_object, wrong_point, clip_from_object};
    search_open(&search, SIZE, 1);
    search.tame = true;
    lighting_use_transforms(hard.lightings[HARD_HIGHP], &wrong);
    while (search.error < 8 && search.steps < MAX_STEPS)
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
    /* Without the cause the picture is right. */
    lighting_use_transforms(hard.lightings[HARD_HIGHP], NULL);
    assert_true(search_error(&search, &small, 0) < 0.5);
    print_message("%.3g steps of 1/255 after %lld scenes\n", error, search.judged);
}

TEST_WITH(0, the_same_seed_searches_the_same, NULL, close_search)
{
    double errors[2] = {0, 0};
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

TEST_WITH(0, no_error_is_found_in_correct_lighting, NULL, close_search)
{
    double worst = 0;
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

int main(void)
{
    const char *given = getenv("HARD_SEED"), *given_steps = getenv("HARD_STEPS");
    if (!picture_check_driver("hard search"))
        return EXIT_SKIPPED;
    seed = given ? strtoull(given, NULL, 10) : seed;
    steps = given_steps ? atoi(given_steps) : steps;
    return testing_run(0, "search", NULL, NULL);
}
