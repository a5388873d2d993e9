/* Pixels in one block. */
#include "base/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t value_size(ImageType type)
{
    return type == IMAGE_FLOAT ? sizeof(float) : 1;
}

size_t image_row_size(const Image *image)
{
    return 4 * (size_t)image->width * value_size(image->type);
}

bool image_open(Image *image, int width, int height, ImageType type, Message *message)
{
    *image = (Image){.width = width, .height = height, .type = type};
    if (width < 1 || height < 1)
        return message_set(message, "image: size %dx%d: must be at least 1x1", width, height);
    image->pixels = calloc((size_t)height, image_row_size(image));
    if (!image->pixels)
        return message_set(message, "image: not enough memory for %dx%d pixels", width, height);
    return true;
}

void image_close(Image *image)
{
    if (!image)
        return;
    free(image->pixels);
    *image = (Image){0};
}

void image_fill(Image *image, const int place[4], const unsigned char color[3])
{
    const int all[4] = {0, 0, image->width, image->height};
    place = place ? place : all;
    for (int y = place[1]; y < place[1] + place[3]; y++) {
        unsigned char *pixel = (unsigned char *)image->pixels +
                               4 * ((size_t)y * (size_t)image->width + (size_t)place[0]);
        for (int x = 0; x < place[2]; x++, pixel += 4)
            memcpy(pixel, (const unsigned char[4]){color[0], color[1], color[2], 255}, 4);
    }
}

void image_viridis(double t, unsigned char color[3])
{
    static const unsigned char stops[][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                             {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                             {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
    enum { PARTS = (int)(sizeof stops / sizeof stops[0]) - 1 };
    const double place = fmin(fmax(t, 0), 1) * PARTS;
    const int part = place < PARTS ? (int)place : PARTS - 1;
    for (int c = 0; c < 3; c++) {
        const double from = stops[part][c], to = stops[part + 1][c];
        color[c] = (unsigned char)lround(from + (place - part) * (to - from));
    }
}
