/*
 * font: a TrueType font's file, as stb_truetype reads it.
 *
 * stb_truetype does not validate a font's tables. Only the table directory is checked here, so that
 * a truncated file is refused; otherwise the font is trusted.
 */
#ifndef FONT_H
#define FONT_H

#include "base/message.h"

#include <stb/stb_truetype.h>

#include <stddef.h>

typedef struct Font {
    stbtt_fontinfo info;
    unsigned char *file; /* mapped: a label touches few of its pages */
    size_t size;
} Font;

/* The message of a font that cannot be read names the package to install. */
bool font_open(Font *font, const char *path, const char *package, Message *message);
void font_close(Font *font); /* a zeroed font is fine */

/* The next code point of UTF-8 text; U+FFFD for a malformed sequence. */
int font_character(const char **text);

#endif
