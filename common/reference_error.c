#include "reference_error.h"

#include <math.h>

/* A channel from 0 to 255; NAN where it is not finite. */
static double steps(const Image *image, size_t index)
{
    if (image->type == IMAGE_BYTE)
        return ((const unsigned char *)image->pixels)[index];
    const double value = (double)((const float *)image->pixels)[index];
    return !isfinite(value) ? NAN : value < 0 ? 0 : value > 1 ? 255 : 255 * value;
}

PixelError reference_pixel_error(const Image *image, size_t pixel, const Reference *exact,
                                 size_t exact_pixel)
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

/* Whether both show one piece of surface. */
static bool is_interior(const Reference *exact, const Reference *drawn, size_t pixel)
{
    static const double DEPTH = 0.05;
    if (!exact->interior[pixel] || !drawn)
        return exact->interior[pixel];
    return drawn->interior[pixel] && drawn->object[pixel] == exact->object[pixel] &&
           fabs(drawn->depth[pixel] - exact->depth[pixel]) <= DEPTH * exact->depth[pixel];
}

void reference_error_add(ReferenceError *error, const Image *image, int left, int top,
                         const Reference *exact, const Reference *drawn)
{
    for (int y = 0; y < exact->height; y++) {
        for (int x = 0; x < exact->width; x++) {
            const size_t pixel = (size_t)(top + y) * (size_t)image->width + (size_t)(left + x);
            const size_t exact_pixel = (size_t)y * (size_t)exact->width + (size_t)x;
            const PixelError found = reference_pixel_error(image, pixel, exact, exact_pixel);
            error_sum_add(&error->all, found, pixel);
            if (is_interior(exact, drawn, exact_pixel))
                error_sum_add(&error->interior, found, pixel);
        }
    }
}
