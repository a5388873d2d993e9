/*
 * options_table: the rows of which a program's table of options is made.
 */
#ifndef OPTIONS_TABLE_H
#define OPTIONS_TABLE_H

#include "app/options.h"

#include <stddef.h>

/* Which programs have an option; what else is to be known of it. */
enum {
    PROGRAM_ONE = 1, /* draws one example with OpenGL */
    PROGRAM_DIAGRAM = 2,
    PROGRAM_GALLERY = 4,
    PROGRAM_STUDY = 8,
    NOT_DIAGRAM = 16, /* refused by a diagram, with a message */
    NOT_GALLERY = 32, /* refused by a gallery */
    ASIDE = 64,       /* does not change the picture or its destination, or as another does */
};

/* Rows are constants: `value` and `given` are places in Options, which options_table replaces by
 * addresses in those that it is given. */
#define AT(field) .value = (void *)offsetof(Options, field)
#define GIVEN_AT(field) .given = (bool *)offsetof(Options, field)

/* Values that are of no ParameterKind. */
extern const ParameterCodec OPTION_SIZE, OPTION_ANGLE, OPTION_ORBIT, OPTION_PART, OPTION_BACKEND,
    OPTION_WINDOW, OPTION_PRINT, OPTION_PROBE;

/* Appends numbers in the fewest digits, with commas between them. False if they do not fit. */
bool option_put_numbers(char *text, size_t size, const double *numbers, int count);

#endif
