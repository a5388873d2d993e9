/*
 * What the driver draws against common/reference: every view of the programs that are scenes, in
 * either precision. The reference has the meshes as given, so that what is compared is light and
 * its interpolation. The lecture's programs: programs/picture_lecture_test.c.
 *
 * Inside objects, where no edge runs through the pixel, no picture may have a larger error than
 * measured arithmetic predicts for its scene; in highp also none of more than one step of 1/255:
 * rounding to 8 bits alone makes 0.5, and arithmetic in 32 bits with a shininess up to 128 less
 * than the other half.
 */
#include "kinds/scene_views.h"
#include "lighting/lighting.h"
#include "reference/picture_error.h"
#include "scene/scene_example.h"
#include "study/arithmetic/arithmetic.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

static Canvas canvas;
static Lighting *lightings[2]; /* in highp, in mediump */
static Image image;
static Arithmetics found;

FIXTURE(open_all)
{
    const int part = testing_step(3) == 1 ? 1 : 3; /* larger in the long form */
    const CanvasOptions options = {.width = 240 / part, .height = 200 / part};
    Meter meter;
    SUCCEEDS(meter_open(&meter, NULL, message));
    SUCCEEDS(arithmetic_measure(&meter, 1, &found, message));
    meter_close(&meter);
    SUCCEEDS(canvas_open(&canvas, &options, message));
    SUCCEEDS(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, message));
    for (int i = 0; i < 2; i++) {
        const ShaderLoader loader = {.precision = i ? "mediump" : "highp"};
        SUCCEEDS(lighting_open(&lightings[i], &loader, message));
    }
}

FIXTURE(close_all)
{
    for (int i = 0; i < 2; i++)
        lighting_close(lightings[i]);
    image_close(&image);
    canvas_close(&canvas);
}

/* Whether the error is as small as it must be, and there are pixels inside at all. Where not, keeps
 * the pictures. Without `predict` in highp alone. */
static bool check(const char *name, const Scene *scene, bool predict)
{
    const ReferenceOptions options = {
        .width = canvas.width, .height = canvas.height, .meshes = true, .centers = true};
    CLOSED(reference_close) Reference exact;
    bool right = true;
    SUCCEEDS(reference_open(&exact, scene, &options, message));
    for (int i = 0; i < (predict ? 2 : 1); i++) {
        PictureError error = {.all = {0}};
        double most = i == 0 ? 1 : INFINITY;
        if (predict)
            most =
                fmin(most, predict_scene(scene, canvas.height, &found.of[METER_VERTEX][METER_HIGHP],
                                         &found.of[METER_FRAGMENT][i], &found.raster));
        picture_draw(&canvas, lightings[i], &(LightingFrame){.scene = scene}, &image);
        picture_error_add(&error, &image, &(ExactView){.exact = &exact, .scene = scene});
        const ErrorSum *inside = &error.interior;
        print_message("%-24s %-8s %6lld pixels inside, largest error %.3f of %.3f\n", name,
                      METER_PRECISION_NAMES[i], inside->pixels, inside->maximum, most);
        if (inside->pixels > canvas.width * canvas.height / 100 && inside->maximum <= most)
            continue;
        printf("%s: at column %zu, row %zu\n", name, inside->worst % (size_t)image.width,
               inside->worst / (size_t)image.width);
        picture_check_keep_exact(name, &image, &exact);
        right = false;
    }
    return right;
}

/* In the short form each view at one of the moments, and few with what is predicted. */
TEST(scenes_are_drawn_as_the_reference_has_them)
{
    static const double times[] = {0, 2.3};
    const int every = testing_step(2), every_predicted = testing_step(36);
    int number = 0;
    bool all = true;
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        const Example *example = EXAMPLES[i];
        int columns, rows;
        SUCCEEDS(example->init(&(ShaderLoader){.only_texts = true}, message));
        const int views = scene_view_grid(example_scene(example), &columns, &rows);
        for (int view = 0; view < views; view++)
            for (int t = (i + view) % every; t < 2; t += every) {
                Scene scene = {.object_count = 0};
                example_scene(example)->make(times[t], view, &scene);
                if (scene.object_count == 0)
                    continue; /* PhongBlinn's third view is their difference */
                all &= check(formatted("%s-%d-%d", example->name, view, t), &scene,
                             number++ % every_predicted == 0);
            }
        for (int k = 0; k < 2; k++)
            lighting_forget(lightings[k], NULL);
        example->finish();
    }
    assert_true(all);
}

PICTURE_TEST_MAIN("picture reference", open_all, close_all)
