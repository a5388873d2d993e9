/*
 * image: pixels in memory, to a file and back.
 *
 * PNG is written through libpng. Every other format, and all reading and comparing, goes through
 * OpenImageIO, in a module that is loaded at the first need: the library brings hundreds of others
 * and costs more than a whole picture. Where the module or the library is missing, those functions
 * fail and name the package.
 */
#ifndef IMAGE_H
#define IMAGE_H

#include "message.h"

#include <stddef.h>

typedef enum ImageType {
    IMAGE_BYTE,  /* unsigned char, 0..255 stands for 0..1 */
    IMAGE_FLOAT, /* float, not clamped */
} ImageType;

/* RGBA, row 0 at the top, rows without padding. Colours are not multiplied by alpha. */
typedef struct Image {
    int width, height;
    ImageType type;
    void *pixels; /* width * height * 4 unsigned char or float */
} Image;

/* Opens a zeroed image. The pixels are the caller's to write. */
bool image_open(Image *image, int width, int height, ImageType type, Message *message);
void image_close(Image *image);
size_t image_row_size(const Image *image); /* in bytes */

/* One text chunk of a PNG file, or attribute of another. NULL key: the end of a list. */
typedef struct ImageText {
    const char *key;  /* Latin-1, 1 to 79 characters: "Software", "Time" */
    const char *text; /* UTF-8 */
} ImageText;

typedef struct ImageOptions {
    int compress;          /* PNG: 0 (none, largest) to 9 (slowest, smallest), or the default */
    bool alpha;            /* keep the alpha channel; else the picture is opaque and has none */
    const ImageText *text; /* ended by a NULL key; may be NULL */
} ImageOptions;

/* For pictures that are written often: with one fixed filter, zlib's level 3, or 4 where colours
 * are flat and level 3 is wasteful. A fifth to a quarter of the time of libpng's defaults, for 1.1
 * to 1.8 times their size on this chapter's pictures. */
enum { IMAGE_COMPRESS_DEFAULT = -1 };

/* Bytes of an encoded file. */
typedef struct ImageFile {
    unsigned char *bytes;
    size_t size, capacity;
} ImageFile;
void image_file_close(ImageFile *file);

/* The format that a path's extension names, in lower case ("png", "exr"), in `format`; PNG for "-"
 * and for what lies below /dev and /proc. False, with a message, where there is no extension, or
 * none that this installation writes. */
bool image_format(const char *path, char format[16], Message *message);

/* Whether a format holds floats, so that it is worth drawing them ("exr", "hdr", "tif"...). */
bool image_format_is_float(const char *format);

/* Whether a format keeps an alpha channel. */
bool image_format_has_alpha(const char *format);

/* Encodes to memory. A float image goes to an integer format clamped to 0..1 and rounded. */
bool image_encode(const Image *image, const char *format, const ImageOptions *options,
                  ImageFile *file, Message *message);

/* image_format, image_encode and output_write in one: the file is written whole or not at all. */
bool image_write(const Image *image, const char *path, const ImageOptions *options,
                 Message *message);

/* Reads a picture as RGBA (grey is spread, missing alpha is 1): bytes for 8-bit formats, floats for
 * all others. */
bool image_read(Image *image, const char *path, Message *message);

/* How far two pictures of one size and type lie apart, in steps of 1/255, over red, green, blue. */
typedef struct ImageDifference {
    double rms, maximum;
    int x, y;            /* where the maximum is */
    long long differing; /* pixels with any difference */
} ImageDifference;
bool image_compare(const Image *a, const Image *b, ImageDifference *difference, Message *message);

/* |a - b| * gain, opaque, as bytes: the picture of a difference. */
bool image_difference(const Image *a, const Image *b, double gain, Image *difference,
                      Message *message);

/* Writes one line of text into a byte image: white, `size` pixels high, its baseline at y, centred
 * on x. False where the installation has no font. */
bool image_label(Image *image, int x, int y, int size, const char *text, Message *message);

/* For --doctor: loads the module and says on standard output what it found. */
bool image_doctor(void);

#endif
