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

/* How image_text draws. */
typedef struct TextStyle {
    int size; /* pixels per em */
    bool mono;
    unsigned char color[3];
} TextStyle;

/* The same, but from column x on, in a colour; `mono`: in DejaVu Sans Mono, unless LIGHTING_FONT
 * names another font. */
bool image_text(Image *image, int x, int y, const TextStyle *style, const char *text,
                Message *message);

/* How wide letters of DejaVu Sans Mono are, in em. */
#define IMAGE_MONO_ADVANCE 0.602

/* As image_label, with a dark edge that keeps it apart from what is bright, at the bottom of a
 * rectangle (x, y, width, height), broken at blanks into lines that leave two thirds of its height;
 * nothing if they do not fit. */
bool image_caption(Image *image, const int place[4], int size, const char *text, Message *message);

/* Lowers `size` to the largest at which such a caption fits; 0: to none that can be read. */
bool image_caption_size(const int place[4], const char *text, int *size, Message *message);

#endif
