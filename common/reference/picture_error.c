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

PixelError pixel_error(const Image *image, size_t pixel, const float color[3])
{
    PixelError error = {0, 0};
    for (size_t c = 0; c < 3; c++) {
        const double apart = fabs(steps(image, 4 * pixel + c) - 255 * (double)color[c]);
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

/* Whether the alpha, from 0 to 255, is one of the object's. */
static bool is_alpha_of(const Object *object, double alpha)
{
    static const double ROUNDING = 0.75;
    return !(fabs(alpha - 255 * object->front.alpha) > ROUNDING) ||
           (object->two_sided && !(fabs(alpha - 255 * object->back.alpha) > ROUNDING));
}

bool pixel_is_interior(const Scene *scene, int object, const Image *image, size_t pixel)
{
    const double alpha = steps(image, 4 * pixel + 3);
    bool covered = object >= 0 && is_alpha_of(&scene->objects[object], alpha);
    for (int i = 0; i < scene->object_count && object >= 0 && !covered; i++)
        covered = is_alpha_of(&scene->objects[i], alpha);
    return covered;
}

void picture_error_add(PictureError *error, const Image *image, int left, int top,
                       const Reference *exact, const Scene *scene)
{
    for (int y = 0; y < exact->height; y++) {
        for (int x = 0; x < exact->width; x++) {
            const size_t pixel = (size_t)(top + y) * (size_t)image->width + (size_t)(left + x);
            const size_t exact_pixel = (size_t)y * (size_t)exact->width + (size_t)x;
            const PixelError found = pixel_error(image, pixel, &exact->color[3 * exact_pixel]);
            const int object = exact->interior[exact_pixel] ? exact->object[exact_pixel] : -1;
            error_sum_add(&error->all, found, pixel);
            if (pixel_is_interior(scene, object, image, pixel))
                error_sum_add(&error->interior, found, pixel);
        }
    }
}
