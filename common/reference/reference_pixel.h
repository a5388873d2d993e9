/*
 * reference_pixel: a pixel from samples, by adaptive subdivision.
 *
 * A pixel whose nine samples (corners, midpoints of its sides, center) agree is smooth, and has the
 * color of its center. Any other is divided into squares. An edge that cuts a square in two is
 * located on the square's sides by bisection and assumed to be straight between them, which is
 * checked at its midpoint; the two parts count with their areas and the colors at their centers. If
 * that fails, the square is divided further, until it is too small to matter:
 *
 *   with E = edge_error / 255 and D the difference of the colors that meet (1 between objects,
 * because of coverage): an edge is at most sqrt(2) long in a pixel. Displaced by T it adds
 *   sqrt(2) T D at most; T = E / 2 D leaves E / sqrt(2). A square of side h that is not resolved is
 *   its samples' mean; an edge parallel to its sides crosses 1 / h such squares, each with an error
 *   of a quarter of its area at most: D h / 4, so that squares with D h <= 4 E are not divided.
 *
 * The nine samples may miss a part of another surface that enters and leaves through the same half
 * of a side, or stays within one quarter: at a circle of R pixels at most 1 / (96 R) of the pixel,
 * at a right angle 1/16.
 */
#ifndef REFERENCE_PIXEL_H
#define REFERENCE_PIXEL_H

#include "reference/reference_trace.h"

typedef struct Pixel {
    float color[3];
    float coverage; /* of the object at its center */
    bool interior;
} Pixel;

/* Samples taken lately, because squares, and pixels, share their sides. Zeroed: none; for one
 * picture and one thread. */
enum { PIXEL_RECENT = 512 };
typedef struct PixelRecent {
    bool taken;
    double x, y;
    Sample sample;
} PixelRecent;

/* What pixels are resolved with. */
typedef struct PixelTracer {
    const Trace *trace;
    double edge_error;
    PixelRecent *recent; /* PIXEL_RECENT */
} PixelTracer;

/* The pixel whose upper left corner is (x, y), from the samples of the three rows of its grid, each
 * three of them, at distances of half a pixel. */
Pixel pixel_resolve(const PixelTracer *tracer, int x, int y, const Sample *const rows[3]);

#endif
