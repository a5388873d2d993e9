/*
 * image_options: what encoders of images are given and make.
 */
#ifndef IMAGE_OPTIONS_H
#define IMAGE_OPTIONS_H

#include "base/image.h"

#include <stdio.h>

/* A text chunk of a PNG file, or an attribute of another format. NULL key: the end of a list. */
typedef struct ImageText {
    const char *key;  /* Latin-1, 1 to 79 characters: "Software", "Time" */
    const char *text; /* UTF-8 */
} ImageText;

typedef struct ImageOptions {
    int compress;          /* PNG: 0 (none) to 9 (slowest, smallest), or IMAGE_COMPRESS_DEFAULT */
    bool alpha;            /* false: the file has no alpha channel */
    const ImageText *text; /* ended by a NULL key; may be NULL */
} ImageOptions;

/* For pictures that are written often: one fixed filter and zlib's level 3, with run-length matches
 * only if colors are flat. Takes a fifth to a quarter of the time of libpng's defaults, for 1.1 to
 * 1.8 times the size on this chapter's pictures. */
enum { IMAGE_COMPRESS_DEFAULT = -1 };

/* An encoded file. */
typedef struct ImageFile {
    unsigned char *bytes;
    size_t size;
} ImageFile;

/* PNG files, written by libpng. */

/* As image_encode. */
bool image_png_encode(const Image *image, const ImageOptions *options, ImageFile *file,
                      Message *message);

const char *image_png_version(void);

/* Animated GIF files.
 *
 * The format has 256 colors per picture and delays in hundredths of a second. Delays vary so
 * that picture i starts at i / fps to the nearest hundredth, without accumulating error. */

/* Pictures per second: a delay has 16 bits, and is not 0, which viewers interpret differently. */
#define IMAGE_GIF_SLOWEST (100.0 / 65535)
#define IMAGE_GIF_FASTEST 100.0

typedef struct ImageGif ImageGif;

/* Writes byte images without alpha to a file, `fps` of them per second; the GIF loops forever.
 * image_gif_close closes the file, and is called after a failure too; NULL is fine. */
bool image_gif_open(ImageGif **gif, FILE *file, int width, int height, double fps,
                    Message *message);
bool image_gif_add(ImageGif *gif, const Image *image, Message *message);
bool image_gif_close(ImageGif *gif, Message *message);

#endif
