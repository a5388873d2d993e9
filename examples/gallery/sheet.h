/*
 * sheet: the contact sheet of a gallery, thumbnails in rows with labels below.
 */
#ifndef SHEET_H
#define SHEET_H

#include "base/image.h"
#include "core/example.h"

bool sheet_open(Image *sheet, int count, Message *message);

/* Places the thumbnail of picture `index`, of bytes. */
void sheet_put(Image *sheet, int index, const Image *image);

/* A sheet without a font is complete but for its labels; then says so on standard error. */
void sheet_label(Image *sheet, const Example *const *examples, int count);

#endif
