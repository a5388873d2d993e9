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
#include "scene/scene.h"

/* Of one pixel. */
typedef struct PixelError {
    double largest; /* of the channels, 0..255 */
    double squares; /* their sum */
} PixelError;

/* Pixel `pixel` of the image, in row order, against the exact color: see Reference. */
PixelError pixel_error(const Image *image, size_t pixel, const float color[3]);

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
    ErrorSum edges;    /* of the pixels that are neither inside an object nor background alone */
} PictureError;

/* Whether a pixel is inside an object: the only definition of that in the project.
 *
 * - No edge runs through it in the exact picture: it lies wholly inside one surface, smoothly lit.
 *   `object` is that surface's where Reference.interior is 1, else -1.
 * - The drawn objects cover it wholly, whichever of them it shows: alpha, channel 3 of pixel
 * `pixel` of the drawn image, is that of an object, over a background whose alpha is 0. A coarse
 * mesh does not reach its exact shape's outline: what is missing there is an error of the
 * silhouette, not of shading.
 * - The same lights reach it, where lights cast shadows: one that reaches it in the exact picture
 * is kept from no part of it by a shadow of the meshes as they are drawn, nor the other way round.
 * A mesh's shadow ends elsewhere than its exact shape's, and so does the shadow on a mesh itself:
 * what is between is an error of an outline, too. This part is pixel_has_its_lights. */
bool pixel_is_interior(const Scene *scene, int object, const Image *image, size_t pixel);

/* Whether no object was drawn in any part of it. */
bool pixel_is_empty(const Image *image, size_t pixel);

/* `drawn`: the exact picture of the meshes as drawn (ReferenceOptions.meshes), lit at every point;
 * NULL: no light casts shadows, or `exact` is that picture. */
bool pixel_has_its_lights(const Reference *exact, const Reference *drawn, size_t pixel);

/* An exact picture, as a part of a drawn image. */
typedef struct ExactView {
    const Reference *exact;
    const Scene *scene;     /* its own */
    const Reference *drawn; /* see pixel_has_its_lights */
    int left, top;          /* its upper left pixel in the image; it lies within that */
} ExactView;

/* Adds every pixel of the exact picture. Several views of one image are added one after another. */
void picture_error_add(PictureError *error, const Image *image, const ExactView *view);

/* The same pixels as a map: black where the error is at most half a step, which is rounding, else
 * from blue over green and yellow to white, a color for every factor of 8. `map`: of bytes, of the
 * image's size. */
void picture_error_map(Image *map, const Image *image, const ExactView *view);
extern const unsigned char PICTURE_ERROR_COLORS[4][3]; /* of errors of 0.5, 4, 32 and 255 */

#endif
