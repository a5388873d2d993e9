/*
 * image_read: pictures that the tests have written, read back by OpenImageIO.
 */
#ifndef IMAGE_READ_H
#define IMAGE_READ_H

#include "base/image.h"

#ifdef __cplusplus
extern "C"
#endif
    /* As RGBA, missing alpha 1: bytes for formats of 8 bits, floats for all others. */
    bool
    image_read(Image *image, const char *path);

#endif
