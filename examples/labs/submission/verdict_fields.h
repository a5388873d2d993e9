/*
 * verdict_fields: the members of a verdict's JSON object, as tables for its reader and its writer.
 */
#ifndef VERDICT_FIELDS_H
#define VERDICT_FIELDS_H

#include "base/json_writer.h"
#include "labs/submission/verdict.h"

#include <stddef.h>

typedef enum FieldKind {
    FIELD_TEXT,   /* a line; `max` is its size */
    FIELD_LINES,  /* the same with line breaks */
    FIELD_NUMBER, /* a double from `min` to `max` */
    FIELD_ERROR,  /* the same, or infinite: null */
    FIELD_WHOLE,  /* an int */
    FIELD_FLAG,   /* a bool; with `choices` it is the second of two */
    FIELD_CHOICE, /* an enumeration, by the names in `choices` */
    FIELD_LIST,   /* `items`, at most `max`, whose number is the int at `count` */
} FieldKind;

/* A member of a struct. In a list of texts the item has no name. */
typedef struct Field {
    const char *name;
    FieldKind kind;
    size_t offset;
    double min, max;
    const char *const *choices; /* ends with NULL */
    const struct Field *items;
    size_t item_size, count;
    bool optional; /* an empty list is left out */
} Field;

/* Of Verdict: all but its seed, picture and cost. Ends with a `kind` below 0. */
extern const Field VERDICT_FIELDS[];
#define FIELD_END                                                                                  \
    {                                                                                              \
        .kind = (FieldKind)-1                                                                      \
    }

/* Of VerdictCost. */
extern const Field VERDICT_COST_FIELDS[];

/* Writes a verdict's members, without the braces. Bytes that are not UTF-8 become the replacement
 * character; infinities and NaN become null. */
void verdict_put(JsonWriter *json, const Verdict *verdict, const char *lab);

#endif
