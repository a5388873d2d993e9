/*
 * place: where in a shader's files something of its text is.
 */
#ifndef PLACE_H
#define PLACE_H

#include "glsl/glsl.h"

enum { PLACE_TEXT = 100 };

/* "line 15", or of one of several files "common.glsl:15". Each file's first line says its name, as
 * a comment; if it does not: "file 2, line 15". */
void place_name(const char *source, GlslPlace place, char name[PLACE_TEXT]);

/* The line, without blanks around it and comments; with "..." if it is longer. */
void place_line(const char *source, GlslPlace place, char text[PLACE_TEXT]);

#endif
