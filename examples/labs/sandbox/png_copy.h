/*
 * png_copy: checks and strips a PNG file from an untrusted source.
 */
#ifndef PNG_COPY_H
#define PNG_COPY_H

#include "base/message.h"

#include <stddef.h>

enum { PNG_COPY_SIDE_MAX = 2048 }; /* pixels */

/* Keeps only header, pixels and end of a PNG file, in place. Refused: anything but a valid PNG
 * (section 5 of its specification: signature, chunks with correct sums, the header first, the end
 * last) of 8-bit RGB or RGBA, not interlaced, of at most PNG_COPY_SIDE_MAX either way. Pixels are
 * not unpacked. */
bool png_copy(unsigned char *bytes, size_t *size, Message *message);

#endif
