/*
 * parameter: a typed variable with a name, a range and a default, set by a command-line option
 * --NAME VALUE or by a control of the window's panel.
 */
#ifndef PARAMETER_H
#define PARAMETER_H

#include "base/message.h"
#include "core/matrix.h"

#include <stddef.h>

typedef enum ParameterKind {
    PARAMETER_NUMBER, /* double */
    PARAMETER_WHOLE,  /* int */
    PARAMETER_CHOICE, /* int: an index into `choices` */
    PARAMETER_SWITCH, /* bool: "on" or "off" */
    PARAMETER_FLAG,   /* bool: --NAME alone makes it true */
    PARAMETER_COLOR,  /* Vec3: "R,G,B", each min..max, or one number for grey; with a placeholder no
                         color but another vector */
    PARAMETER_TEXT,   /* const char *: any text, as a file's name */
} ParameterKind;

struct Parameter;

/* How a value is read and written that is of none of these kinds. */
typedef struct ParameterCodec {
    const char *placeholder; /* as in Parameter */
    bool (*read)(const struct Parameter *parameter, const char *text, Message *message);
    /* False if the value cannot be written. NULL: it is another option's. */
    bool (*write)(const struct Parameter *parameter, char *text, size_t size);
} ParameterCodec;

typedef struct Parameter {
    const char *name; /* of the option; NULL ends a list */
    const char *help; /* what it is, in a few words, with its unit; NULL: --help omits it */
    ParameterKind kind;
    void *value;     /* the variable, which holds the default */
    double min, max; /* of numbers and colours; of a text, min 1: not empty */
    /* NULL-terminated. Of a switch: the words for true and false; of a text: what it may be; of a
     * flag: what may follow, as in --NAME=CHOICE. */
    const char *const *choices;
    char letter;                 /* the short option; 0: none */
    const char *placeholder;     /* of the value in --help; NULL: the range or the kind */
    const char *standard;        /* the default in --help; NULL: as `value` has it; "": not shown */
    bool *given;                 /* set when the option is read; may be NULL */
    const ParameterCodec *codec; /* NULL: read and written as the kind is */
    /* Called when the value was set, to set others that follow from it; NULL: nothing follows. Such
     * options take effect before all others, in the order of the table. */
    void (*changed)(const struct Parameter *parameter);
    /* Axes of quality (1 << QualityAxis, scene/quality.h) that --error leaves alone where this
     * option is given. */
    unsigned fixes;
    int programs; /* of a common option: which have it, see app/options_table.h */
} Parameter;

/* Of the value in --help; NULL: the range or the kind. */
const char *parameter_placeholder(const Parameter *parameter);

/* Its `choices`, or on and off for a switch; NULL: none. */
const char *const *parameter_choices(const Parameter *parameter);

/* Sets a parameter from the command line; `text` is ignored for a flag. The message names it and
 * its range, or the nearest choice. */
bool parameter_read(const Parameter *parameter, const char *text, Message *message);

/* The range of a number or color, "0 to 10", "-1 or more"; "" if the type alone limits it. */
enum { PARAMETER_RANGE_SIZE = 80 };
const char *parameter_range(const Parameter *parameter, char text[PARAMETER_RANGE_SIZE]);

/* A copy of a parameter's value. */
typedef union ParameterValue {
    double number;
    int whole; /* a choice too */
    bool on;   /* a switch, a flag */
    Vec3 color;
    const char *text; /* the pointer alone */
} ParameterValue;

ParameterValue parameter_save(const Parameter *parameter);
void parameter_restore(const Parameter *parameter, ParameterValue value);
bool parameter_equal(const Parameter *parameter, const ParameterValue *value);

/* The value as the command line takes it, in the fewest digits from which parameter_read makes the
 * same value; "" for a flag that is true. In `buffer`, or where the value points. NULL if no option
 * sets this value: a flag that is false, a text that is NULL, a number that is not finite. */
enum { PARAMETER_TEXT_SIZE = 2048 };
const char *parameter_text(const Parameter *parameter, char buffer[PARAMETER_TEXT_SIZE]);

/* Copies parameter_text. False, and an empty text, if that is NULL or does not fit. */
bool parameter_write(const Parameter *parameter, char *text, size_t size);

#endif
