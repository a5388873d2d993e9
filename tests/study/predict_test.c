/*
 * What measured arithmetic predicts, against pictures: the error of no view of any scene is above
 * its prediction, in highp and in mediump.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "lighting/lighting.h"
#include "reference/picture_error.h"
#include "scene/scene_example.h"
#include "study/arithmetic/arithmetic.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

/* Larger in the long form. */
static int width, height;

static Arithmetics found;

FIXTURE(measure)
{
    Meter meter;
    const int part = testing_step(3) == 1 ? 1 : 3;
    width = 240 / part;
    height = 180 / part;
    SUCCEEDS(meter_open(&meter, NULL, message));
    SUCCEEDS(arithmetic_measure(&meter, 1, &found, message));
    meter_close(&meter);
    return 0;
}

/* The largest error inside objects, in steps. */
static double error_in_picture(const Canvas *canvas, Lighting *lighting, const Scene *scene,
                               const Reference *exact, Image *image)
{
    PictureError error = {.all = {0}};
    canvas_clear(canvas, scene->background, 0);
    SUCCEEDS(lighting_show(
        lighting, &(LightingFrame){.scene = scene, .aspect = (double)width / height}, message));
    SUCCEEDS(canvas_read(canvas, image, message));
    picture_error_add(&error, image, &(ExactView){.exact = exact, .scene = scene});
    return error.interior.maximum;
}

static bool check(const Canvas *canvas, Lighting *lightings[2], const char *name,
                  const Scene *scene, Image *image)
{
    const ReferenceOptions options = {
        .width = width, .height = height, .meshes = true, .centers = true};
    Reference exact;
    bool right = true;
    SUCCEEDS(scene_check(scene, message));
    SUCCEEDS(reference_open(&exact, scene, &options, message));
    for (int i = 0; i < 2; i++) {
        const double predicted = predict_scene(scene, height, &found.of[METER_VERTEX][METER_HIGHP],
                                               &found.of[METER_FRAGMENT][i], &found.raster);
        const double error = error_in_picture(canvas, lightings[i], scene, &exact, image);
        print_message("%-24s %-8s predicted %7.3f, is %7.3f\n", name, METER_PRECISION_NAMES[i],
                      predicted, error);
        right &= error <= predicted;
    }
    reference_close(&exact);
    return right;
}

TEST(no_picture_has_a_larger_error_than_predicted)
{
    static const char *const precisions[] = {"highp", "mediump"};
    const CanvasOptions options = {.width = width, .height = height};
    Lighting *lightings[2];
    Canvas canvas;
    Image image;
    bool all = true;
    SUCCEEDS(canvas_open(&canvas, &options, message));
    SUCCEEDS(image_open(&image, width, height, IMAGE_BYTE, message));
    for (int i = 0; i < 2; i++) {
        const ShaderLoader loader = {.precision = precisions[i]};
        SUCCEEDS(lighting_open(&lightings[i], &loader, message));
    }
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        const Example *example = EXAMPLES[i];
        const ShaderLoader none = {.only_texts = true};
        int columns = 1, rows = 1;
        SUCCEEDS(example->init(&none, message));
        if (example_scene(example)->layout)
            example_scene(example)->layout(&columns, &rows);
        for (int view = 0; view < columns * rows; view += testing_step(24)) {
            char name[64];
            Scene scene = {.object_count = 0};
            example_scene(example)->make(0, view, &scene);
            snprintf(name, sizeof name, "%s %d", example->name, view);
            if (scene.object_count > 0)
                all &= check(&canvas, lightings, name, &scene, &image);
        }
        for (int k = 0; k < 2; k++)
            lighting_forget(lightings[k], NULL);
        example->finish();
    }
    for (int i = 0; i < 2; i++)
        lighting_close(lightings[i]);
    image_close(&image);
    canvas_close(&canvas);
    assert_true(all);
}

PICTURE_TEST_MAIN("predict", measure, NULL)
