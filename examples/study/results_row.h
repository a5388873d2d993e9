/*
 * results_row: a row of results as a line of text, and back.
 */
#ifndef RESULTS_ROW_H
#define RESULTS_ROW_H

#include "results.h"

/* A field is text, a choice, or a number of one of four types. */
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
    size_t offset, size; /* in a row; of a choice nothing */
    double least, most;  /* of a number; -1 and NAN are "not known" besides: an empty field.
                            Of a text the fewest characters */
    SettingAxis axis;    /* of a choice */
} Column;

enum {
    RESULTS_NUMBERS = 23, /* columns after the scene and the axes */
    RESULTS_COLUMNS = 1 + AXIS_COUNT + RESULTS_NUMBERS,
    RESULTS_FIELD_SIZE = 256,
    RESULTS_HEADER_SIZE = 2048,
};

/* One of the RESULTS_COLUMNS columns. The last is text, always in quotes: so no row that is cut
 * reads as a whole one. */
Column column_at(int number);

/* The value of a column: as few digits as give the same number again, "" where it is not known. */
void column_text(const ResultRow *row, const Column *column, char text[RESULTS_FIELD_SIZE]);

/* What is wrong with a line, printable. */
typedef struct Fault {
    char text[256];
} Fault;

/* Which of our columns each of a file's is; -1: none. */
typedef struct Header {
    int columns[128];
    int count;
    bool ours; /* all of ours, in our order, and no other */
} Header;

/* Our header, and without line break as text. */
Header header_ours(void);
void header_text(char text[RESULTS_HEADER_SIZE]);

/* These read a line that goes from `line` to `end`, without the line break. */
bool header_parse(Header *header, const char *line, const char *end, Fault *fault);
bool row_parse(ResultRow *row, const Header *header, const char *line, const char *end,
               Fault *fault);

#endif
