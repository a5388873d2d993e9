/*
 * reference_error: how far a drawn picture lies from the exact one. No GL.
 *
 * Errors are in steps of 1/255, a pixel's that of the worst of its three channels. Floats count
 * clamped to 0..1, as the exact picture is; one that is not finite is wrong by 255.
 */
#ifndef REFERENCE_ERROR_H
#define REFERENCE_ERROR_H

#include "image.h"
#include "reference.h"

/* Of one pixel. */
typedef struct PixelError {
    double largest; /* of the channels, 0..255 */
    double squares; /* their sum */
} PixelError;

/* Pixel number `pixel` of the image against number `exact_pixel` of the exact picture, both counted
 * row by row. */
PixelError reference_pixel_error(const Image *image, size_t pixel, const Reference *exact,
                                 size_t exact_pixel);

/* Of some pixels. Zeroed: of none. */
typedef struct ErrorSum {
    long long pixels;
    long long wrong; /* those off by more than a step: more than rounding explains */
    double squares;  /* over all channels */
    double maximum;  /* 0 where there are no pixels */
    size_t worst;    /* the number of the first pixel with the maximum, in the image */
} ErrorSum;
void error_sum_add(ErrorSum *sum, PixelError error, size_t pixel);

/* The root of the mean square, over all channels; NAN where there are no pixels. */
double error_sum_rms(const ErrorSum *sum);

typedef struct ReferenceError {
    ErrorSum interior; /* shading alone: no edge runs through these pixels */
    ErrorSum all;      /* silhouettes too */
} ReferenceError;

/* Adds every pixel of the exact picture, whose upper left one is (left, top) in the image and which
 * lies within it. Several views of one image are added one after the other.
 *
 * Interior are the pixels that the exact picture calls so. Where the image is of a coarser mesh,
 * that includes some beyond the mesh's outline; `drawn`, if not NULL, is the picture of the meshes
 * as drawn, of the same size, and interior are then only pixels that are so in both, with the same
 * object at about the same depth (within 5%). */
void reference_error_add(ReferenceError *error, const Image *image, int left, int top,
                         const Reference *exact, const Reference *drawn);

#endif
