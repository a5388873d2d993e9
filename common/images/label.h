/*
 * label: text in a picture, rasterized by stb_truetype from DejaVu Sans.
 */
#ifndef LABEL_H
#define LABEL_H

#include "base/image.h"

/* Draws UTF-8 text into a byte image: white, antialiased, kerned, `size` pixels per em, its
 * baseline on row y's upper edge, its ink centred on column x's left edge, clipped at the border.
 * Control characters are spaces; a character that the font lacks is a box. False if the font cannot
 * be read: the file named by LIGHTING_FONT in the environment, or Debian's fonts-dejavu-core. */
bool image_label(Image *image, int x, int y, int size, const char *text, Message *message);

/* The same at the bottom of a rectangle (x, y, width, height), broken at blanks into lines that
 * leave two thirds of its height; nothing if they do not fit. */
bool image_caption(Image *image, const int place[4], int size, const char *text, Message *message);

/* Lowers `size` to the largest at which such a caption fits; 0: to none that can be read. */
bool image_caption_size(const int place[4], const char *text, int *size, Message *message);

#endif
