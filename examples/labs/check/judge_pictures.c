/* Pictures side by side, enlarged until they are large enough to see pixels. */
#include "labs/check/judge.h"

#include <math.h>
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
static void paste(const Image *from, int times, int left, Image *to)
{
    for (int y = 0; y < times * from->height; y++) {
        for (int x = 0; x < times * from->width; x++) {
            const size_t source = (size_t)(y / times) * (size_t)from->width + (size_t)(x / times);
            const size_t target = (size_t)y * (size_t)to->width + (size_t)(left + x);
            memcpy((unsigned char *)to->pixels + 4 * target,
                   (const unsigned char *)from->pixels + 4 * source, 4);
        }
    }
}

bool judge_sheet(const LabPictures *pictures, int number, Image *sheet, Message *message)
{
    const LabPicture *picture = &pictures->items[number];
    const Reference *truth = &picture->truths[pictures->truth];
    Image exact = {0}, difference = {0};
    const int width = picture->image.width, height = picture->image.height;
    const int times = width < 100 ? 3 : width < 200 ? 2 : 1;
    const bool done =
        reference_image(truth, &exact, message) &&
        judge_difference(&picture->image, &exact, truth, &difference, message) &&
        image_open(sheet, 3 * times * width + 2 * SPACE, times * height, IMAGE_BYTE, message);
    if (done) {
        memset(sheet->pixels, 255, image_row_size(sheet) * (size_t)sheet->height);
        paste(&picture->image, times, 0, sheet);
        paste(&exact, times, times * width + SPACE, sheet);
        paste(&difference, times, 2 * (times * width + SPACE), sheet);
    }
    image_close(&exact);
    image_close(&difference);
    return done;
}
