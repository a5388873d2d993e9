/*
 * results: what was measured: one row for each scene and setting, kept in a file as soon as it is
 * known.
 */
#ifndef RESULTS_H
#define RESULTS_H

#include "setting.h"

enum { RESULT_RUNS = 3 };

/* The largest file that is read, in bytes; a row has a few hundred. */
enum { RESULTS_SIZE_MOST = 64 << 20 };

/* Errors in steps of 1/255: interior is the pixels wholly inside an object, in the exact picture
 * and in the drawn one; all is every pixel. Times in milliseconds. Not known: NAN, or -1 for
 * counts. */
typedef struct ResultRow {
    char scene[32];
    Setting setting;
    int width, height;
    double interior_rms, interior_maximum, all_rms, all_maximum;
    int interior_pixels;
    double time, time_lower, time_upper; /* of a frame, drawn and read back: median, quartiles */
    double run_times[RESULT_RUNS];       /* the medians of the three runs */
    double net_time;                     /* without what a usual frame takes that draws nothing */
    double gpu_time;                     /* as the driver's timer has it */
    double noise; /* of the times, as a fraction: how far a setting and itself came out apart */
    long long vertices, fragments;              /* of a frame; fragments are those that are seen */
    int vertex_operations, fragment_operations; /* of the costliest program */
    unsigned seed;                              /* of the order of measuring */
    char renderer[96];
    char threads[16]; /* LP_NUM_THREADS, or "default" */
} ResultRow;

typedef struct Results {
    ResultRow *rows;
    int count, capacity;
} Results;

/* What a row was measured with, in one line: renderer, LP_NUM_THREADS, size, seed. */
enum { RESULT_WITH_SIZE = 256 };
void results_measured_with(const ResultRow *row, char text[RESULT_WITH_SIZE]);

/* Adds a row. */
bool results_add(Results *results, const ResultRow *row, Message *message);

/* The row of a scene and setting; NULL where there is none. The latest, where there are several. */
const ResultRow *results_find(const Results *results, const char *scene, const Setting *setting);

/* The rows of a scene, the latest of each setting, in the order in which they were added. The array
 * is the caller's to free; the rows are those of `results`. */
bool results_latest(const Results *results, const char *scene, const ResultRow ***rows, int *count,
                    Message *message);

/* Reads a file that results_append wrote, or none if it is not there, and adds its rows. The file
 * is CSV (RFC 4180): a line that names the columns, in any order, then a row a line; no field has a
 * line break; an empty field is not known. A row that is cut, broken or out of range is skipped,
 * with one line on standard error that names file and line, and after ten of them one with their
 * number; rows measured with another renderer, number of threads or size than those of `like` are
 * skipped, with one line for all. `like` may be NULL. False only where the file cannot be read at
 * all, or is something else. */
bool results_read(Results *results, const char *path, const ResultRow *like, Message *message);

/* The same from text in memory; `path` is for the messages. For tests. */
bool results_parse(Results *results, const char *path, const char *text, size_t size,
                   const ResultRow *like, Message *message);

/* Adds rows to the end of a file, which gets its header first where it is new or empty. After a
 * broken last line (an interrupted write) a new one is begun; no part of a row reads as a row. The
 * rows are on the disk, or the message says what failed, and the file is as it was. Refused: rows
 * that results_read would skip, and files with other columns. */
bool results_append(const char *path, const ResultRow *rows, int count, Message *message);

/* All rows as JSON, under the names that the columns of the file have: whole or not at all. What is
 * not known is null. */
bool results_write_json(const Results *results, const char *path, Message *message);

void results_close(Results *results);

#endif
