/*
 * compare: a drawn picture against the exact one, and against another drawn one. No GL.
 *
 * Errors are in steps of 1/255, a pixel's that of the worst of its three channels.
 */
#ifndef COMPARE_H
#define COMPARE_H

#include "reference.h"
#include "reference_error.h"

/* What is right, in the pixels that are compared. Rounding to bytes makes 0.5, arithmetic in 32
 * bits far less; two ways to write the same formula are 1 apart at the worst, and of Blinn-Phong's
 * exponents the fitted one and four times Phong's 1.9 (see probe.c). No mistake of the catalogue
 * that shows at all is below 4. */
#define COMPARE_TOLERANCE 2.5

/* Inside the objects where no edge runs through the pixel, and in the background where there is no
 * object beside it. `mask` is another exact picture that has to agree, with the same object inside;
 * NULL: none. */
ErrorSum compare_exact(const Image *image, const Reference *exact, const Reference *mask);

/* How far two drawn pictures of one size lie apart. */
typedef struct Likeness {
    double maximum; /* of the pixels compared */
    int pixels;     /* those that show anything but the background, in either */
    int differing;  /* those apart by more than the tolerance */
} Likeness;

/* A pixel beside an edge, of a shape or of light, is like a neighbour of its own place in the other
 * picture or counts as any: two programs may round a corner's place differently. `most`: stop, with
 * as many that differ, once there are more. */
Likeness compare_drawn(const Image *a, const Image *b, double tolerance, int most);

#endif
