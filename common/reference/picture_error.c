/*
 * What counts as a pixel of shading, and what of a silhouette, is decided here for the whole
 * project: see pixel_is_interior. The map's colors are on a logarithmic scale, a color for every
 * factor of 8, because errors range from rounding, half a step, to all of the 255.
 */
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

bool pixel_is_empty(const Image *image, size_t pixel)
{
    return steps(image, 4 * pixel + 3) == 0;
}

bool pixel_has_its_lights(const Reference *exact, const Reference *drawn, size_t pixel)
{
    return !exact->lights || !drawn || drawn->object[pixel] != exact->object[pixel] ||
           !reference_lights_differ(exact->lights[pixel], drawn->lights[pixel]);
}

/* In both pictures, wholly. */
static bool is_background(const Reference *exact, size_t exact_pixel, const Image *image,
                          size_t pixel)
{
    return exact->object[exact_pixel] < 0 && exact->coverage[exact_pixel] >= 1 &&
           pixel_is_empty(image, pixel);
}

static size_t place_in_image(const Image *image, const ExactView *view, int x, int y)
{
    return (size_t)(view->top + y) * (size_t)image->width + (size_t)(view->left + x);
}

void picture_error_add(PictureError *error, const Image *image, const ExactView *view)
{
    const Reference *exact = view->exact;
    for (int y = 0; y < exact->height; y++)
        for (int x = 0; x < exact->width; x++) {
            const size_t pixel = place_in_image(image, view, x, y);
            const size_t exact_pixel = (size_t)y * (size_t)exact->width + (size_t)x;
            const PixelError found = pixel_error(image, pixel, &exact->color[3 * exact_pixel]);
            const int object = exact->interior[exact_pixel] ? exact->object[exact_pixel] : -1;
            error_sum_add(&error->all, found, pixel);
            const bool inside = pixel_is_interior(view->scene, object, image, pixel) &&
                                pixel_has_its_lights(exact, view->drawn, exact_pixel);
            if (inside || !is_background(exact, exact_pixel, image, pixel))
                error_sum_add(inside ? &error->interior : &error->edges, found, pixel);
        }
}

const unsigned char PICTURE_ERROR_COLORS[4][3] = {
    {70, 110, 255}, {0, 200, 120}, {255, 200, 0}, {255, 255, 255}};

static void color_of(double error, unsigned char *color)
{
    static const double MIN = 0.5, STEP = 8;
    const double at = fmin(fmax(log(error / MIN) / log(STEP), 0), 2.999);
    const int first = (int)at;
    for (int c = 0; c < 3; c++) {
        const double from = PICTURE_ERROR_COLORS[first][c], to = PICTURE_ERROR_COLORS[first + 1][c];
        color[c] =
            error > MIN + 1e-3 ? (unsigned char)lround(from + (at - first) * (to - from)) : 0;
    }
}

void picture_error_map(Image *map, const Image *image, const ExactView *view)
{
    const Reference *exact = view->exact;
    for (int y = 0; y < exact->height; y++)
        for (int x = 0; x < exact->width; x++) {
            const size_t pixel = place_in_image(image, view, x, y);
            const size_t exact_pixel = (size_t)y * (size_t)exact->width + (size_t)x;
            const PixelError found = pixel_error(image, pixel, &exact->color[3 * exact_pixel]);
            color_of(found.largest, (unsigned char *)map->pixels + 4 * pixel);
        }
}
