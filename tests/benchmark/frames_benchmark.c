/*
 * Pictures per second, 200 frames of PointLightedCube_perFragment at 400x400, to PNG files from one
 * process: drawing and encoding in parallel, compared with drawing and reading back alone, and with
 * libpng's defaults in sequence.
 */
#include "app/options_canvas.h"
#include "app/options.h"
#include "app/picture_texts.h"
#include "app/renderer.h"
#include "benchmark/measure.h"

#include <ftw.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern const Example PointLightedCube_perFragment;

enum { FRAMES = 200, ROUNDS = 7 };

static const Example *const EXAMPLE_DRAWN = &PointLightedCube_perFragment;

static Canvas canvas;
static Renderer renderer;
static Options options = {
    .width = 400, .height = 400, .frames = FRAMES, .fps = 30, .compress = IMAGE_COMPRESS_DEFAULT};
static DrawRequest request;
static char folder[] = "/tmp/lighting-benchmark-XXXXXX";

static double moment(int frame)
{
    return frame / options.fps;
}

/* Drawing and reading back only: the upper bound. */
static bool draw_only(void *argument)
{
    (void)argument;
    Message message = {0};
    Picture picture = {.path = ""};
    bool done = image_open(&picture.image, canvas.width, canvas.height, IMAGE_BYTE, &message);
    for (int i = 0; i < FRAMES && done; i++)
        done = renderer_picture(&renderer, &request, moment(i), &picture.image, &message);
    image_close(&picture.image);
    return done;
}

/* As --frames does it. */
static bool draw_and_write(void *argument)
{
    (void)argument;
    Message message = {0};
    PictureQueue *queue;
    const PictureQueueOptions pictures = {canvas.width, canvas.height, IMAGE_BYTE, .count = FRAMES};
    bool done = picture_queue_open(&queue, &pictures, &message);
    for (int i = 0; i < FRAMES && done; i++) {
        Picture *picture = picture_queue_take(queue);
        snprintf(picture->path, sizeof picture->path, "%s/frame%03d.png", folder, i);
        done = renderer_picture(&renderer, &request, moment(i), &picture->image, &message);
        picture_texts_set(EXAMPLE_DRAWN, &canvas, &options, moment(i), picture);
        done = done && picture_queue_give(queue, picture, &message);
    }
    done = picture_queue_close(queue, &message) && done;
    if (!done)
        fprintf(stderr, "%s\n", message.text);
    return done;
}

static bool write_default_png(const char *path, const Image *image)
{
    FILE *file = fopen(path, "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!file || !info || setjmp(png_jmpbuf(png)))
        abort();
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, (png_const_bytep)image->pixels + (size_t)y * image_row_size(image));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return fclose(file) == 0;
}

static bool draw_then_write_default(void *argument)
{
    (void)argument;
    Message message = {0};
    Picture picture = {.path = ""};
    char path[PATH_MAX];
    bool done = image_open(&picture.image, canvas.width, canvas.height, IMAGE_BYTE, &message);
    for (int i = 0; i < FRAMES && done; i++) {
        snprintf(path, sizeof path, "%s/frame%03d.png", folder, i);
        done = renderer_picture(&renderer, &request, moment(i), &picture.image, &message) &&
               write_default_png(path, &picture.image);
    }
    image_close(&picture.image);
    return done;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status, (void)type, (void)walk;
    return remove(path);
}

int main(int argc, char *argv[])
{
    measure_begin(&argc, argv);
    Message message = {0};
    setenv("LP_NUM_THREADS", "0", 0); /* as --frames does */
    if (!mkdtemp(folder)) {
        perror(folder);
        return 1;
    }
    request = options_request(&options, EXAMPLE_DRAWN);
    if (!options_open_canvas(&canvas, &options, "x.png", &message) ||
        !renderer_open(&renderer, EXAMPLE_DRAWN, &canvas, &request, &message)) {
        canvas_close(&canvas);
        rmdir(folder);
        return options_fail("frames_benchmark", &message, 77);
    }
    enum { DRAW, WRITE, DEFAULT, COUNT };
    Measured measured[COUNT] = {
        [DRAW] = {"drawing and reading back alone", draw_only, NULL, NULL},
        [WRITE] = {"and writing PNG files, in parallel", draw_and_write, NULL, NULL},
        [DEFAULT] = {"and writing with libpng's defaults, in sequence", draw_then_write_default,
                     NULL, NULL},
    };
    const bool done = measure_rounds(measured, COUNT, ROUNDS);
    if (done) {
        Table table;
        measure_print_machine(canvas.renderer, canvas.version);
        table_open(&table, "200 frames, 400x400, one process|pictures per second");
        for (int i = 0; i < COUNT; i++) {
            const Summary time = measure_summary(measured[i].seconds, ROUNDS);
            table_row(&table, "%s|%.0f [%.0f, %.0f]", measured[i].name, FRAMES / time.median,
                      FRAMES / time.upper, FRAMES / time.lower);
        }
        const Summary alone = measure_ratio(&measured[DRAW], &measured[WRITE], 1, ROUNDS);
        const Summary plain = measure_ratio(&measured[DEFAULT], &measured[WRITE], 1, ROUNDS);
        table_row(&table, "in parallel over drawing alone|%s", measure_cell(alone, 1, 2).text);
        table_row(&table, "in parallel over libpng's default|%s", measure_cell(plain, 1, 1).text);
        measure_print_table(NULL, &table);
    }
    measure_finish(measured, COUNT);
    renderer_close(&renderer);
    canvas_close(&canvas);
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    return done ? 0 : 1;
}
