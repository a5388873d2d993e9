/*
 * text: characters, words, lines and comments of texts.
 */
#ifndef TEXT_H
#define TEXT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Whether a character can be part of a name in C or GLSL: a letter, a digit or an underscore. */
static inline bool text_is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* The bytes of the UTF-8 character (RFC 3629) that a text begins with; 0: it begins with none. */
int text_character(const char *text);

/* How often a word is in a text. */
int text_count_word(const char *text, const char *word);

/* U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069 and U+061C turn the direction of what follows
 * (Unicode Standard Annex 9), so that a line would read otherwise. */
bool text_turns_direction(const char *text);

/* Whether a line quotes a source line, as messages do: "  3 | ...". */
bool text_is_quote(const char *line);

/* The end of the comment, of C or GLSL, that begins a text: at the line feed after //, else after
 * its end, or at the end of the text. NULL: no comment begins here. */
const char *text_comment_end(const char *text);

/* In place, leaves out what is in parentheses, the innermost first, then words at the end, until it
 * has at most so many bytes: "dot(texture2D(...).rgb, vec3(...))". */
void text_shorten(char *text, size_t most);

/* The number of a text among others, which end with NULL; -1: it is none of them, or NULL. */
int text_among(const char *text, const char *const *texts);

/* FNV-1a of 32 bits. */
uint32_t text_hash(const void *bytes, size_t size);

/* In place, makes each comment a blank. */
void text_strip_comments(char *text);

/* The whole numbers at the #s of `form`, if a text begins as that says, as "12:3" does of "#:#";
 * and how many characters that is. 0: it does not begin so. */
int text_numbers(const char *text, const char *form, int *numbers);

/* What strtod reads, sooner where it is a few digits. */
double text_decimal(const char *text, char **end);

/* Writes a paragraph in lines of as many words as fit, at least one. Breaks at blanks, which are
 * not counted, after bars, and at line feeds. It begins in `column`, other lines after `indent`
 * blanks; `width` counts both. Ends without a line feed; returns the column it ends in. */
int text_wrap(FILE *file, const char *text, int column, int indent, int width);

/* The name that `word` was probably meant to be: the only one that begins so, or the nearest, if at
 * most a third of the word's letters differ. Case does not count. NULL: none. `names` ends with
 * NULL. */
const char *text_nearest(const char *word, const char *const *names);

#endif
