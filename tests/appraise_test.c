/*
 * The distance from the exact picture that is found in the background, against the same computed
 * here: of every scene there is an example of, with each option that changes what is exact.
 *
 * All pictures are drawn, and what is right about them is computed, before the first thread is
 * started, and the canvas is closed by then: a checker of threads sees this project's alone.
 */
#include "appraise.h"
#include "picture_check.h"
#include "progress.h"
#include "stage.h"
#include "testing.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define X(NAME) extern const Example NAME;
LIGHTING_EXAMPLES
#undef X

#define X(NAME) &NAME,
static const Example *const EXAMPLES[] = {LIGHTING_EXAMPLES};
#undef X

enum { EXAMPLE_COUNT = sizeof EXAMPLES / sizeof EXAMPLES[0], WIDTH = 200, HEIGHT = 150 };

static const double SECONDS = 1.3, ERROR = 4;

#define SIZE .width = WIDTH, .height = HEIGHT

/* What changes the exact picture, or should not. */
static const struct {
    const char *name, *output;
    Options options;
    bool teapots; /* draw those examples too, whose exact pictures take long */
} WAYS[] = {
    {"", "x.png", {SIZE}, true},
    {"--linear", "x.png", {SIZE, .linear = true}, false},
    {"--clamp vertex", "x.png", {SIZE, .clamp_vertex = true}, false},
    {"--show-clipped", "x.png", {SIZE, .show_clipped = true}, false},
    {"--orbit 30,10,0.8", "x.png", {SIZE, .orbit = {30, 10, 0.8}}, false},
    {"--alpha", "x.png", {SIZE, .alpha = true}, false},
    {"--samples 4", "x.png", {SIZE, .canvas = {.samples = 4}}, false},
    {"floats", "x.exr", {SIZE}, false},
    {"--error 4", "x.png", {SIZE, .cheap = true, .error = 4}, true},
    {"-s 1x1", "x.png", {.width = 1, .height = 1}, true},
    /* Less than a pixel for some of several views. */
    {"-s 2x1", "x.png", {.width = 2, .height = 1}, true},
};

enum { WAY_COUNT = sizeof WAYS / sizeof WAYS[0] };

/* A drawn picture, and what is known to be right. */
typedef struct Case {
    char name[64];
    AppraisePicture picture;
    ReferenceError expected;
} Case;

static Case cases[WAY_COUNT][EXAMPLE_COUNT];

static bool is_drawn(int way, int example)
{
    const bool teapot = EXAMPLES[example] == &Materials || EXAMPLES[example] == &FourLights;
    return WAYS[way].teapots || !teapot;
}

/* The scene of a view from the example itself, changed as the options say. */
static Scene scene_of(const Example *example, const Options *options, int view)
{
    Scene scene = {.object_count = 0};
    example->scene(SECONDS, view, &scene);
    orbit_move(options->orbit, &scene.camera.eye, scene.camera.center, &scene.camera.up);
    scene.clamp_vertex |= options->clamp_vertex;
    scene.linear |= options->linear;
    scene.show_clipped |= options->show_clipped;
    return scene;
}

/* Of all views, pixel by pixel, without the interior where another mesh was drawn: the mesh is the
 * stage's own. */
static ReferenceError expect(const Example *example, const Options *options, const Image *image)
{
    ReferenceError error = {.all = {0}};
    int columns = 1, rows = 1;
    if (example->layout)
        example->layout(&columns, &rows);
    for (int view = 0; view < columns * rows; view++) {
        const int column = view % columns, row = view / columns;
        const int left = column * image->width / columns, top = row * image->height / rows;
        const int right = (column + 1) * image->width / columns;
        const int bottom = (row + 1) * image->height / rows;
        Scene scene = scene_of(example, options, view);
        if (right == left || bottom == top || scene.object_count == 0)
            continue;
        Message message = {0};
        Reference exact, meshes;
        ReferenceOptions size = {.width = right - left, .height = bottom - top};
        require(reference_open(&exact, &scene, &size, &message), &message);
        size.meshes = true;
        size.edge_error = 255;
        scene.light_count = 0;
        scene.interpolation = INTERPOLATION_PHONG;
        require(reference_open(&meshes, &scene, &size, &message), &message);
        reference_error_add(&error, image, left, top, &exact, &meshes);
        reference_close(&exact);
        reference_close(&meshes);
    }
    return error;
}

static void draw_case(const Example *example, int way, const Canvas *canvas, Case *made)
{
    Message message = {0};
    Options options = WAYS[way].options;
    options.shaders.precision = "highp";
    snprintf(made->name, sizeof made->name, "%s %s", example->name, WAYS[way].name);
    require(stage_appraise(example, canvas, &options, SECONDS, &made->picture, &message), &message);
    made->expected = expect(example, &options, &made->picture.image);
}

static int draw_all(void **state)
{
    (void)state;
    char path[4096];
    snprintf(path, sizeof path, "%s/../common/efficient.csv", SHADERS_SOURCE);
    setenv("LIGHTING_EFFICIENT", path, 1);
    for (int way = 0; way < WAY_COUNT; way++) {
        for (int i = 0; i < EXAMPLE_COUNT; i++) {
            Options options = WAYS[way].options;
            Message message = {0};
            Canvas canvas;
            options.shaders.precision = "highp";
            if (!is_drawn(way, i))
                continue;
            require(stage_open(&canvas, &options, WAYS[way].output, &message), &message);
            require(stage_enter(EXAMPLES[i], &options, &message), &message);
            draw_case(EXAMPLES[i], way, &canvas, &cases[way][i]);
            stage_leave(EXAMPLES[i]);
            canvas_close(&canvas);
        }
    }
    return 0;
}

static int forget_all(void **state)
{
    (void)state;
    for (int way = 0; way < WAY_COUNT; way++)
        for (int i = 0; i < EXAMPLE_COUNT; i++)
            appraise_picture_close(&cases[way][i].picture);
    unsetenv("LIGHTING_EFFICIENT");
    return 0;
}

static void pause_for(double seconds)
{
    const struct timespec time = {(time_t)seconds, (long)(1e9 * fmod(seconds, 1))};
    nanosleep(&time, NULL);
}

static AppraiseResult wait_for(Appraise *appraise)
{
    AppraiseResult result;
    while (appraise_busy(appraise))
        pause_for(1e-3);
    appraise_result(appraise, &result);
    return result;
}

static void assert_same_sum(const char *name, const ErrorSum *a, const ErrorSum *b)
{
    if (a->pixels != b->pixels || a->wrong != b->wrong || a->squares != b->squares ||
        a->maximum != b->maximum || a->worst != b->worst)
        fail_msg("%s: %lld pixels, %lld wrong, largest %.17g; not %lld, %lld, %.17g", name,
                 a->pixels, a->wrong, a->maximum, b->pixels, b->wrong, b->maximum);
}

/* A copy of a picture, for what is taken over. */
static AppraisePicture copy_of(const AppraisePicture *picture)
{
    AppraisePicture copy;
    Message message = {0};
    const Image *image = &picture->image;
    require(appraise_picture_open(&copy, image->width, image->height, image->type,
                                  picture->view_count, &message),
            &message);
    memcpy(copy.image.pixels, image->pixels, image_row_size(image) * (size_t)image->height);
    copy.seconds = picture->seconds;
    for (int i = 0; i < picture->view_count; i++) {
        const AppraiseView *view = &picture->views[i];
        require(appraise_picture_add(&copy, view->place, &view->asked.scene,
                                     view->drawn.objects ? &view->drawn.scene : NULL, &message),
                &message);
    }
    return copy;
}

static void the_background_finds_what_is_found_here(void **state)
{
    (void)state;
    Message message = {0};
    Appraise *appraise;
    require(appraise_open(&appraise, &message), &message);
    for (int way = 0; way < WAY_COUNT; way++) {
        for (int i = 0; i < EXAMPLE_COUNT; i++) {
            const Case *of = &cases[way][i];
            if (!is_drawn(way, i))
                continue;
            AppraisePicture picture = copy_of(&of->picture);
            appraise_start(appraise, &picture);
            assert_null(picture.views);
            assert_null(picture.image.pixels);
            const AppraiseResult result = wait_for(appraise);
            require(result.known, &result.message);
            assert_false(result.computing);
            assert_true(result.seconds == SECONDS);
            assert_same_sum(of->name, &result.error.all, &of->expected.all);
            if (!WAYS[way].options.cheap)
                assert_same_sum(of->name, &result.error.interior, &of->expected.interior);
            if (WAYS[way].options.width == WIDTH)
                print_message("%-34s inside rms %6.3f, largest %7.2f; all rms %6.3f, largest "
                              "%7.2f; %4.0f ms\n",
                              of->name, error_sum_rms(&result.error.interior),
                              result.error.interior.maximum, error_sum_rms(&result.error.all),
                              result.error.all.maximum, result.milliseconds);
        }
    }
    appraise_close(appraise);
}

/* The exact picture does not follow the setting that was chosen for the drawn one: the error found
 * is then that which was allowed, neither next to none nor that of the usual setting. */
static void an_error_that_was_allowed_is_kept(void **state)
{
    (void)state;
    bool all = true, differ = false;
    for (int way = 0; way < WAY_COUNT; way++) {
        for (int i = 0; i < EXAMPLE_COUNT && WAYS[way].options.cheap; i++) {
            ReferenceError error;
            Message message = {0};
            require(appraise_compute(&cases[way][i].picture, 1, NULL, &error, &message), &message);
            print_message("%-34s inside %.2f, usually %.2f\n", cases[way][i].name,
                          error.interior.maximum, cases[0][i].expected.interior.maximum);
            all &= error.interior.pixels > 0 && error.interior.maximum <= ERROR;
            differ |= error.interior.maximum > 1;
        }
    }
    assert_true(all);
    assert_true(differ);
}

/* Marks over the scene would be far from the exact picture, of which there are none. With light at
 * every fragment, rounding alone is left. */
static void marks_are_not_drawn(void **state)
{
    (void)state;
    int found = 0;
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        if (EXAMPLES[i] != &TwoSidedLighting && EXAMPLES[i] != &SmoothFlat)
            continue;
        /* A half from bytes, and less than a hundredth from floats: these have no highlights. */
        assert_true(cases[0][i].expected.interior.maximum < 0.51);
        found++;
    }
    assert_int_equal(found, 2);
}

static void every_pixel_of_every_view_counts_once(void **state)
{
    (void)state;
    for (int way = 0; way < WAY_COUNT; way++) {
        for (int i = 0; i < EXAMPLE_COUNT; i++) {
            const Options *options = &WAYS[way].options;
            const long long pixels = cases[way][i].expected.all.pixels;
            if (!is_drawn(way, i))
                continue;
            /* PhongBlinn's third view is the difference of the others, and no scene. */
            if (EXAMPLES[i] != &PhongBlinn)
                assert_int_equal(pixels, options->width * options->height);
            else
                assert_in_range(pixels, 0, 2 * (options->width * options->height + 2) / 3);
        }
    }
}

/* A teapot, which takes long, in a scene of its own. */
typedef struct Pot {
    Mesh mesh;
    Light light;
    Object object;
    Scene scene;
} Pot;

static void pot_open(Pot *pot, SolidKind kind)
{
    Message message = {0};
    require(mesh_teapot(&pot->mesh, 1, 10, &message), &message);
    pot->light = (Light){.direction = {1, 1, 1}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
    pot->object = (Object){.mesh = &pot->mesh,
                           .solid = {.kind = kind, .radius = 1},
                           .world_from_object = mat4_identity(),
                           .front = {.diffuse = {0.6, 0.5, 0.4}, .alpha = 1, .shininess = 20}};
    pot->scene = (Scene){.camera = {{0, 2, 5}, {0, 0, 0}, {0, 1, 0}, 40, 1, 20},
                         .lights = &pot->light,
                         .light_count = 1,
                         .objects = &pot->object,
                         .object_count = 1};
}

static AppraisePicture picture_of(const Scene *scene, int width, int height, double seconds)
{
    const int place[4] = {0, 0, width, height};
    AppraisePicture picture;
    Message message = {0};
    require(appraise_picture_open(&picture, width, height, IMAGE_BYTE, 1, &message), &message);
    memset(picture.image.pixels, 100, image_row_size(&picture.image) * (size_t)height);
    picture.seconds = seconds;
    require(appraise_picture_add(&picture, place, scene, NULL, &message), &message);
    return picture;
}

/* Everything the scene points to is overwritten and freed as soon as the picture is given away. */
static void a_scene_may_go_at_once(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        Pot pot;
        Message message = {0};
        Appraise *appraise;
        ReferenceError expected;
        pot_open(&pot, i ? SOLID_TEAPOT : SOLID_NONE);
        AppraisePicture picture = picture_of(&pot.scene, 120, 90, 0);
        require(appraise_compute(&picture, 2, NULL, &expected, &message), &message);
        require(appraise_open(&appraise, &message), &message);
        appraise_start(appraise, &picture);
        memset(pot.mesh.vertices, 0xFF, pot.mesh.vertex_count * sizeof *pot.mesh.vertices);
        memset(pot.mesh.indices, 0xFF, pot.mesh.index_count * sizeof *pot.mesh.indices);
        mesh_close(&pot.mesh);
        memset(&pot, 0xFF, sizeof pot);
        const AppraiseResult result = wait_for(appraise);
        require(result.known, &result.message);
        assert_same_sum("all", &result.error.all, &expected.all);
        assert_same_sum("inside", &result.error.interior, &expected.interior);
        assert_true(result.error.interior.pixels > 1000);
        appraise_close(appraise);
    }
}

/* While it makes the mesh, its hierarchy, and the picture. */
static void what_is_abandoned_ends_soon(void **state)
{
    static const double after[] = {0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8};
    (void)state;
    Pot pot;
    Message message = {0};
    double longest = 0;
    pot_open(&pot, SOLID_TEAPOT);
    for (size_t i = 0; i < sizeof after / sizeof after[0]; i++) {
        Appraise *appraise;
        AppraiseResult result;
        AppraisePicture picture = picture_of(&pot.scene, 1600, 1200, 1);
        require(appraise_open(&appraise, &message), &message);
        appraise_start(appraise, &picture);
        pause_for(after[i]);
        const double start = progress_now();
        appraise_cancel(appraise);
        const double cancelled = progress_now();
        assert_false(appraise_busy(appraise));
        appraise_result(appraise, &result);
        assert_false(result.known || result.computing || result.message.text[0]);
        appraise_close(appraise);
        const double closed = progress_now();
        print_message("after %3.0f ms: cancelled in %.2f ms, closed in %.1f ms\n", 1e3 * after[i],
                      1e3 * (cancelled - start), 1e3 * (closed - start));
        longest = fmax(longest, closed - start);
    }
    print_message("closed in %.1f ms at most\n", 1e3 * longest);
    mesh_close(&pot.mesh);
}

static void the_newest_picture_counts(void **state)
{
    (void)state;
    Pot pot;
    Message message = {0};
    Appraise *appraise;
    AppraiseResult result;
    pot_open(&pot, SOLID_NONE);
    require(appraise_open(&appraise, &message), &message);
    appraise_result(appraise, &result);
    assert_false(result.known || result.computing);
    for (int i = 0; i < 20; i++) {
        AppraisePicture picture = picture_of(&pot.scene, i < 19 ? 400 : 40, 30, i);
        appraise_start(appraise, &picture);
        assert_true(appraise_busy(appraise) || i == 19);
        pause_for(1e-3 * (i % 4));
    }
    result = wait_for(appraise);
    require(result.known, &result.message);
    assert_true(result.seconds == 19);
    assert_int_equal(result.error.all.pixels, 40 * 30);
    /* What was known stays so while the next one is computed, and goes with what is cancelled. */
    AppraisePicture next = picture_of(&pot.scene, 1000, 1000, 20);
    appraise_start(appraise, &next);
    appraise_result(appraise, &result);
    assert_true(result.known && result.computing && result.seconds == 19);
    appraise_cancel(appraise);
    appraise_result(appraise, &result);
    assert_false(result.known || result.computing);
    next = picture_of(&pot.scene, 10, 10, 21);
    appraise_start(appraise, &next);
    assert_true(wait_for(appraise).known);
    appraise_close(appraise);
    mesh_close(&pot.mesh);
}

static void what_cannot_be_computed_has_a_message(void **state)
{
    (void)state;
    Pot pot;
    Message message = {0};
    Appraise *appraise;
    pot_open(&pot, SOLID_NONE);
    pot.scene.camera.center = pot.scene.camera.eye;
    require(appraise_open(&appraise, &message), &message);
    AppraisePicture picture = picture_of(&pot.scene, 10, 10, 0);
    appraise_start(appraise, &picture);
    AppraiseResult result = wait_for(appraise);
    assert_false(result.known);
    assert_non_null(strstr(result.message.text, "camera: eye (0, 2, 5), center (0, 2, 5)"));
    pot.scene.camera.center = (Vec3){0, 0, 0};
    picture = picture_of(&pot.scene, 10, 10, 0);
    appraise_start(appraise, &picture);
    result = wait_for(appraise);
    assert_true(result.known);
    assert_string_equal(result.message.text, "");
    appraise_close(appraise);
    mesh_close(&pot.mesh);
}

static void nothing_to_compare_is_no_error(void **state)
{
    (void)state;
    Message message = {0};
    Appraise *appraise;
    AppraisePicture picture = {.views = NULL}, empty;
    appraise_picture_close(NULL);
    appraise_picture_close(&picture);
    appraise_close(NULL);
    require(appraise_picture_open(&empty, 3, 2, IMAGE_FLOAT, 0, &message), &message);
    require(appraise_open(&appraise, &message), &message);
    appraise_start(appraise, &empty);
    const AppraiseResult result = wait_for(appraise);
    assert_true(result.known);
    assert_int_equal(result.error.all.pixels, 0);
    assert_true(isnan(error_sum_rms(&result.error.all)));
    appraise_close(appraise);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_background_finds_what_is_found_here),
        cmocka_unit_test(an_error_that_was_allowed_is_kept),
        cmocka_unit_test(marks_are_not_drawn),
        cmocka_unit_test(every_pixel_of_every_view_counts_once),
        cmocka_unit_test(a_scene_may_go_at_once),
        cmocka_unit_test(what_is_abandoned_ends_soon),
        cmocka_unit_test(the_newest_picture_counts),
        cmocka_unit_test(what_cannot_be_computed_has_a_message),
        cmocka_unit_test(nothing_to_compare_is_no_error),
    };
    if (!picture_check_driver("appraise_test"))
        return EXIT_SKIPPED;
    return cmocka_run_group_tests(tests, draw_all, forget_all);
}
