/*
 * image_gif: an animated GIF, through OpenImageIO.
 *
 * The format has 256 colours for each picture, and delays of whole hundredths of a second. Here
 * they differ from picture to picture, so that picture i stands from i / fps seconds on to the
 * nearest hundredth, and no error adds up.
 */
#ifndef IMAGE_GIF_H
#define IMAGE_GIF_H

#include "image.h"

/* Pictures a second: a delay has 16 bits, and none is 0, of which each viewer makes its own. */
#define IMAGE_GIF_SLOWEST (100.0 / 65535)
#define IMAGE_GIF_FASTEST 100.0

typedef struct ImageGif ImageGif;

/* Bytes without alpha, to an open file that can be read and sought in; the GIF repeats without end.
 * image_gif_close ends it, after a failure too, and NULL is fine. */
bool image_gif_open(ImageGif **gif, int file, int width, int height, int count, double fps,
                    Message *message);
bool image_gif_add(ImageGif *gif, const Image *image, Message *message);
bool image_gif_close(ImageGif *gif, Message *message);

#endif
