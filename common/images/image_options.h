/*
 * image_options: what encoders of images are given and make.
 */
#ifndef IMAGE_OPTIONS_H
#define IMAGE_OPTIONS_H

#include "base/image.h"

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

/* An animated GIF of `count` pictures. */
typedef struct GifOptions {
    int width, height, count;
    double fps; /* pictures per second */
} GifOptions;

#endif
