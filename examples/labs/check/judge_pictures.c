/* Pictures side by side, enlarged until they are large enough to see pixels. */
#include "labs/check/judge.h"

#include "base/memory.h"
#include "probe/show.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SPACE = 8 };

/* A difference is brightened so that the largest is white, but a step is at most this: rounding
 * must not look like a mistake. */
static const double MAX_GAIN = 16;

bool judge_difference(const Image *a, const Image *b, const Reference *exact, Image *difference,
                      Message *message)
{
    if (!image_open(difference, a->width, a->height, IMAGE_BYTE, message))
        return false;
    const unsigned char *p = a->pixels, *q = b->pixels;
    unsigned char *out = difference->pixels;
    int largest = 1;
    for (size_t i = 0; i < 4 * (size_t)a->width * (size_t)a->height; i++)
        if (i % 4 < 3 && exact->interior[i / 4] && abs(p[i] - q[i]) > largest)
            largest = abs(p[i] - q[i]);
    const double gain = fmin(255.0 / largest, MAX_GAIN);
    for (size_t i = 0; i < 4 * (size_t)a->width * (size_t)a->height; i++) {
        const bool counts =
            exact->interior[i / 4] || (exact->object[i / 4] < 0 && exact->coverage[i / 4] >= 1);
        out[i] = i % 4 == 3 ? 255 : counts ? (unsigned char)fmin(gain * abs(p[i] - q[i]), 255) : 0;
    }
    return true;
}

/* Copies a picture into a larger one, each pixel as a square. */
static void paste(const Image *from, int times, int left, int top, Image *to)
{
    for (int y = 0; y < times * from->height; y++)
        for (int x = 0; x < times * from->width; x++) {
            const size_t source = (size_t)(y / times) * (size_t)from->width + (size_t)(x / times);
            const size_t target = (size_t)(top + y) * (size_t)to->width + (size_t)(left + x);
            memcpy((unsigned char *)to->pixels + 4 * target,
                   (const unsigned char *)from->pixels + 4 * source, 4);
        }
}

void judge_value(const LabPictures *pictures, int number, const SubmissionFiles *files,
                 FirstWrong *first, Canvas *canvas, Verdict *verdict)
{
    const LabPicture *picture = &pictures->items[number];
    const SubmissionGeometry geometry = lab_pictures_geometry(pictures, number);
    const int size[2] = {picture->image.width, picture->image.height};
    const size_t count = (size_t)size[0] * (size_t)size[1];
    ShowPixel *pixels = memory_new(2 * count, sizeof *pixels);
    char name[LAB_NAME_SIZE + 8], *legend = NULL;
    size_t length;
    SubmissionFiles sides = *files;
    Show show = {.pixels = NULL};
    Image drawn = {0};
    bool done = first->right && image_open(&drawn, size[0], size[1], IMAGE_BYTE, NULL);
    snprintf(name, sizeof name, "%s%s", pictures->lab->file, first->stage ? ".frag" : ".vert");
    for (int side = 0; side < 2 && done; side++) {
        Shader shader = {0};
        Capture capture = {0};
        for (int i = 0; side && i < sides.count; i++)
            if (strcmp(sides.texts[i].name, name) == 0)
                sides.texts[i].text = first->right;
        done = canvas_resize(canvas, size[0], size[1], NULL);
        capture_begin(&capture, canvas);
        done = done && submission_compile(&shader, pictures->lab, &sides, "highp", NULL);
        const Painter painter = {.lab = pictures->lab, .program = shader.program};
        done = done && painter_draw(&painter, &picture->lab_scene, &geometry, canvas, &drawn, NULL);
        capture_end(&capture);
        show_close(&show);
        done = done && show_open(&show, &capture, &GLSL_EXACT, first->name, size, NULL);
        if (done)
            memcpy(pixels + count * (size_t)side, show.pixels, count * sizeof *pixels);
        capture_close(&capture);
        shader_close(&shader);
    }
    FILE *file = open_memstream(&legend, &length);
    if (done && file && image_open(&first->value, size[0], 2 * size[1], IMAGE_BYTE, NULL)) {
        const Show both = {.kind = show.kind,
                           .what = first->name,
                           .width = size[0],
                           .height = 2 * size[1],
                           .pixels = pixels};
        show_paint(&both, &first->value, file);
        fflush(file);
        verdict_add_symptom(verdict, "Below in the picture, submitted and right: %.*s.",
                            (int)strcspn(legend, "\n"), legend);
    }
    if (file)
        fclose(file);
    free(legend);
    free(pixels);
    show_close(&show);
    image_close(&drawn);
}

bool judge_sheet(const LabPictures *pictures, int number, const Image *value, Image *sheet,
                 Message *message)
{
    const LabPicture *picture = &pictures->items[number];
    const Reference *truth = &picture->truths[pictures->truth];
    Image exact = {0}, difference = {0};
    const int width = picture->image.width, height = picture->image.height;
    const int times = width < 100 ? 3 : width < 200 ? 2 : 1;
    const bool done =
        reference_image(truth, &exact, message) &&
        judge_difference(&picture->image, &exact, truth, &difference, message) &&
        image_open(sheet, 3 * times * width + 2 * SPACE,
                   times * (value->pixels ? 2 * height : height) + (value->pixels ? SPACE : 0),
                   IMAGE_BYTE, message);
    if (done) {
        memset(sheet->pixels, 255, image_row_size(sheet) * (size_t)sheet->height);
        paste(&picture->image, times, 0, 0, sheet);
        paste(&exact, times, times * width + SPACE, 0, sheet);
        paste(&difference, times, 2 * (times * width + SPACE), 0, sheet);
        for (int side = 0; side < 2 && value->pixels; side++) {
            const Image half = {width, height, IMAGE_BYTE,
                                (char *)value->pixels +
                                    (size_t)side * 4 * (size_t)(width * height)};
            paste(&half, times, side * (times * width + SPACE), times * height + SPACE, sheet);
        }
    }
    image_close(&exact);
    image_close(&difference);
    return done;
}
