/*
 * half_blocks: small pictures on a terminal, two pixels a character: its upper half has the colour
 * of the foreground, its lower half that of the background.
 */
#ifndef HALF_BLOCKS_H
#define HALF_BLOCKS_H

#include "base/image.h"

#include <stdio.h>

/* The columns of the terminal that a file goes to; 0 where no pictures are to be shown: it goes to
 * no terminal, to one of less than 60 columns, or message_color has no colours for it. */
int half_blocks_columns(FILE *file);

/* Of an image of bytes, in a part (x, y, width, height) that shows differences, as so many columns
 * and rows: the rows 2 line and 2 line + 1, blank where there are none. Each pixel is the lightest
 * that it stands for, the largest difference, so that lines do not vanish. In 24 bits if COLORTERM
 * says so, otherwise in one of 256 colours, of whose channels none is off by more than 48. */
void half_blocks_put(const Image *image, const int part[4], const int size[2], int line,
                     FILE *file);

#endif
