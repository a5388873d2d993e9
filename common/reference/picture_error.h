/*
 * picture_error: the error of a drawn picture against the exact one. No GL.
 *
 * Errors are in steps of 1/255; a pixel's error is that of the worst of its three channels. Floats
 * are clamped to 0..1, like the exact picture; the error of one that is not finite is 255.
 */
#ifndef PICTURE_ERROR_H
#define PICTURE_ERROR_H

#include "base/image.h"
#include "reference/reference.h"

/* Of one pixel. */
typedef struct PixelError {
    double largest; /* of the channels, 0..255 */
    double squares; /* their sum */
} PixelError;

/* Pixel `pixel` of the image against `exact_pixel` of the exact picture: indices in row order. */
PixelError pixel_error(const Image *image, size_t pixel, const Reference *exact,
                       size_t exact_pixel);

/* The error of a set of pixels. Zeroed: the empty set. */
typedef struct ErrorSum {
    long long pixels;
    long long wrong; /* those off by more than one step, which rounding does not explain */
    double squares;  /* over all channels */
    double maximum;  /* 0 without pixels */
    size_t worst;    /* index in the image of the first pixel with the maximum */
} ErrorSum;
void error_sum_add(ErrorSum *sum, PixelError error, size_t pixel);

/* The root of the mean square, over all channels; NAN without pixels. */
double error_sum_rms(const ErrorSum *sum);

typedef struct PictureError {
    ErrorSum interior; /* of the pixels inside an object: shading alone */
    ErrorSum all;      /* of every pixel: shading and silhouettes */
} PictureError;

/* Whether a pixel is inside an object. This is the only definition of that in the project:
 *
 * - no edge runs through the pixel in the exact picture (Reference.interior), and
 * - if `drawn` is not NULL: the pixel and its 8 neighbors show the same object in `drawn` as the
 *   pixel does in the exact picture, and its depth there differs by at most 5%.
 *
 * `drawn` has the objects and depths at pixel centers of the meshes as drawn; only these two arrays
 * are read. It is NULL if the meshes are the exact shapes: if the scene has no solids. A coarse
 * mesh does not cover its exact shape up to the outline. Neighbors outside the picture do not
 * count. */
bool pixel_is_interior(const Reference *exact, const Reference *drawn, int x, int y);

/* Adds every pixel of the exact picture, whose upper left pixel is (left, top) in the image and
 * which lies within it. `drawn`: as above, of the same size. Several views of one image are added
 * one after another. */
void picture_error_add(PictureError *error, const Image *image, int left, int top,
                       const Reference *exact, const Reference *drawn);

#endif
