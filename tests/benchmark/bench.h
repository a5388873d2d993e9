/*
 * bench: comparable timings on a noisy machine, and their tables. What is compared runs in turn,
 * round after round, so that the ratios of a round belong to the same state of the machine; results
 * are medians and quartiles.
 */
#ifndef BENCH_H
#define BENCH_H

#include "core/canvas.h"
#include "study/results/table.h"

#include <stdbool.h>

/* A benchmark. bench_main.c, which has main, takes --markdown, --processor and --short off the
 * command line: tables are printed as Markdown; processor time of all threads is measured, which
 * other programs hardly change; there is one round, to see that the benchmark works. */
typedef struct Bench {
    const char *name;
    int width, height; /* of bench_canvas, which is opened; 0: none is */
    bool one_thread;   /* draws with one thread, unless the environment says otherwise */
    bool no_cache;     /* the driver compiles every program anew */
    bool (*can_run)(Message *message); /* exit status 77 without this or a canvas; may be NULL */
    bool (*run)(Message *message);
    void (*close)(void); /* of what `run` opened, whatever it returned; may be NULL */
} Bench;

extern const Bench BENCH;
extern Canvas bench_canvas;
extern char **bench_arguments; /* the others, ended by NULL */

/* What main begins with: takes the options, exit status 2 for any other; prints the machine of all
 * measurements in one line. `canvas` may be NULL: nothing is drawn. */
void bench_begin(int *argc, char *argv[]);
void bench_machine(const Canvas *canvas);

/* A folder that is removed at the end; NULL, with a message: there is none. */
const char *bench_folder(Message *message);
void bench_remove_folder(void);

/* What is timed. */
typedef struct BenchRun {
    const char *name;
    bool (*run)(void *argument, Message *message);
    void *argument;
    double *seconds; /* of each round, by bench_rounds */
    int rounds;
} BenchRun;

/* Runs each once to warm up, then `rounds` times in turn. Free with bench_finish. */
bool bench_rounds(BenchRun *runs, int count, int rounds, Message *message);
void bench_finish(BenchRun *runs, int count);

/* A column of a table: of each round, `scale` times (of - minus) / (over + plus), the times of the
 * runs of a row with these numbers; -1: none. A scale of 0: an empty cell. */
typedef struct BenchColumn {
    double scale;
    int digits;
    int of, minus, over, plus;
    bool alone; /* the median without its quartiles */
} BenchColumn;

#define BENCH_TIME(of, scale, digits) scale, digits, of, -1, -1, -1, false
#define BENCH_RATIO(of, over, digits) 1, digits, of, -1, over, -1, false
#define BENCH_RATE(over, scale, digits) scale, digits, -1, -1, over, -1, false
#define BENCH_MEDIAN(of, scale, digits) scale, digits, of, -1, -1, -1, true

/* "1.23 [1.20, 1.30]" */
typedef struct BenchCell {
    char text[48];
} BenchCell;
BenchCell bench_cell(const BenchRun *runs, const BenchColumn *column);

/* A row: some cells' text, then a cell for each column. */
void bench_row(Table *table, const BenchRun *runs, const BenchColumn *columns, int count,
               const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Measures `rows` rows, of so many runs each, all in turn, and adds each with the name of its first
 * run. */
typedef struct BenchRows {
    BenchRun *runs;
    int rows, runs_each, rounds;
    const BenchColumn *columns;
    int column_count;
} BenchRows;
bool bench_rows(const BenchRows *rows, Table *table, Message *message);

/* Prints a table, after a title if there is one. */
void bench_print(const char *title, Table *table);

#endif
