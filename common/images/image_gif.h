/*
 * image_gif: animated GIF files, written by OpenImageIO.
 *
 * The format has 256 colors per picture and delays in hundredths of a second. Delays vary so that
 * picture i starts at i / fps to the nearest hundredth, without accumulating error.
 */
#ifndef IMAGE_GIF_H
#define IMAGE_GIF_H

#include "images/image_options.h"

/* Pictures per second: a delay has 16 bits, and is not 0, which viewers interpret differently. */
#define IMAGE_GIF_SLOWEST (100.0 / 65535)
#define IMAGE_GIF_FASTEST 100.0

typedef struct ImageGif ImageGif;

/* Writes byte images without alpha to an open file that supports reading and seeking; the GIF loops
 * forever. image_gif_close is called after a failure too; NULL is fine. */
bool image_gif_open(ImageGif **gif, int file, const GifOptions *options, Message *message);
bool image_gif_add(ImageGif *gif, const Image *image, Message *message);
/* Sets the times of a complete GIF with as many pictures; its delays were any. */
bool image_gif_set_times(int file, const GifOptions *options, Message *message);

bool image_gif_close(ImageGif *gif, Message *message);

#endif
