/*
 * png_copy: a picture that somebody else wrote, as far as it is one.
 */
#ifndef PNG_COPY_H
#define PNG_COPY_H

#include "message.h"

#include <stddef.h>

enum { PNG_COPY_SIDE_MOST = 2048 }; /* pixels */

/* Keeps of a PNG file what makes the picture, in place: header, pixels, end, and nothing else that
 * such a file can hold. Refused: what is not PNG (its section 5: signature, chunks with correct
 * sums, the header first, the end last), other than 8-bit RGB or RGBA, not interlaced, larger than
 * PNG_COPY_SIDE_MOST either way. The pixels are not unpacked. */
bool png_copy(unsigned char *bytes, size_t *size, Message *message);

#endif
