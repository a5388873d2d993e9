/*
 * table: rows of cells as aligned text or as a Markdown table, and the line that says what was
 * measured on.
 */
#ifndef TABLE_H
#define TABLE_H

#include "base/output_text.h"

enum { TABLE_MAX_COLUMNS = 16 };

typedef struct Table {
    OutputText rows; /* so far */
    bool last_left;  /* the last column is aligned to the left, too */
} Table;

/* A row is text with '|' between its cells; `head` is the first. The first column is aligned to the
 * left, the others to the right. */
void table_open(Table *table, const char *head);
void table_row(Table *table, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prints and frees the table. */
void table_close(Table *table, bool markdown, FILE *file);

/* "PROCESSOR, N cores; DRIVER; LP_NUM_THREADS N; COMPILER FLAGS". `driver` has renderer and
 * version; NULL: nothing is drawn. */
void table_machine(const char *driver, FILE *file);

#endif
