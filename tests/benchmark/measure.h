/*
 * measure: comparable timings on a noisy machine. The candidates run in turn, round after round, so
 * that the ratios of a round belong to the same state of the machine; results are medians and
 * quartiles.
 */
#ifndef MEASURE_H
#define MEASURE_H

#include "study/results/table.h"

#include <stdbool.h>

/* Takes --markdown, --processor and --short off the command line: tables are printed as Markdown;
 * processor time of all threads is measured, which other programs hardly change; there is one
 * round, which stands for all, to see that the benchmark works. Any other option that begins with
 * "--" is an error (exit status 2). */
void measure_begin(int *argc, char *argv[]);

/* One candidate. */
typedef struct Measured {
    const char *name;
    bool (*run)(void *argument); /* timed; false: it failed */
    void *argument;
    double *seconds; /* of each round; filled by measure_rounds */
} Measured;

/* Runs each once to warm up, then `rounds` times in turn. False if one failed; prints which. Free
 * with measure_finish. */
bool measure_rounds(Measured *measured, int count, int rounds);
void measure_finish(Measured *measured, int count);

typedef struct Summary {
    double median, lower, upper; /* median and quartiles */
} Summary;

Summary measure_summary(const double *values, int count);

/* Of the rounds' ratios a / b, times `scale`. */
Summary measure_ratio(const Measured *a, const Measured *b, double scale, int rounds);

/* The machine of all measurements, in one line. `renderer` and `version` are the driver's; NULL:
 * nothing is drawn. */
void measure_print_machine(const char *renderer, const char *version);

/* Prints a table, after a title if there is one. */
void measure_print_table(const char *title, Table *table);

/* "1.23 [1.20, 1.30]": a cell of a table. */
typedef struct Cell {
    char text[48];
} Cell;
Cell measure_cell(Summary summary, double scale, int digits);

#endif
