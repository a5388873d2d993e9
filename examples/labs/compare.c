#include "compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether all pixels around one, and it itself, are wholly background. */
static bool is_empty(const Reference *exact, int x, int y)
{
    for (int dy = -1; dy <= 1; dy++) {
        for (int dx = -1; dx <= 1; dx++) {
            const int u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= exact->width || v >= exact->height)
                continue;
            const size_t i = (size_t)v * (size_t)exact->width + (size_t)u;
            if (exact->object[i] >= 0 || exact->coverage[i] < 1)
                return false;
        }
    }
    return true;
}

ErrorSum compare_exact(const Image *image, const Reference *exact, const Reference *mask)
{
    ErrorSum sum = {.pixels = 0};
    for (int y = 0; y < exact->height; y++) {
        for (int x = 0; x < exact->width; x++) {
            const size_t i = (size_t)y * (size_t)exact->width + (size_t)x;
            const bool inside = exact->interior[i] && (!mask || mask->interior[i]);
            if (inside || (is_empty(exact, x, y) && (!mask || is_empty(mask, x, y))))
                error_sum_add(&sum, reference_pixel_error(image, i, exact, i), i);
        }
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
    int most = 0;
    for (int c = 0; c < 3; c++) {
        const int d = abs((int)a[c] - (int)b[c]);
        most = d > most ? d : most;
    }
    return most;
}

/* Whether a pixel of one picture is like one around the same place in the other. */
static bool is_near(const Image *a, const Image *b, int x, int y, double tolerance)
{
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < a->height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < a->width; u++)
            if (apart(pixel(a, x, y), pixel(b, u, v)) <= tolerance)
                return true;
    return false;
}

/* Whether there is a step of more than EDGE beside a pixel: more than smooth shading makes. */
static bool at_edge(const Image *image, int x, int y)
{
    enum { EDGE = 20 };
    const unsigned char *here = pixel(image, x, y);
    return (x > 0 && apart(here, pixel(image, x - 1, y)) > EDGE) ||
           (y > 0 && apart(here, pixel(image, x, y - 1)) > EDGE) ||
           (x + 1 < image->width && apart(here, pixel(image, x + 1, y)) > EDGE) ||
           (y + 1 < image->height && apart(here, pixel(image, x, y + 1)) > EDGE);
}

static bool is_dark(const unsigned char *p)
{
    return p[0] == 0 && p[1] == 0 && p[2] == 0;
}

Likeness compare_drawn(const Image *a, const Image *b, double tolerance, int most)
{
    Likeness found = {.maximum = 0};
    if (memcmp(a->pixels, b->pixels, 4 * (size_t)a->width * (size_t)a->height) == 0)
        return found;
    for (int y = 0; y < a->height; y++) {
        for (int x = 0; x < a->width; x++) {
            const unsigned char *p = pixel(a, x, y), *q = pixel(b, x, y);
            found.pixels += !is_dark(p) || !is_dark(q);
            const int d = apart(p, q);
            if (d <= tolerance) {
                found.maximum = fmax(found.maximum, d);
                continue;
            }
            if ((at_edge(a, x, y) || at_edge(b, x, y)) && is_near(a, b, x, y, tolerance) &&
                is_near(b, a, x, y, tolerance))
                continue;
            found.maximum = fmax(found.maximum, d);
            if (++found.differing > most)
                return found;
        }
    }
    return found;
}
