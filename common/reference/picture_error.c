#include "reference/picture_error.h"

#include <math.h>

/* A channel from 0 to 255; NAN if it is not finite. */
static double steps(const Image *image, size_t index)
{
    if (image->type == IMAGE_BYTE)
        return ((const unsigned char *)image->pixels)[index];
    const double value = (double)((const float *)image->pixels)[index];
    return !isfinite(value) ? NAN : value < 0 ? 0 : value > 1 ? 255 : 255 * value;
}

PixelError pixel_error(const Image *image, size_t pixel, const Reference *exact, size_t exact_pixel)
{
    PixelError error = {0, 0};
    for (size_t c = 0; c < 3; c++) {
        const double apart =
            fabs(steps(image, 4 * pixel + c) - 255 * (double)exact->color[3 * exact_pixel + c]);
        const double off = isnan(apart) ? 255 : apart;
        error.largest = fmax(error.largest, off);
        error.squares += off * off;
    }
    return error;
}

void error_sum_add(ErrorSum *sum, PixelError error, size_t pixel)
{
    if (error.largest > sum->maximum || sum->pixels == 0) {
        sum->maximum = error.largest;
        sum->worst = pixel;
    }
    sum->pixels++;
    sum->wrong += error.largest > 1;
    sum->squares += error.squares;
}

double error_sum_rms(const ErrorSum *sum)
{
    return sum->pixels ? sqrt(sum->squares / (3.0 * (double)sum->pixels)) : NAN;
}

bool pixel_is_interior(const Reference *exact, const Reference *drawn, int x, int y)
{
    static const double DEPTH = 0.05;
    const size_t width = (size_t)exact->width, pixel = (size_t)y * width + (size_t)x;
    if (!exact->interior[pixel] || !drawn)
        return exact->interior[pixel];
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < exact->height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < exact->width; i++)
            if (drawn->object[(size_t)j * width + (size_t)i] != exact->object[pixel])
                return false;
    return fabs(drawn->depth[pixel] - exact->depth[pixel]) <= DEPTH * exact->depth[pixel];
}

void picture_error_add(PictureError *error, const Image *image, int left, int top,
                       const Reference *exact, const Reference *drawn)
{
    for (int y = 0; y < exact->height; y++) {
        for (int x = 0; x < exact->width; x++) {
            const size_t pixel = (size_t)(top + y) * (size_t)image->width + (size_t)(left + x);
            const size_t exact_pixel = (size_t)y * (size_t)exact->width + (size_t)x;
            const PixelError found = pixel_error(image, pixel, exact, exact_pixel);
            error_sum_add(&error->all, found, pixel);
            if (pixel_is_interior(exact, drawn, x, y))
                error_sum_add(&error->interior, found, pixel);
        }
    }
}
