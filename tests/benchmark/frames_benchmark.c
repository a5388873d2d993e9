/*
 * Pictures per second, 200 frames of PointLightedCube_perFragment at 400x400, to PNG files from one
 * process: drawing and encoding in parallel, compared with drawing and reading back alone, and with
 * libpng's defaults in sequence.
 */
#include "app/options.h"
#include "app/picture_texts.h"
#include "app/renderer.h"
#include "benchmark/bench.h"

#include <png.h>
#include <stdio.h>

extern const Example PointLightedCube_perFragment;

enum { FRAMES = 200, ROUNDS = 7 };

static const Example *const EXAMPLE_DRAWN = &PointLightedCube_perFragment;

static Renderer renderer;
static DrawRequest request;
static Options options = {
    .width = 400, .height = 400, .frames = FRAMES, .fps = 30, .compress = IMAGE_COMPRESS_DEFAULT};
static const char *folder;

static double moment(int frame)
{
    return frame / options.fps;
}

/* Drawing and reading back only: the upper bound. */
static bool draw_only(__attribute__((unused)) void *argument, Message *message)
{
    Picture picture = {.path = ""};
    bool done =
        image_open(&picture.image, bench_canvas.width, bench_canvas.height, IMAGE_BYTE, message);
    for (int i = 0; i < FRAMES && done; i++)
        done = renderer_picture(&renderer, &request, moment(i), &picture.image, message);
    image_close(&picture.image);
    return done;
}

/* As --frames does it. */
static bool draw_and_write(__attribute__((unused)) void *argument, Message *message)
{
    PictureQueue *queue;
    const PictureQueueOptions pictures = {bench_canvas.width, bench_canvas.height, IMAGE_BYTE,
                                          .count = FRAMES};
    bool done = picture_queue_open(&queue, &pictures, message);
    for (int i = 0; i < FRAMES && done; i++) {
        Picture *picture = picture_queue_take(queue);
        snprintf(picture->path, sizeof picture->path, "%s/frame%03d.png", folder, i);
        done = renderer_picture(&renderer, &request, moment(i), &picture->image, message);
        picture_texts_set(EXAMPLE_DRAWN, &bench_canvas, &options, moment(i), picture);
        done = done && picture_queue_give(queue, picture, message);
    }
    return picture_queue_close(queue, message) && done;
}

static bool write_default_png(const char *path, const Image *image)
{
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)image->width,
                     .height = (png_uint_32)image->height,
                     .format = PNG_FORMAT_RGBA};
    return png_image_write_to_file(&png, path, 0, image->pixels, 0, NULL) != 0;
}

static bool draw_then_write_default(__attribute__((unused)) void *argument, Message *message)
{
    Picture picture = {.path = ""};
    char path[PATH_MAX];
    bool done =
        image_open(&picture.image, bench_canvas.width, bench_canvas.height, IMAGE_BYTE, message);
    for (int i = 0; i < FRAMES && done; i++) {
        snprintf(path, sizeof path, "%s/frame%03d.png", folder, i);
        done = renderer_picture(&renderer, &request, moment(i), &picture.image, message) &&
               write_default_png(path, &picture.image);
    }
    image_close(&picture.image);
    return done;
}

static bool run(Message *message)
{
    enum { DRAW, WRITE, DEFAULT, COUNT };
    static const BenchColumn rate = {BENCH_RATE(0, FRAMES, 0)},
                             alone = {BENCH_RATIO(DRAW, WRITE, 2)},
                             plain = {BENCH_RATIO(DEFAULT, WRITE, 1)};
    BenchRun runs[COUNT] = {
        [DRAW] = {"drawing and reading back alone", draw_only, NULL, NULL, 0},
        [WRITE] = {"and writing PNG files, in parallel", draw_and_write, NULL, NULL, 0},
        [DEFAULT] = {"and writing with libpng's defaults, in sequence", draw_then_write_default,
                     NULL, NULL, 0},
    };
    Table table;
    request = options_request(&options, EXAMPLE_DRAWN);
    folder = bench_folder(message);
    if (!folder || !renderer_open(&renderer, EXAMPLE_DRAWN, &bench_canvas, &request, message))
        return false;
    table_open(&table, "200 frames, 400x400, one process|pictures per second");
    const bool done = bench_rows(&(BenchRows){runs, COUNT, 1, ROUNDS, &rate, 1}, &table, message);
    if (done) {
        bench_row(&table, runs, &alone, 1, "in parallel over drawing alone");
        bench_row(&table, runs, &plain, 1, "in parallel over libpng's default");
        bench_print(NULL, &table);
    }
    bench_finish(runs, COUNT);
    renderer_close(&renderer);
    return done;
}

const Bench BENCH = {
    .name = "frames_benchmark", .width = 400, .height = 400, .one_thread = true, .run = run};
