/*
 * results: measurements, one row per scene and setting, appended to a file as soon as they are
 * known.
 */
#ifndef RESULTS_H
#define RESULTS_H

#include "study/results/results_row.h"

/* The largest file that is read, in bytes; a row has a few hundred. */
enum { RESULTS_SIZE_MAX = 64 << 20 };

typedef struct Results {
    ResultRow *rows;
    int count, capacity;
} Results;

/* "RENDERER, LP_NUM_THREADS N, WxH, seed N". */
enum { RESULT_WITH_SIZE = 256 };
void results_measured_with(const ResultRow *row, char text[RESULT_WITH_SIZE]);

/* Adds a row. */
void results_add(Results *results, const ResultRow *row);

/* The latest row of a scene and setting; NULL if there is none. */
const ResultRow *results_find(const Results *results, const char *scene, const Quality *quality);

/* The latest row of each setting of a scene, in the order in which they were added. The caller
 * frees the array; the rows belong to `results`. */
const ResultRow **results_latest(const Results *results, const char *scene, int *count);

/* Adds the rows of a file that results_append wrote; a missing file has none. The file is CSV (RFC
 * 4180): a line with the columns, in any order, then one line per row; no field has a line break;
 * an empty field is unknown. A truncated, malformed or out-of-range row is skipped, with one line
 * on standard error for each of the first ten and one for the rest. Rows with another renderer,
 * number of threads or size than `like` (may be NULL) are skipped, with one line for all. False
 * only if the file cannot be read or is not a file of results. */
bool results_read(Results *results, const char *path, const ResultRow *like, Message *message);

/* The same from memory; `path` is for messages. */
bool results_parse(Results *results, const char *path, const char *text, size_t size,
                   const ResultRow *like, Message *message);

/* Appends rows to a file; a new or empty one gets its header first. After a truncated last line (an
 * interrupted write) a new line is started; no part of a row parses as a row. On success the rows
 * are on disk; on failure the file is unchanged. Rows that results_read would skip and files with
 * other columns are refused. */
bool results_append(const char *path, const ResultRow *rows, int count, Message *message);

/* All rows as JSON, keyed by the file's columns, completely or not at all. Unknown
 * values are null.
 */
bool results_write_json(const Results *results, const char *path, Message *message);

void results_close(Results *results);

#endif
