/*
 * gallery: every example's picture from one process and one context.
 *
 * Also writes a contact sheet, and index.html with each picture, its summary and its command. Other
 * threads encode a picture while the next is drawn.
 */
#include "app/command.h"
#include "app/doctor.h"
#include "app/stage.h"
#include "base/clock.h"
#include "base/output.h"
#include "base/parse.h"
#include "base/progress.h"
#include "images/label.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* From the build: X(LightedCube) X(LightedCube_animation)... */
#define X(name) extern const Example name;
EXAMPLES
#undef X

static const Example *const ALL[] = {
#define X(name) &name,
    EXAMPLES
#undef X
};
enum { COUNT = sizeof ALL / sizeof ALL[0] };

/* The contact sheet: thumbnails in rows, with labels below. In pixels. */
enum { COLUMNS = 5, THUMBNAIL = 200, MARGIN = 10, LABEL = 22, LABEL_SIZE = 12 };

/* The examples to draw, in the order of ALL. */
typedef struct Selection {
    const Example *examples[COUNT];
    int count;
} Selection;

static bool select_examples(Selection *selection, char *const *names, Message *message)
{
    bool chosen[COUNT] = {false};
    const char *known[COUNT + 1] = {NULL};
    for (int i = 0; i < COUNT; i++)
        known[i] = ALL[i]->name;
    for (char *const *name = names; *name; name++) {
        int found = -1;
        for (int i = 0; i < COUNT && found < 0; i++)
            if (strcmp(*name, known[i]) == 0)
                found = i;
        if (found < 0) {
            const char *nearest = parse_nearest(*name, known);
            return message_set(message, "%s: no such program; %s%s%s", *name,
                               nearest ? "did you mean " : "examples/run --list names them",
                               nearest ? nearest : "", nearest ? "?" : "");
        }
        chosen[found] = true;
    }
    for (int i = 0; i < COUNT; i++)
        if (!*names || chosen[i])
            selection->examples[selection->count++] = ALL[i];
    return true;
}

/* Each pixel of a thumbnail is the mean of the whole pixels that it covers, at least one. */
static void shrink(const Image *image, unsigned char *to, size_t stride, int width, int height)
{
    const size_t row_size = image_row_size(image);
    for (int y = 0; y < height; y++) {
        const int y0 = y * image->height / height;
        const int y1 = (y + 1) * image->height / height;
        const int rows = y1 > y0 ? y1 - y0 : 1;
        unsigned char *pixel = to + (size_t)y * stride;
        for (int x = 0, x0 = 0; x < width; x++, pixel += 4) {
            const int x1 = (x + 1) * image->width / width;
            const int columns = x1 > x0 ? x1 - x0 : 1;
            const unsigned count = (unsigned)(rows * columns);
            unsigned red = count / 2, green = count / 2, blue = count / 2;
            const unsigned char *row =
                (unsigned char *)image->pixels + (size_t)y0 * row_size + 4 * (size_t)x0;
            for (int j = 0; j < rows; j++, row += row_size) {
                for (int i = 0; i < columns; i++) {
                    red += row[4 * i];
                    green += row[4 * i + 1];
                    blue += row[4 * i + 2];
                }
            }
            pixel[0] = (unsigned char)(red / count);
            pixel[1] = (unsigned char)(green / count);
            pixel[2] = (unsigned char)(blue / count);
            pixel[3] = 255;
            x0 = x1;
        }
    }
}

static bool sheet_open(Image *sheet, int count, Message *message)
{
    const int columns = count < COLUMNS ? count : COLUMNS;
    const int rows = (count + COLUMNS - 1) / COLUMNS;
    if (!image_open(sheet, MARGIN + columns * (THUMBNAIL + MARGIN),
                    MARGIN + rows * (THUMBNAIL + LABEL + MARGIN), IMAGE_BYTE, message))
        return false;
    unsigned char *pixels = sheet->pixels;
    for (size_t i = 0; i < (size_t)sheet->width * (size_t)sheet->height; i++) {
        pixels[4 * i] = pixels[4 * i + 1] = pixels[4 * i + 2] = 48;
        pixels[4 * i + 3] = 255;
    }
    return true;
}

static void sheet_place(int index, int *x, int *y)
{
    *x = MARGIN + index % COLUMNS * (THUMBNAIL + MARGIN);
    *y = MARGIN + index / COLUMNS * (THUMBNAIL + LABEL + MARGIN);
}

static void sheet_put(Image *sheet, int index, const Image *image)
{
    const int longer = image->width > image->height ? image->width : image->height;
    int width = (int)lround((double)THUMBNAIL * image->width / longer);
    int height = (int)lround((double)THUMBNAIL * image->height / longer);
    width = width < 1 ? 1 : width;
    height = height < 1 ? 1 : height;
    int x, y;
    sheet_place(index, &x, &y);
    x += (THUMBNAIL - width) / 2;
    y += (THUMBNAIL - height) / 2;
    const size_t stride = image_row_size(sheet);
    unsigned char *to = (unsigned char *)sheet->pixels + (size_t)y * stride + 4 * (size_t)x;
    shrink(image, to, stride, width, height);
}

/* A sheet without a font is complete but for its labels. */
static void sheet_label(Image *sheet, const Selection *selection, const char *program)
{
    for (int i = 0; i < selection->count; i++) {
        int x, y;
        Message message = {0};
        sheet_place(i, &x, &y);
        if (!image_label(sheet, x + THUMBNAIL / 2, y + THUMBNAIL + 15, LABEL_SIZE,
                         selection->examples[i]->name, &message)) {
            fprintf(stderr, "%s: the contact sheet has no labels: %s\n", program, message.text);
            return;
        }
    }
}

/* Without --size a picture has the example's own size. */
static Options options_of(const Example *example, const Options *options)
{
    Options own = *options;
    const Usage usage = options_usage(example);
    if (!options->size_given)
        options_size(&usage, &own.width, &own.height);
    return own;
}

/* The command that draws the picture; --shaders is cut because its folder is private. */
static void print_command(FILE *file, const Example *example, const Options *options)
{
    char command[512]; /* longer than any */
    Options own = options_of(example, options);
    own.output_given = false;
    own.shaders.folder = own.shaders.folder ? "..." : NULL;
    command_write(example, &own, NULL, command, sizeof command);
    fprintf(file, "examples/run %s", command);
}

static bool write_page(const char *folder, const Selection *selection, const Options *options,
                       Message *message)
{
    static const char head[] =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<title>Lighting: the gallery</title>\n<style>\n"
        "body { font-family: sans-serif; background: #222; color: #eee; margin: 2em; }\n"
        "main { display: flex; flex-wrap: wrap; gap: 1.5em; }\n"
        "figure { margin: 0; width: 16em; }\n"
        "img { width: 100%; height: 16em; object-fit: contain; background: #000; }\n"
        "a { color: #9cf; }\ncode { color: #fc9; overflow-wrap: anywhere; }\n"
        "</style>\n</head>\n<body>\n<h1>Lighting</h1>\n"
        "<p><a href=\"contact-sheet.png\">All on one sheet</a></p>\n<main>\n";
    char *text = NULL, path[PATH_MAX];
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return message_set(message, "index.html: %s", strerror(errno));
    fputs(head, file);
    for (int i = 0; i < selection->count; i++) {
        const Example *example = selection->examples[i];
        fprintf(
            file,
            "<figure>\n<a href=\"%s.png\"><img src=\"%s.png\" alt=\"%s\" loading=\"lazy\"></a>\n"
            "<figcaption><strong>%s</strong><br>%s<br><code>",
            example->name, example->name, example->name, example->name, example->summary);
        print_command(file, example, options);
        fputs("</code></figcaption>\n</figure>\n", file);
    }
    fputs("</main>\n</body>\n</html>\n", file);
    const bool whole = fclose(file) == 0;
    snprintf(path, sizeof path, "%s/index.html", folder);
    const bool written = whole ? output_write(path, text, size, message)
                               : message_set(message, "index.html: not enough memory");
    free(text);
    return written;
}

static bool draw_one(const Example *example, int index, Canvas *canvas, const Options *options,
                     PictureQueue *queue, Image *sheet, Message *message)
{
    Stage stage;
    const Options own = options_of(example, options);
    if (!canvas_resize(canvas, own.width, own.height, message) ||
        !stage_open(&stage, example, canvas, options, message))
        return false;
    stage_warn(&stage);
    Picture *picture = picture_queue_take(queue);
    snprintf(picture->path, sizeof picture->path, "%s/%s.png", options->output, example->name);
    const bool drawn = stage_picture(&stage, &own, options->seconds, picture, message);
    stage_close(&stage);
    if (!drawn)
        return false;
    sheet_put(sheet, index, &picture->image);
    return picture_queue_give(queue, picture, message);
}

static bool draw_all(const Selection *selection, Canvas *canvas, const Options *options,
                     Image *sheet, Message *message)
{
    PictureQueue *queue;
    Progress progress = progress_start("gallery");
    if (!picture_queue_open(&queue, canvas->width, canvas->height, IMAGE_BYTE, selection->count,
                            NULL, message))
        return false;
    bool done = true;
    for (int i = 0; i < selection->count && done; i++) {
        const double start = clock_now();
        done = draw_one(selection->examples[i], i, canvas, options, queue, sheet, message);
        if (options->verbose)
            fprintf(stderr, "%s took %.1f ms\n", selection->examples[i]->name,
                    1e3 * (clock_now() - start));
        progress_update(&progress, i + 1, selection->count);
    }
    progress_end(&progress);
    return picture_queue_close(queue, message) && done;
}

static bool write_sheet(const Image *sheet, const Options *options, Message *message)
{
    char path[PATH_MAX];
    const ImageOptions image_options = {.compress = options->compress};
    snprintf(path, sizeof path, "%s/contact-sheet.png", options->output);
    return image_write(sheet, path, &image_options, message);
}

static bool write_gallery(const Selection *selection, const Options *options, Message *message)
{
    Canvas canvas = {0};
    Stage stage;
    Image sheet = {0};
    if (!shader_loader_check(&options->shaders, message))
        return false;
    setenv("LP_NUM_THREADS", "0", 0); /* as in run.c: other threads encode */
    bool done = stage_open_canvas(&canvas, options, "gallery.png", message);
    /* Each is opened once before anything is written: a failure must not leave half a gallery. */
    for (int i = 0; i < selection->count && done; i++) {
        done = stage_open(&stage, selection->examples[i], &canvas, options, message);
        if (done)
            stage_close(&stage);
    }
    if (done && !options->shaders.print) {
        done = output_folder(options->output, message) &&
               sheet_open(&sheet, selection->count, message) &&
               draw_all(selection, &canvas, options, &sheet, message);
        if (done) {
            sheet_label(&sheet, selection, "gallery");
            done = write_sheet(&sheet, options, message) &&
                   write_page(options->output, selection, options, message);
        }
    }
    image_close(&sheet);
    canvas_close(&canvas);
    return done;
}

int main(int argc, char *argv[])
{
    static const Usage usage = {
        .name = "gallery",
        .summary = "draws all programs, or those named, with a contact sheet and an HTML page",
        .gallery = true,
    };
    Options options;
    int code;
    Message message = {0};
    Selection selection = {.count = 0};
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (!select_examples(&selection, options.names, &message))
        return options_fail(usage.name, &message, EXIT_USAGE);
    if (options.doctor)
        return options_finish(usage.name, doctor_run());
    if (!write_gallery(&selection, &options, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    if (!options.shaders.print)
        printf("%s/index.html\n", options.output);
    return options_finish(usage.name, 0);
}
