/*
 * image_png: PNG files, written by libpng.
 */
#ifndef IMAGE_PNG_H
#define IMAGE_PNG_H

#include "images/image_options.h"

/* As image_encode. */
bool image_png_encode(const Image *image, const ImageOptions *options, ImageFile *file,
                      Message *message);

const char *image_png_version(void);

#endif
