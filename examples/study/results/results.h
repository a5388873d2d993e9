/*
 * results: measurements, one row per scene and setting, appended to a file as soon as they are
 * known.
 */
#ifndef RESULTS_H
#define RESULTS_H

#include "scene/quality.h"

enum { RESULT_RUNS = 3 };

/* Errors in steps of 1/255: `interior` of the pixels inside an object in both the exact and the
 * drawn picture, `all` of every pixel. Times in milliseconds. Unknown: NAN, or -1 for counts. */
typedef struct ResultRow {
    char scene[32];
    Quality quality;
    int width, height;
    double interior_rms, interior_maximum, all_rms, all_maximum;
    int interior_pixels;
    double time, time_lower, time_upper; /* of a frame, drawn and read back: median, quartiles */
    double run_times[RESULT_RUNS];       /* the medians of the three runs */
    double net_time;                     /* less the time of a frame that draws nothing */
    double gpu_time;                     /* by the driver's timer */
    double noise;                        /* of the times, as a fraction, from the A/A measurement */
    long long vertices, fragments;       /* of a frame; visible fragments */
    int vertex_operations, fragment_operations; /* of the costliest program */
    unsigned seed;                              /* of the order of measuring */
    char renderer[96];
    char threads[16]; /* LP_NUM_THREADS, or "default" */
} ResultRow;

/* How many of a setting's choices are not the usual ones. */
int quality_unusual(const Quality *quality);

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

/* The names of the columns, as a file's first line has them, without line break. */
void header_text(char text[RESULTS_HEADER_SIZE]);

/* Reads a row; `end` is the end of its line, without line break. The message has only printable
 * characters, whatever the line has. */
bool row_parse(ResultRow *row, const char *line, const char *end, Message *message);

/* The largest file that is read, in bytes; a row has a few hundred. */
enum { RESULTS_SIZE_MAX = 64 << 20 };

typedef struct Results {
    ResultRow *rows;
    int count, capacity;
} Results;

/* "RENDERER, LP_NUM_THREADS N, WxH, seed N": of a row; of the newest one, empty if there is none.
 */
enum { RESULT_WITH_SIZE = 256 };
void results_measured_with(const ResultRow *row, char text[RESULT_WITH_SIZE]);
void results_with(const Results *results, char text[RESULT_WITH_SIZE]);

/* Adds a row. */
void results_add(Results *results, const ResultRow *row);

/* The latest row of a scene and setting; NULL if there is none. */
const ResultRow *results_find(const Results *results, const char *scene, const Quality *quality);

/* The same of a setting's text, as quality_parse reads it. */
const ResultRow *results_of(const Results *results, const char *scene, const char *setting);

/* The latest row of each setting of a scene, in the order in which they were added. The caller
 * frees the array; the rows belong to `results`. */
const ResultRow **results_latest(const Results *results, const char *scene, int *count);

/* Adds the rows of a file that results_append wrote; a missing file has none. The file is CSV (RFC
 * 4180): a line with the columns, then one line per row; no field has a line break;
 * an empty field is unknown. A truncated, malformed or out-of-range row is skipped, with one line
 * on standard error for each of the first ten and one for the rest. Rows with another renderer,
 * number of threads or size than `like` (may be NULL) are skipped, with one line for all. False
 * only if the file cannot be read or is not a file of results. */
bool results_read(Results *results, const char *path, const ResultRow *like, Message *message);

/* The same from memory; `path` is for messages. */
bool results_parse(Results *results, const char *path, const char *text, size_t size,
                   const ResultRow *like, Message *message);

/* Appends rows to a file; a new or empty one gets its header first. After a truncated last line a
 * new line is started; no part of a row parses as a row. The file is replaced by one that is whole,
 * or unchanged. Rows that results_read would skip and files with other columns are refused. */
bool results_append(const char *path, const ResultRow *rows, int count, Message *message);

void results_close(Results *results);

/* The efficient settings (the Pareto front): no other beats them in both error and time. */

/* Which error counts. */
typedef enum ErrorKind { ERROR_INTERIOR_MAXIMUM, ERROR_INTERIOR_RMS, ERROR_ALL_RMS } ErrorKind;

double row_error(const ResultRow *row, ErrorKind kind);

/* Rows whose errors lie closer than this, in steps of 1/255, count as equally exact. */
#define FRONT_EQUAL_ERROR 0.01

/* Whether a is significantly faster than b: the difference exceeds the larger noise of the two,
 *   b->time > a->time * (1 + max(a->noise, b->noise)),
 * and a was faster in each run. False if any of these numbers is unknown. If neither is faster than
 * the other, they are tied. ("Faster" is transitive, "tied" is not.) Rows of one scene, size,
 * renderer and number of threads, as results_read leaves them. */
bool row_faster(const ResultRow *a, const ResultRow *b);

/* Whether b is not faster than a and a's error is less than b's plus FRONT_EQUAL_ERROR. Two that
 * are tied and equally exact beat each other. */
bool row_beats(const ResultRow *a, const ResultRow *b, ErrorKind kind);

/* With a median noise above this the machine was busy, and times are not compared. */
#define FRONT_NOISE_BOUND 0.1

/* The median noise of a scene's rows, or of all (NULL); NAN: not known. And whether a scene's is
 * above the bound: what compares times, in words or in pictures, asks this. */
double front_noise(const Results *results, const char *scene);
bool front_busy(const Results *results, const char *scene);

/* The efficient rows of a scene, from the cheapest (least exact) to the most expensive (most
 * exact). Each is faster than all that follow, and less exact by at least FRONT_EQUAL_ERROR: no two
 * are tied. Every other row is beaten by one of them. Of tied rows the most exact one is chosen,
 * and of equally exact ones the one with the fewest unusual choices. Rows of unknown time or error
 * are ignored; of several rows with one setting the latest counts.
 *
 * `tied` has the rows that would be efficient by their median times alone. */
typedef struct Front {
    const ResultRow **rows, **tied;
    int count, tied_count;
    bool busy; /* front_busy */
} Front;

void front_find(Front *front, const Results *results, const char *scene, ErrorKind kind);

/* To be shown: empty where the machine was busy. */
void front_open(Front *front, const Results *results, const char *scene, ErrorKind kind);

/* Whether a row is efficient; whether it is tied. */
bool front_has(const Front *front, const ResultRow *row);
bool front_ties(const Front *front, const ResultRow *row);

void front_close(Front *front);

#endif
