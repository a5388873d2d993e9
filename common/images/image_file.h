/*
 * image_file: encodes and writes images.
 *
 * PNG is written by libpng. All other formats are written by OpenImageIO, through a plugin that is
 * loaded at the first use because the library loads hundreds of others and starts slower than a
 * picture is drawn. Without the plugin those formats fail with a message that names the package.
 */
#ifndef IMAGE_FILE_H
#define IMAGE_FILE_H

#include "images/image_options.h"

void image_file_close(ImageFile *file); /* NULL or zeroed is fine */

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

/* Loads the plugin and appends its line for --doctor; true if it was found. */
bool image_probe(Message *findings);

#endif
