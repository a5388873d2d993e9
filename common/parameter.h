/*
 * parameter: what can be changed about an example, besides what is the same for all: an option
 * --NAME VALUE of its program, with a range and a default.
 */
#ifndef PARAMETER_H
#define PARAMETER_H

#include "message.h"

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

/* Writes the parameter's lines of --help: name, range, meaning, default. */
void parameter_help(const Parameter *parameter, FILE *file);

#endif
