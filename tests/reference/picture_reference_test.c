/*
 * What the driver draws against common/reference: every view of the programs that are scenes. The
 * reference has the meshes as given, so that what is compared is light and its interpolation. The
 * lecture's programs: programs/picture_lecture_test.c.
 *
 * Inside objects, where no edge runs through the pixel, a highp picture may be one step of 1/255
 * off: rounding to 8 bits alone makes 0.5, and arithmetic in 32 bits with a shininess up to 128
 * less than the other half.
 */
#include "lighting/lighting.h"
#include "reference/picture_error.h"
#include "scene/scene_example.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

static const double MAX = 1; /* step of 1/255 */

/* Comparing. */

/* Whether no pixel inside an object is farther than `most` steps from the exact picture, and there
 * are such pixels at all, with more than one color. Where not, says so and keeps the pictures. */
static bool check(const char *name, const Image *image, const Reference *exact, const Scene *scene,
                  double max)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    PictureError error = {.all = {0}};
    picture_error_add(&error, image, &(ExactView){.exact = exact, .scene = scene});
    const ErrorSum *inside = &error.interior;
    print_message("%-40s %6lld pixels inside, largest error %.3f\n", name, inside->pixels,
                  inside->maximum);
    if (inside->pixels > (long long)count / 100 && inside->maximum <= max)
        return true;
    printf("%s: %lld pixels inside; at column %zu, row %zu the error is %.3f\n", name,
           inside->pixels, inside->worst % (size_t)image->width,
           inside->worst / (size_t)image->width, inside->maximum);
    picture_check_keep_exact(name, image, exact);
    return false;
}

static void open_exact(Reference *exact, const Scene *scene, int width, int height, bool meshes)
{
    const ReferenceOptions options = {.width = width, .height = height, .meshes = meshes};
    SUCCEEDS(scene_check(scene, message));
    SUCCEEDS(reference_open(exact, scene, &options, message));
}

/* The programs that are scenes. */

/* Draws a scene alone, without the marks that its program draws over it. */
static void render(const Canvas *canvas, Lighting *lighting, const Scene *scene, Image *image)
{
    canvas_clear(canvas, scene->background, 1);
    SUCCEEDS(lighting_show(
        lighting,
        &(LightingFrame){.scene = scene, .aspect = (double)canvas->width / canvas->height},
        message));
    SUCCEEDS(canvas_read(canvas, image, message));
}

TEST(scenes_are_drawn_as_the_reference_has_them)
{
    static const double times[] = {0, 2.3};
    const ShaderLoader loader = {.precision = "highp"};
    const CanvasOptions options = {.width = 240, .height = 200};
    bool all = true;
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        const Example *example = EXAMPLES[i];
        Canvas canvas;
        Image image;
        Lighting *lighting;
        int columns = 1, rows = 1;
        SUCCEEDS(canvas_open(&canvas, &options, message));
        SUCCEEDS(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, message));
        SUCCEEDS(example->init(&loader, message));
        SUCCEEDS(lighting_open(&lighting, &loader, message));
        if (example_scene(example)->layout)
            example_scene(example)->layout(&columns, &rows);
        for (int view = 0; view < columns * rows; view++) {
            /* In the short form one of the moments. */
            const size_t every = (size_t)testing_step(2);
            for (size_t t = (size_t)(i + view) % every; t < sizeof times / sizeof times[0];
                 t += every) {
                char name[96];
                Scene scene = {.object_count = 0};
                Reference exact;
                example_scene(example)->make(times[t], view, &scene);
                if (scene.object_count == 0)
                    continue; /* PhongBlinn's third view is their difference */
                render(&canvas, lighting, &scene, &image);
                open_exact(&exact, &scene, canvas.width, canvas.height, true);
                snprintf(name, sizeof name, "%s-%d-%zu", example->name, view, t);
                all &= check(name, &image, &exact, &scene, MAX);
                reference_close(&exact);
            }
        }
        lighting_close(lighting);
        example->finish();
        image_close(&image);
        canvas_close(&canvas);
    }
    assert_true(all);
}

PICTURE_TEST_MAIN("picture reference", NULL, NULL)
