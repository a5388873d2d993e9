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

/* A color over the pixel's, which is not multiplied by its alpha. */
static void blend(unsigned char *pixel, const unsigned char color[3], int coverage)
{
    const int rest = pixel[3] * (255 - coverage), alpha = 255 * coverage + rest;
    for (int c = 0; c < 3; c++)
        pixel[c] =
            (unsigned char)((255 * color[c] * coverage + pixel[c] * rest + alpha / 2) / alpha);
    pixel[3] = (unsigned char)((alpha + 127) / 255);
}

static void draw_coverage(Image *image, const Ink *ink, const unsigned char *coverage, int left,
                          int top, int width, int height)
{
    for (int row = 0; row < height; row++) {
        for (int column = 0; column < width; column++, coverage++) {
            const int x = left + column, y = top + row;
            if (*coverage && x >= 0 && y >= 0 && x < image->width && y < image->height)
                blend((unsigned char *)image->pixels + (size_t)y * image_row_size(image) +
                          4 * (size_t)x,
                      ink->color, *coverage);
        }
    }
}

/* A text's scale, in pixels per font unit. */
typedef struct Scale {
    float x, y;
} Scale;

/* Rounds the height of small letters to whole pixels, so that their upper edges are sharp as their
 * baseline is. Without it text of 12 pixels looks blurred. */
static Scale scale_of(const stbtt_fontinfo *font, int size)
{
    const float scale = stbtt_ScaleForMappingEmToPixels(font, (float)size);
    int left, bottom, right, top;
    if (!stbtt_GetCodepointBox(font, 'x', &left, &bottom, &right, &top) || (float)top * scale < 1)
        return (Scale){scale, scale};
    return (Scale){scale, roundf(scale * (float)top) / (float)top};
}

/* Where a text's ink begins and ends, in pixels. */
typedef struct Extent {
    float left, right;
} Extent;

static bool draw_glyph(const stbtt_fontinfo *font, Scale scale, int glyph, float pen, int baseline,
                       const Ink *ink, Image *image, Message *message)
{
    const float column = floorf(pen);
    int width = 0, height = 0, left, top;
    unsigned char *coverage = stbtt_GetGlyphBitmapSubpixel(font, scale.x, scale.y, pen - column, 0,
                                                           glyph, &width, &height, &left, &top);
    if (!coverage && width && height)
        return message_set(message, "label: not enough memory");
    for (int y = -ink->spread; coverage && y <= ink->spread; y++)
        for (int x = -ink->spread; x <= ink->spread; x++)
            draw_coverage(image, ink, coverage, (int)column + left + x, baseline + top + y, width,
                          height);
    stbtt_FreeBitmap(coverage, NULL);
    return true;
}

/* Measures the ink and, unless `image` is NULL, draws it. */
static bool set_text(const stbtt_fontinfo *font, Scale scale, const char *text, float start,
                     int baseline, const Ink *ink, Image *image, Extent *extent, Message *message)
{
    float pen = start;
    *extent = (Extent){INFINITY, -INFINITY};
    for (int glyph, before = 0; *text; before = glyph) {
        const int code = font_character(&text);
        int advance, bearing, left, bottom, right, top;
        glyph = stbtt_FindGlyphIndex(font, code < ' ' ? ' ' : code);
        if (before)
            pen += scale.x * (float)stbtt_GetGlyphKernAdvance(font, before, glyph);
        if (stbtt_GetGlyphBox(font, glyph, &left, &bottom, &right, &top)) {
            const Extent own = {pen + scale.x * (float)left, pen + scale.x * (float)right};
            *extent = (Extent){fminf(extent->left, own.left), fmaxf(extent->right, own.right)};
            if (image && own.right > 0 && own.left < (float)image->width &&
                !draw_glyph(font, scale, glyph, pen, baseline, ink, image, message))
                return false;
        }
        stbtt_GetGlyphHMetrics(font, glyph, &advance, &bearing);
        pen += scale.x * (float)advance;
    }
    return true;
}

/* Centred on x. */
static bool set_centred(const Font *font, int size, const char *text, int x, int y, const Ink *ink,
                        Image *image, Message *message)
{
    const Scale scale = scale_of(&font->info, size);
    Extent extent;
    if (!set_text(&font->info, scale, text, 0, y, NULL, NULL, &extent, message))
        return false;
    return extent.left >= extent.right ||
           set_text(&font->info, scale, text, (float)x - (extent.left + extent.right) / 2, y, ink,
                    image, &extent, message);
}

bool image_label(Image *image, int x, int y, int size, const char *text, Message *message)
{
    Font font;
    if (!open_font(&font, false, message))
        return false;
    const bool done = set_centred(&font, size, text, x, y, &WHITE, image, message);
    font_close(&font);
    return done;
}

bool image_text(Image *image, int x, int y, const TextStyle *style, const char *text,
                Message *message)
{
    const Ink ink = {.color = {style->color[0], style->color[1], style->color[2]}};
    Extent extent;
    Font font;
    if (!open_font(&font, style->mono, message))
        return false;
    const bool done = set_text(&font.info, scale_of(&font.info, style->size), text, (float)x, y,
                               &ink, image, &extent, message);
    font_close(&font);
    return done;
}

enum { MOST_LINES = 8, CAPTION_SIZE = 256 };

static bool fits(const stbtt_fontinfo *font, Scale scale, const char *line, int width)
{
    Extent ink;
    return set_text(font, scale, line, 0, 0, NULL, NULL, &ink, NULL) &&
           ink.right - ink.left <= (float)width;
}

/* Ends lines at blanks of the text. 0: a word is too wide, or there are too many lines. */
static int break_lines(const stbtt_fontinfo *font, Scale scale, char *text, int width,
                       const char *lines[MOST_LINES])
{
    int count = 1;
    char *blank = NULL; /* where this line could end */
    lines[0] = text;
    for (char *at = text;; at++) {
        const char end = *at;
        if (end != ' ' && end)
            continue;
        *at = '\0';
        if (!fits(font, scale, lines[count - 1], width)) {
            if (!blank || count == MOST_LINES || !fits(font, scale, blank + 1, width))
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
    const int count =
        break_lines(&font->info, scale_of(&font->info, size), copy, place[2] - 4, lines);
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
    bool done = true;
    for (int i = 0; i < 2 * count && done; i++) { /* all edges, then all letters */
        const int line = i % count;
        done = set_centred(&font, size, lines[line], place[0] + place[2] / 2,
                           place[1] + place[3] - size / 2 - (count - 1 - line) * (size + 2),
                           i < count ? &EDGE : &WHITE, image, message);
    }
    font_close(&font);
    return done;
}
