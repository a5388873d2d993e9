/*
 * page: lays out and paints a lesson: two pictures, their difference, and below them the lines that
 * changed.
 */
#ifndef PAGE_H
#define PAGE_H

#include "base/image.h"
#include "lessons/changes.h"

enum { PAGE_BEFORE, PAGE_AFTER, PAGE_DIFFERENCE, PAGE_PICTURES };

/* Where the parts of a page of a size are, in pixels: a title, three squares in a row with their
 * names above and a line below, and then the changed lines. */
typedef struct PageLayout {
    int side, left[PAGE_PICTURES], top;
    int margin, letters; /* of captions: 1/40 of the height in a page of 4:3 */
    int text_top;
} PageLayout;
PageLayout page_layout(int width, int height);

/* Paints the page's background and the changed lines in columns, as large as they all fit; if even
 * small letters are too large, lines end in ... and the last says how many are missing. */
bool page_paint_lines(Image *page, const Changes *changes, bool light, Message *message);

/* Paints a picture of the layout's side and its name. */
bool page_paint_picture(Image *page, int number, const Image *picture, const char *name, bool light,
                        Message *message);

/* Paints the page's title and the line below the pictures. */
bool page_paint_captions(Image *page, const char *title, const char *below, bool light,
                         Message *message);

/* The absolute difference of two pictures of one size, color by color, `factor` times as large so
 * that it is seen; its largest value, and in how many pixels there is one. What decides the factor
 * is `inside`, the largest value in pixels that are opaque in both pictures, if there is one: where
 * outlines do not match, an object is compared with the background, and larger values are cut. */
typedef struct PageDifference {
    int largest, inside, pixels, factor;
} PageDifference;
PageDifference page_difference(const Image *before, const Image *after, Image *difference);

#endif
