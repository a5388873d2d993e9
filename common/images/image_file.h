/*
 * image_file: encodes and writes images.
 *
 * PNG is written by libpng. All other formats are written by OpenImageIO, through a plugin that is
 * loaded at the first use because the library loads hundreds of others and starts slower than a
 * picture is drawn. Without the plugin those formats fail with a message that names the package.
 */
#ifndef IMAGE_FILE_H
#define IMAGE_FILE_H

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
void image_file_close(ImageFile *file);

/* A whole file of any kind. */
bool image_file_read(ImageFile *file, const char *path, Message *message);

/* The format that a path's extension names, in lower case ("png", "exr"); PNG for "-" and for paths
 * below /dev and /proc. False if there is no extension or an unknown one. */
bool image_format(const char *path, char format[16], Message *message);

/* The names of the formats, "png", "exr"; at most `max`. Returns their number. */
int image_format_names(const char *names[], int max);

/* Whether a format holds floats ("exr", "hdr", "tif"), so that a float canvas is worthwhile. */
bool image_format_is_float(const char *format);

bool image_format_has_alpha(const char *format);

/* Encodes to memory. Integer formats clamp floats to 0..1 and round them. */
bool image_encode(const Image *image, const char *format, const ImageOptions *options,
                  ImageFile *file, Message *message);

/* image_format, image_encode and output_write: the file is written whole or not at all. */
bool image_write(const Image *image, const char *path, const ImageOptions *options,
                 Message *message);

/* Loads the plugin and appends lines about what was found; true if the plugin was. */
bool image_probe(Message *findings);

#endif
