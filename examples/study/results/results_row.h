/*
 * results_row: formats and parses a row of results.
 */
#ifndef RESULTS_ROW_H
#define RESULTS_ROW_H

#include "study/results/results.h"

/* A field is text, a choice on an axis, or a number. */
typedef enum ColumnKind {
    COLUMN_TEXT,
    COLUMN_CHOICE,
    COLUMN_COUNT,
    COLUMN_LONG_COUNT,
    COLUMN_SEED,
    COLUMN_REAL,
} ColumnKind;

typedef struct Column {
    const char *name;
    ColumnKind kind;
    size_t offset, size; /* in a ResultRow; unused for a choice */
    double min, max;     /* of a number; an empty field is unknown: -1 or NAN. Of text, `min` is the
                            minimum length */
    QualityAxis axis;    /* of a choice */
} Column;

enum {
    RESULTS_NUMBERS = 23, /* columns after the scene and the axes */
    RESULTS_COLUMNS = 1 + AXIS_COUNT + RESULTS_NUMBERS,
    RESULTS_FIELD_SIZE = 256,
    RESULTS_HEADER_SIZE = 2048,
};

/* One of the RESULTS_COLUMNS columns. The last is text, always quoted, so that no truncated row
 * parses. */
Column column_at(int number);

/* The value of a column, in the fewest digits that round-trip; "" if unknown. */
void column_text(const ResultRow *row, const Column *column, char text[RESULTS_FIELD_SIZE]);

/* What is wrong with a line, in printable characters. */
typedef struct Fault {
    char text[256];
} Fault;

/* For each of a file's columns, which of ours it is; -1: none. */
typedef struct Header {
    int columns[128];
    int count;
    bool ours; /* exactly our columns, in our order */
} Header;

/* Our header; the same as text, without line break. */
Header header_ours(void);
void header_text(char text[RESULTS_HEADER_SIZE]);

/* `end` is the end of the line, without line break. */
bool header_parse(Header *header, const char *line, const char *end, Fault *fault);
bool row_parse(ResultRow *row, const Header *header, const char *line, const char *end,
               Fault *fault);

#endif
