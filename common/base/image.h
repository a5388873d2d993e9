/*
 * image: pixels in memory.
 */
#ifndef IMAGE_H
#define IMAGE_H

#include "base/message.h"

#include <stddef.h>

typedef enum ImageType {
    IMAGE_BYTE,  /* unsigned char, 0..255 stands for 0..1 */
    IMAGE_FLOAT, /* float, not clamped */
} ImageType;

/* RGBA, row 0 at the top, rows without padding, alpha not premultiplied. */
typedef struct Image {
    int width, height;
    ImageType type;
    void *pixels; /* width * height * 4 unsigned char or float */
} Image;

/* Opens an image of zeros. */
bool image_open(Image *image, int width, int height, ImageType type, Message *message);
void image_close(Image *image);

/* Makes a rectangle (x, y, width, height) of an image of bytes one opaque colour; NULL: all of it.
 */
void image_fill(Image *image, const int place[4], const unsigned char color[3]);

/* Viridis (van der Walt and Smith, 2015), perceptually uniform in lightness: from 0, dark violet,
 * over blue and green to 1, yellow; red, green, blue. */
void image_viridis(double t, unsigned char color[3]);

size_t image_row_size(const Image *image); /* in bytes */

#endif
