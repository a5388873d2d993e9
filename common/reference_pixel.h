/*
 * reference_pixel: a pixel from samples of what is seen in it.
 *
 * A pixel whose nine samples (corners, middles of its sides, centre) agree is smooth, and has the
 * colour of its centre. Any other is divided into squares. Where an edge parts a square in two, it
 * is found on the square's sides by bisection and taken for straight between them, which is checked
 * where it should bulge most; the two parts count with their areas and the colours at their
 * middles. Squares where that fails are divided further, down to those too small to matter:
 *
 *   with E = edge_error / 255 and D the difference of the colours that meet (1 where objects do,
 * for the sake of coverage): an edge is at most sqrt(2) long in a pixel. Displaced by T it adds
 *   sqrt(2) T D at most; T = E / 2 D leaves E / sqrt(2). A square of side h that is not resolved is
 *   its samples' mean; an edge parallel to its sides crosses 1 / h such squares, each with an error
 *   of a quarter of its area at most: D h / 4, so that squares with D h <= 4 E are not divided.
 *
 * What may be overlooked lies between the nine samples: a part of another surface that enters and
 * leaves through the same half of a side, or stays within one quarter. Where the edge is a circle
 * of R pixels that is a sliver of at most 1 / (96 R) of the pixel; where it has a right angle,
 * 1/16.
 */
#ifndef REFERENCE_PIXEL_H
#define REFERENCE_PIXEL_H

#include "reference_trace.h"

typedef struct Pixel {
    float color[3];
    float coverage; /* of the object at its centre */
    bool interior;
} Pixel;

/* The pixel whose upper left corner is (x, y), from the samples of the three rows of its grid, each
 * three of them, at distances of half a pixel. */
Pixel pixel_resolve(const Trace *trace, double edge_error, int x, int y, const Sample *top,
                    const Sample *middle, const Sample *bottom);

#endif
