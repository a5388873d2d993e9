/*
 * parameter: what can be changed about an example, besides what is the same for all: an option
 * --NAME VALUE of its program, with a range and a default.
 */
#ifndef PARAMETER_H
#define PARAMETER_H

#include "matrix.h"
#include "message.h"

#include <stddef.h>
#include <stdio.h>

typedef enum ParameterKind {
    PARAMETER_NUMBER, /* double */
    PARAMETER_WHOLE,  /* int */
    PARAMETER_CHOICE, /* int: the number of one of `choices` */
    PARAMETER_SWITCH, /* bool: "on" or "off" */
    PARAMETER_FLAG,   /* bool: --NAME alone makes it true */
    PARAMETER_COLOR,  /* Vec3: "R,G,B", each least..most, or one number for grey */
    PARAMETER_TEXT,   /* const char *: any text, a file's name */
} ParameterKind;

typedef struct Parameter {
    const char *name; /* of the option; NULL ends a list */
    const char *help; /* what it is, in a few words, with its unit */
    ParameterKind kind;
    void *value;                /* the example's variable, which holds the default */
    double least, most;         /* of numbers and colours */
    const char *const *choices; /* NULL-terminated */
} Parameter;

/* Sets a parameter from the command line; `text` does not count for a flag. The message names it
 * and its range, or for a choice the nearest of those there are. */
bool parameter_read(const Parameter *parameter, const char *text, Message *message);

/* The value of a parameter, apart from it. */
typedef union ParameterValue {
    double number;
    int whole; /* a choice too */
    bool on;   /* a switch, a flag */
    Vec3 color;
    const char *text; /* not a copy of it */
} ParameterValue;

ParameterValue parameter_save(const Parameter *parameter);
void parameter_restore(const Parameter *parameter, ParameterValue value);
bool parameter_equal(const Parameter *parameter, const ParameterValue *value);

/* Writes the value as the command line takes it, in the fewest digits from which parameter_read
 * makes the very same value; for a flag nothing, for its name alone makes it true. False, and an
 * empty text, where the option is to be left out: a flag that is false, a text that is NULL, a
 * number that is infinite or none; and where `size` is too small: PARAMETER_TEXT_SIZE is enough for
 * all but a text. */
enum { PARAMETER_TEXT_SIZE = 128 };
bool parameter_write(const Parameter *parameter, char *text, size_t size);

/* Writes the parameter's lines of --help: name, range, meaning, default. */
void parameter_help(const Parameter *parameter, FILE *file);

#endif
