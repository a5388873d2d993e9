/*
 * reference_pixel: a pixel from samples, by adaptive subdivision.
 *
 * A pixel whose nine samples (corners, midpoints of its sides, center) agree is smooth, and has the
 * color of its center. Any other is the mean over its area, with an error of at most edge_error
 * where edges are straight; see reference_pixel.c.
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
