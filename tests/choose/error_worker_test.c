/*
 * The error computed in the background is compared with the same error computed here, for every
 * example and each option that changes the exact picture. Everything is drawn, and the canvas
 * closed, before the first thread starts, so that a thread checker sees only this project's
 * threads.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "kinds/scene_views.h"
#include "base/clock.h"
#include "choose/error_worker.h"
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <time.h>

enum { WIDTH = 200, HEIGHT = 150 };

static const double SECONDS = 1.3;

#define SIZE .width = WIDTH, .height = HEIGHT

/* Options that change the exact picture, or should not. */
static const struct {
    const char *name, *output;
    Options options;
    bool teapots; /* draw also those examples whose exact pictures take long */
} WAYS[] = {
    {"", "x.png", {SIZE}, true},
    {"--linear", "x.png", {SIZE, .linear = true}, false},
    {"--clamp vertex", "x.png", {SIZE, .clamp_vertex = true}, false},
    {"--show-clipped", "x.png", {SIZE, .show_clipped = true}, false},
    {"--clamp-dots off", "x.png", {SIZE, .signed_dots = true}, false},
    {"--orbit 30,10,0.8", "x.png", {SIZE, .orbit = {30, 10, 0.8, 0}}, false},
    {"--alpha", "x.png", {SIZE, .alpha = true}, false},
    {"--samples 4", "x.png", {SIZE, .canvas = {.samples = 4}}, false},
    {"floats", "x.exr", {SIZE}, false},
    {"--error 4", "x.png", {SIZE, .cheap = true, .error = 4}, true},
    {"-s 1x1", "x.png", {.width = 1, .height = 1}, true},
    /* Less than a pixel for some of several views. */
    {"-s 2x1", "x.png", {.width = 2, .height = 1}, true},
};

enum { WAY_COUNT = sizeof WAYS / sizeof WAYS[0] };

/* A drawn picture, and its known error. */
typedef struct Case {
    char name[64];
    ErrorPicture picture;
    PictureError expected;
} Case;

static Case cases[WAY_COUNT][EXAMPLE_COUNT];

static bool is_drawn(int way, int example)
{
    const bool teapot = EXAMPLES[example] == &Materials || EXAMPLES[example] == &FourLights ||
                        EXAMPLES[example] == &TermsApart || EXAMPLES[example] == &Shadows;
    const int step = testing_step(9) > 1 ? 18 : 1;    /* has those that the last test compares */
    if (step > 1 && EXAMPLES[example] == &TermsApart) /* the teapot ten times: half of the time */
        return false;
    if (step > 1 && way > 0 && (teapot || (way + example) % step))
        return false;
    if (teapot && testing_step(9) > 4) /* in the short form none */
        return false;
    return WAYS[way].teapots || !teapot;
}

/* Of all views, pixel by pixel. */
static PictureError expect(const ErrorPicture *picture)
{
    PictureError error = {.all = {0}};
    for (int i = 0; i < picture->view_count; i++) {
        const ErrorView *view = &picture->views[i];
        const Scene *scene = &view->scene.scene;
        Reference exact, meshes = {.lights = NULL};
        ReferenceOptions size = {.width = view->place[2], .height = view->place[3]};
        SUCCEEDS(reference_open(&exact, scene, &size, message));
        size.meshes = true;
        if (exact.lights) {
            Scene drawn = view->drawn.objects ? view->drawn.scene : *scene;
            drawn.interpolation = INTERPOLATION_PHONG;
            SUCCEEDS(reference_open(&meshes, &drawn, &size, message));
        }
        picture_error_add(&error, &picture->image,
                          &(ExactView){.exact = &exact,
                                       .scene = scene,
                                       .drawn = exact.lights ? &meshes : NULL,
                                       .left = view->place[0],
                                       .top = view->place[1]});
        reference_close(&exact);
        reference_close(&meshes);
    }
    return error;
}

FIXTURE(draw_all)
{
    for (int way = 0; way < WAY_COUNT; way++)
        for (int i = 0; i < EXAMPLE_COUNT; i++) {
            Options options = WAYS[way].options;
            Canvas canvas;
            Renderer renderer;
            options.shaders.precision = "highp";
            options.shadows.way =
                example_scene(EXAMPLES[i])->shadows ? SHADOWS_VOLUMES : SHADOWS_OFF;
            if (!is_drawn(way, i))
                continue;
            SUCCEEDS(options_open_canvas(&canvas, &options, WAYS[way].output, message));
            const DrawRequest request = options_request(&options, EXAMPLES[i]);
            SUCCEEDS(renderer_open(&renderer, EXAMPLES[i], &canvas, &request, message));
            Case *made = &cases[way][i];
            snprintf(made->name, sizeof made->name, "%s %s", EXAMPLES[i]->name, WAYS[way].name);
            SUCCEEDS(scene_error_picture(&renderer, &request, SECONDS, &made->picture, message));
            made->expected = expect(&made->picture);
            renderer_close(&renderer);
            canvas_close(&canvas);
        }
}

FIXTURE(forget_all)
{
    for (int way = 0; way < WAY_COUNT; way++)
        for (int i = 0; i < EXAMPLE_COUNT; i++)
            error_picture_close(&cases[way][i].picture);
}

static void pause_for(double seconds)
{
    const struct timespec time = {(time_t)seconds, (long)(1e9 * fmod(seconds, 1))};
    nanosleep(&time, NULL);
}

static ErrorResult wait_for(ErrorWorker *worker)
{
    ErrorResult result;
    while (error_worker_busy(worker))
        pause_for(1e-3);
    error_worker_result(worker, &result);
    return result;
}

static void assert_same_sum(const char *name, const ErrorSum *a, const ErrorSum *b)
{
    if (a->pixels != b->pixels || a->wrong != b->wrong || a->squares != b->squares ||
        a->maximum != b->maximum || a->worst != b->worst)
        fail_msg("%s: %lld pixels, %lld wrong, largest %.17g; not %lld, %lld, %.17g", name,
                 a->pixels, a->wrong, a->maximum, b->pixels, b->wrong, b->maximum);
}

/* A copy of a picture, because the worker takes ownership. */
static ErrorPicture copy_of(const ErrorPicture *picture)
{
    ErrorPicture copy;
    const Image *image = &picture->image;
    SUCCEEDS(error_picture_open(&copy, image->width, image->height, image->type,
                                picture->view_count, message));
    memcpy(copy.image.pixels, image->pixels, image_row_size(image) * (size_t)image->height);
    copy.seconds = picture->seconds;
    copy.simplified = picture->simplified;
    for (int i = 0; i < picture->view_count; i++) {
        const ErrorView *view = &picture->views[i];
        SUCCEEDS(error_picture_add(&copy, view->place, &view->scene.scene,
                                   view->drawn.objects ? &view->drawn.scene : NULL, message));
    }
    return copy;
}

static ErrorWorker *open_worker(void)
{
    ErrorWorker *worker;
    SUCCEEDS(error_worker_open(&worker, message));
    return worker;
}

/* What the mesh adds is not computing: against the mesh's exact picture only rounding is left. With
 * samples, lighting within a pixel differs from that at its center. */
static void assert_said_apart(const Case *of, const Options *options, const ErrorResult *result)
{
    const PictureError *error = &result->error;
    const bool bytes = of->picture.image.type == IMAGE_BYTE;
    if (options->cheap)
        assert_int_equal(result->of_computing.pixels, 0);
    else if (!options->canvas.samples && !(result->of_computing.maximum <= (bytes ? 0.51 : 0.1)))
        fail_msg("%s: error of computing %.3f", of->name, result->of_computing.maximum);
    assert_true(error->interior.pixels + error->edges.pixels <= error->all.pixels);
    assert_true(fmax(error->interior.maximum, error->edges.maximum) <= error->all.maximum);
}

TEST(the_worker_finds_the_error_that_is_computed_here)
{
    ErrorWorker *worker = open_worker();
    for (int way = 0; way < WAY_COUNT; way++)
        for (int i = 0; i < EXAMPLE_COUNT; i++) {
            const Case *of = &cases[way][i];
            if (!is_drawn(way, i))
                continue;
            ErrorPicture picture = copy_of(&of->picture);
            error_worker_start(worker, &picture);
            assert_null(picture.views);
            assert_null(picture.image.pixels);
            const ErrorResult result = wait_for(worker);
            require(result.known, &result.message);
            assert_false(result.computing);
            assert_true(result.seconds == SECONDS);
            assert_same_sum(of->name, &result.error.all, &of->expected.all);
            assert_same_sum(of->name, &result.error.interior, &of->expected.interior);
            assert_same_sum(of->name, &result.error.edges, &of->expected.edges);
            assert_said_apart(of, &WAYS[way].options, &result);
            if (WAYS[way].options.width == WIDTH)
                print_message("%-34s inside rms %6.3f, largest %7.2f; all rms %6.3f, largest "
                              "%7.2f; %4.0f ms\n",
                              of->name, error_sum_rms(&result.error.interior),
                              result.error.interior.maximum, error_sum_rms(&result.error.all),
                              result.error.all.maximum, result.milliseconds);
        }
    error_worker_close(worker);
}

TEST(every_pixel_of_every_view_counts_once)
{
    for (int way = 0; way < WAY_COUNT; way++)
        for (int i = 0; i < EXAMPLE_COUNT; i++) {
            const Options *options = &WAYS[way].options;
            const long long pixels = cases[way][i].expected.all.pixels;
            if (!is_drawn(way, i))
                continue;
            int columns, rows;
            const int count = scene_view_grid(example_scene(EXAMPLES[i]), &columns, &rows);
            /* PhongBlinn's third view is the difference of the others, not a scene. */
            const int views = EXAMPLES[i] == &PhongBlinn ? 2 : count;
            assert_int_equal(pixels, views * (options->width / columns) * (options->height / rows));
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
    SUCCEEDS(mesh_teapot(&pot->mesh, 1, 10, message));
    pot->light = (Light){.direction = {1, 1, 1}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
    pot->object = (Object){.mesh = &pot->mesh,
                           .solid = {.kind = kind, .radius = 1},
                           .world_from_object = mat4_identity(),
                           .front = {.diffuse = {0.6, 0.5, 0.4}, .alpha = 1, .shininess = 20}};
    pot->scene = (Scene){.camera = {{0, 2, 5}, {0, 0, 0}, {0, 1, 0}, 40, 1, 20, 0},
                         .lights = &pot->light,
                         .light_count = 1,
                         .objects = &pot->object,
                         .object_count = 1};
}

static ErrorPicture picture_of(const Scene *scene, int width, int height, double seconds)
{
    const int place[4] = {0, 0, width, height};
    ErrorPicture picture;
    SUCCEEDS(error_picture_open(&picture, width, height, IMAGE_BYTE, 1, message));
    memset(picture.image.pixels, 255, image_row_size(&picture.image) * (size_t)height);
    picture.seconds = seconds;
    SUCCEEDS(error_picture_add(&picture, place, scene, NULL, message));
    return picture;
}

/* Everything the scene points to is overwritten and freed as soon as the picture has been handed
 * over. */
TEST(the_scene_may_be_freed_at_once)
{
    for (int i = 0; i < 2; i++) {
        Pot pot;
        pot_open(&pot, i ? SOLID_TEAPOT : SOLID_NONE);
        ErrorPicture picture = picture_of(&pot.scene, 120, 90, 0), same = copy_of(&picture);
        ErrorWorker *worker = open_worker();
        error_worker_start(worker, &same);
        const PictureError expected = wait_for(worker).error;
        error_worker_start(worker, &picture);
        memset(pot.mesh.vertices, 0xFF, pot.mesh.vertex_count * sizeof *pot.mesh.vertices);
        memset(pot.mesh.indices, 0xFF, pot.mesh.index_count * sizeof *pot.mesh.indices);
        mesh_close(&pot.mesh);
        memset(&pot, 0xFF, sizeof pot);
        const ErrorResult result = wait_for(worker);
        require(result.known, &result.message);
        assert_same_sum("all", &result.error.all, &expected.all);
        assert_same_sum("inside", &result.error.interior, &expected.interior);
        assert_true(result.error.interior.pixels > 1000);
        error_worker_close(worker);
    }
}

/* Cancelled while it makes the mesh, its hierarchy, and the picture. */
TEST(a_cancelled_computation_ends_soon)
{
    static const double after[] = {0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8};
    Pot pot;
    double longest = 0;
    pot_open(&pot, SOLID_TEAPOT);
    for (size_t i = 0; i < sizeof after / sizeof after[0]; i++) {
        ErrorWorker *worker = open_worker();
        ErrorResult result;
        ErrorPicture picture = picture_of(&pot.scene, 1600, 1200, 1);
        error_worker_start(worker, &picture);
        pause_for(after[i]);
        const double start = clock_now();
        error_worker_cancel(worker);
        const double cancelled = clock_now();
        assert_false(error_worker_busy(worker));
        error_worker_result(worker, &result);
        assert_false(result.known || result.computing || result.message.text[0]);
        error_worker_close(worker);
        const double closed = clock_now();
        print_message("after %3.0f ms: cancelled in %.2f ms, closed in %.1f ms\n", 1e3 * after[i],
                      1e3 * (cancelled - start), 1e3 * (closed - start));
        longest = fmax(longest, closed - start);
    }
    print_message("closed in %.1f ms at most\n", 1e3 * longest);
    mesh_close(&pot.mesh);
}

TEST(the_newest_picture_counts)
{
    Pot pot;
    ErrorWorker *worker = open_worker();
    ErrorResult result;
    pot_open(&pot, SOLID_NONE);
    error_worker_result(worker, &result);
    assert_false(result.known || result.computing);
    for (int i = 0; i < 20; i++) {
        ErrorPicture picture = picture_of(&pot.scene, i < 19 ? 400 : 40, 30, i);
        error_worker_start(worker, &picture);
        assert_true(error_worker_busy(worker) || i == 19);
        pause_for(1e-3 * (i % 4));
    }
    result = wait_for(worker);
    require(result.known, &result.message);
    assert_true(result.seconds == 19);
    assert_int_equal(result.error.all.pixels, 40 * 30);
    /* A known error is kept while the next one is computed, and discarded with a cancelled one. */
    ErrorPicture next = picture_of(&pot.scene, 1000, 1000, 20);
    error_worker_start(worker, &next);
    error_worker_result(worker, &result);
    assert_true(result.known && result.computing && result.seconds == 19);
    error_worker_cancel(worker);
    error_worker_result(worker, &result);
    assert_false(result.known || result.computing);
    next = picture_of(&pot.scene, 10, 10, 21);
    error_worker_start(worker, &next);
    assert_true(wait_for(worker).known);
    error_worker_close(worker);
    mesh_close(&pot.mesh);
}

TEST(a_failed_computation_has_a_message)
{
    Pot pot;
    ErrorWorker *worker = open_worker();
    pot_open(&pot, SOLID_NONE);
    pot.scene.camera.center = pot.scene.camera.eye;
    ErrorPicture picture = picture_of(&pot.scene, 10, 10, 0);
    error_worker_start(worker, &picture);
    ErrorResult result = wait_for(worker);
    assert_false(result.known);
    assert_non_null(strstr(result.message.text, "camera: eye (0, 2, 5), center (0, 2, 5)"));
    pot.scene.camera.center = (Vec3){0, 0, 0};
    picture = picture_of(&pot.scene, 10, 10, 0);
    error_worker_start(worker, &picture);
    result = wait_for(worker);
    assert_true(result.known);
    assert_string_equal(result.message.text, "");
    error_worker_close(worker);
    mesh_close(&pot.mesh);
}

TEST(nothing_to_compare_is_no_error)
{
    ErrorPicture picture = {.views = NULL}, empty;
    error_picture_close(NULL);
    error_picture_close(&picture);
    error_worker_close(NULL);
    SUCCEEDS(error_picture_open(&empty, 3, 2, IMAGE_FLOAT, 0, message));
    ErrorWorker *worker = open_worker();
    error_worker_start(worker, &empty);
    const ErrorResult result = wait_for(worker);
    assert_true(result.known);
    assert_int_equal(result.error.all.pixels, 0);
    assert_true(isnan(error_sum_rms(&result.error.all)));
    error_worker_close(worker);
}

PICTURE_TEST_MAIN("error worker", draw_all, forget_all)
