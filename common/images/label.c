/*
 * Text as pixels. A glyph's outline is rasterized at the size wanted, to coverage: how much of each
 * pixel lies within it, 0 to 255. The letter's color is then put over the picture's in that
 * proportion (Porter and Duff, Compositing digital images, SIGGRAPH 1984: "over"). Glyphs begin
 * anywhere between two pixels, as the widths before them and the kerning say; the baseline lies on
 * a pixel's edge, and the font's scale in height is chosen so that the tops of small letters do
 * too. A text is measured before it is centred: the same function does both.
 */
#include "images/label.h"

#include "images/font.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FONT "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
#define MONO_FONT "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"

static bool open_font(Font *font, bool mono, Message *message)
{
    const char *path = getenv("LIGHTING_FONT");
    return font_open(font, path ? path : mono ? MONO_FONT : FONT, "fonts-dejavu-core", message);
}

/* How ink is put into the picture. */
typedef struct Ink {
    unsigned char color[3];
    int spread; /* pixels to all sides */
} Ink;

static const Ink WHITE = {.color = {255, 255, 255}}, EDGE = {.spread = 1};

/* A font in one size: pixels per font unit. */
typedef struct Type {
    const stbtt_fontinfo *font;
    float x, y;
} Type;

/* Rounds the height of small letters to whole pixels, so that their upper edges are sharp as their
 * baseline is. Without it text of 12 pixels looks blurred. */
static Type type_of(const Font *font, int size)
{
    const float scale = stbtt_ScaleForMappingEmToPixels(&font->info, (float)size);
    int left, bottom, right, top;
    if (!stbtt_GetCodepointBox(&font->info, 'x', &left, &bottom, &right, &top) ||
        (float)top * scale < 1)
        return (Type){&font->info, scale, scale};
    return (Type){&font->info, scale, roundf(scale * (float)top) / (float)top};
}

/* A color over the pixel's, which is not multiplied by its alpha. */
static void blend(unsigned char *pixel, const unsigned char color[3], int coverage)
{
    const int rest = pixel[3] * (255 - coverage), alpha = 255 * coverage + rest;
    for (int c = 0; c < 3; c++)
        pixel[c] =
            (unsigned char)((255 * color[c] * coverage + pixel[c] * rest + alpha / 2) / alpha);
    pixel[3] = (unsigned char)((alpha + 127) / 255);
}

/* A rasterized glyph, and where it lies in the picture. */
typedef struct Coverage {
    unsigned char *bytes;
    int left, top, width, height;
} Coverage;

static void draw_coverage(Image *image, const unsigned char color[3], const Coverage *glyph,
                          int right, int down)
{
    const unsigned char *coverage = glyph->bytes;
    for (int row = 0; row < glyph->height; row++)
        for (int column = 0; column < glyph->width; column++, coverage++) {
            const int x = glyph->left + right + column, y = glyph->top + down + row;
            if (*coverage && x >= 0 && y >= 0 && x < image->width && y < image->height)
                blend((unsigned char *)image->pixels + (size_t)y * image_row_size(image) +
                          4 * (size_t)x,
                      color, *coverage);
        }
}

/* Where glyphs are drawn. */
typedef struct Page {
    Image *image;
    const Ink *ink;
    int baseline;
} Page;

static void draw_glyph(const Page *page, Type type, int glyph, float pen)
{
    const float column = floorf(pen);
    Coverage at = {.left = 0};
    at.bytes = stbtt_GetGlyphBitmapSubpixel(type.font, type.x, type.y, pen - column, 0, glyph,
                                            &at.width, &at.height, &at.left, &at.top);
    at.left += (int)column;
    at.top += page->baseline;
    const int spread = page->ink->spread;
    for (int y = -spread; at.bytes && y <= spread; y++)
        for (int x = -spread; x <= spread; x++)
            draw_coverage(page->image, page->ink->color, &at, x, y);
    stbtt_FreeBitmap(at.bytes, NULL);
}

/* Where a text's ink begins and ends, in pixels. */
typedef struct Extent {
    float left, right;
} Extent;

/* Measures the ink of a text that begins at `pen` and, unless `page` is NULL, draws it. */
static Extent set_text(Type type, const char *text, float pen, const Page *page)
{
    Extent all = {INFINITY, -INFINITY};
    for (int glyph, before = 0; *text; before = glyph) {
        const int code = font_character(&text);
        int advance, bearing, left, bottom, right, top;
        glyph = stbtt_FindGlyphIndex(type.font, code < ' ' ? ' ' : code);
        if (before)
            pen += type.x * (float)stbtt_GetGlyphKernAdvance(type.font, before, glyph);
        if (stbtt_GetGlyphBox(type.font, glyph, &left, &bottom, &right, &top)) {
            const Extent own = {pen + type.x * (float)left, pen + type.x * (float)right};
            all = (Extent){fminf(all.left, own.left), fmaxf(all.right, own.right)};
            if (page && own.right > 0 && own.left < (float)page->image->width)
                draw_glyph(page, type, glyph, pen);
        }
        stbtt_GetGlyphHMetrics(type.font, glyph, &advance, &bearing);
        pen += type.x * (float)advance;
    }
    return all;
}

static void set_centred(Type type, const char *text, int x, const Page *page)
{
    const Extent extent = set_text(type, text, 0, NULL);
    if (extent.left < extent.right)
        set_text(type, text, (float)x - (extent.left + extent.right) / 2, page);
}

bool image_label(Image *image, int x, int y, int size, const char *text, Message *message)
{
    Font font;
    if (!open_font(&font, false, message))
        return false;
    set_centred(type_of(&font, size), text, x, &(Page){image, &WHITE, y});
    font_close(&font);
    return true;
}

bool image_text(Image *image, int x, int y, const TextStyle *style, const char *text,
                Message *message)
{
    const Ink ink = {.color = {style->color[0], style->color[1], style->color[2]}};
    Font font;
    if (!open_font(&font, style->mono, message))
        return false;
    set_text(type_of(&font, style->size), text, (float)x, &(Page){image, &ink, y});
    font_close(&font);
    return true;
}

enum { MOST_LINES = 8, CAPTION_SIZE = 256 };

static bool fits(Type type, const char *line, int width)
{
    const Extent ink = set_text(type, line, 0, NULL);
    return ink.right - ink.left <= (float)width;
}

/* Ends lines at blanks of the text. 0: a word is too wide, or there are too many lines. */
static int break_lines(Type type, char *text, int width, const char *lines[MOST_LINES])
{
    int count = 1;
    char *blank = NULL; /* where this line could end */
    lines[0] = text;
    for (char *at = text;; at++) {
        const char end = *at;
        if (end != ' ' && end)
            continue;
        *at = '\0';
        if (!fits(type, lines[count - 1], width)) {
            if (!blank || count == MOST_LINES || !fits(type, blank + 1, width))
                return 0;
            *blank = '\0';
            lines[count++] = blank + 1;
        }
        if (!end)
            return count;
        *at = ' ';
        blank = at;
    }
}

/* 0: it does not fit. */
static int caption_lines(const Font *font, const int place[4], int size, const char *text,
                         char copy[CAPTION_SIZE], const char *lines[MOST_LINES])
{
    snprintf(copy, CAPTION_SIZE, "%s", text);
    const int count = break_lines(type_of(font, size), copy, place[2] - 4, lines);
    return 3 * count * (size + 2) <= place[3] ? count : 0;
}

bool image_caption_size(const int place[4], const char *text, int *size, Message *message)
{
    enum { SMALLEST = 7 };
    const char *lines[MOST_LINES];
    char copy[CAPTION_SIZE];
    Font font;
    if (!open_font(&font, false, message))
        return false;
    while (*size >= SMALLEST && !caption_lines(&font, place, *size, text, copy, lines))
        --*size;
    font_close(&font);
    *size = *size < SMALLEST ? 0 : *size;
    return true;
}

bool image_caption(Image *image, const int place[4], int size, const char *text, Message *message)
{
    const char *lines[MOST_LINES];
    char copy[CAPTION_SIZE];
    Font font;
    if (!open_font(&font, false, message))
        return false;
    const int count = caption_lines(&font, place, size, text, copy, lines);
    for (int i = 0; i < 2 * count; i++) { /* all edges, then all letters */
        const int line = i % count;
        const int baseline = place[1] + place[3] - size / 2 - (count - 1 - line) * (size + 2);
        set_centred(type_of(&font, size), lines[line], place[0] + place[2] / 2,
                    &(Page){image, i < count ? &EDGE : &WHITE, baseline});
    }
    font_close(&font);
    return true;
}
