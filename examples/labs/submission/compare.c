/* Pixels at edges differ between right programs, by how a vertex is rounded, so only those inside
 * objects count against the exact picture, and two drawn pictures may be a pixel apart. */
#include "labs/submission/lab_pictures.h"

#include <math.h>
#include <stdlib.h>

/* Whether a pixel and its neighbors are background only. */
static bool is_empty(const Reference *exact, int x, int y)
{
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= exact->width || v >= exact->height)
                continue;
            const size_t i = (size_t)v * (size_t)exact->width + (size_t)u;
            if (exact->object[i] >= 0 || exact->coverage[i] < 1)
                return false;
        }
    return true;
}

/* Whether all pixels within two of it are inside the object: a mesh that is worth drawing has its
 * outline outside. */
static bool is_deep(const Reference *exact, int x, int y)
{
    const int reach = 2, own = exact->object[(size_t)y * (size_t)exact->width + (size_t)x];
    for (int v = y - reach; v <= y + reach; v++)
        for (int u = x - reach; u <= x + reach; u++)
            if (u < 0 || v < 0 || u >= exact->width || v >= exact->height ||
                exact->object[(size_t)v * (size_t)exact->width + (size_t)u] != own ||
                !exact->interior[(size_t)v * (size_t)exact->width + (size_t)u])
                return false;
    return true;
}

/* Whether no edge runs through a pixel, and the mesh as drawn shows the same object there and in
 * all neighbors, at about the same depth. More tolerant than pixel_is_interior: a submission's
 * outline may be another. */
static bool is_same_inside(const Reference *exact, const Reference *mask, int x, int y)
{
    static const double DEPTH = 0.05;
    const size_t width = (size_t)exact->width, pixel = (size_t)y * width + (size_t)x;
    if (!exact->interior[pixel] || !mask)
        return exact->interior[pixel];
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < exact->height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < exact->width; u++)
            if (mask->object[(size_t)v * width + (size_t)u] != exact->object[pixel])
                return false;
    return fabs(mask->depth[pixel] - exact->depth[pixel]) <= DEPTH * exact->depth[pixel];
}

/* Where in the image the exact picture's pixel is: its center that of a square of pixels. */
static size_t middle_of(const Image *image, const Reference *exact, int x, int y)
{
    const int side = image->width / exact->width, half = side / 2;
    return (size_t)(side * y + half) * (size_t)image->width + (size_t)(side * x + half);
}

ErrorSum compare_exact(const Image *image, const Reference *exact, const Reference *mask)
{
    ErrorSum sum = {.pixels = 0};
    for (int y = 0; y < exact->height; y++)
        for (int x = 0; x < exact->width; x++) {
            const size_t i = (size_t)y * (size_t)exact->width + (size_t)x;
            if (is_same_inside(exact, mask, x, y) || (mask && is_deep(exact, x, y)) ||
                is_empty(exact, x, y))
                error_sum_add(
                    &sum, pixel_error(image, middle_of(image, exact, x, y), &exact->color[3 * i]),
                    i);
        }
    return sum;
}

static const unsigned char *pixel(const Image *image, int x, int y)
{
    return (const unsigned char *)image->pixels +
           4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static int apart(const unsigned char *a, const unsigned char *b)
{
    int max = 0;
    for (int c = 0; c < 3; c++) {
        const int d = abs((int)a[c] - (int)b[c]);
        max = d > max ? d : max;
    }
    return max;
}

/* Whether a neighbor differs by more than EDGE, which smooth shading does not. */
static bool at_edge(const Image *image, int x, int y)
{
    enum { EDGE = 20 };
    const unsigned char *here = pixel(image, x, y);
    return (x > 0 && apart(here, pixel(image, x - 1, y)) > EDGE) ||
           (y > 0 && apart(here, pixel(image, x, y - 1)) > EDGE) ||
           (x + 1 < image->width && apart(here, pixel(image, x + 1, y)) > EDGE) ||
           (y + 1 < image->height && apart(here, pixel(image, x, y + 1)) > EDGE);
}

void compare_take(Reference *exact, const Image *image)
{
    const unsigned char *bytes = image->pixels;
    for (int p = 0; p < exact->width * exact->height; p++) {
        const int i = (int)middle_of(image, exact, p % exact->width, p / exact->width);
        for (int c = 0; c < 3; c++)
            exact->color[3 * p + c] = (float)bytes[4 * i + c] / 255;
        exact->interior[p] &= !at_edge(image, i % image->width, i / image->width);
    }
}
