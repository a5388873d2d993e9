/*
 * The Pareto front under noise. Sorted by error, a row is efficient if it is faster than all more
 * exact ones; "faster" asks for more than the noise, so that two rows may be tied, and a front by
 * medians alone would change from run to run. Of rows that are as exact and as fast the one with
 * the fewest unusual choices stands for all. Sorting costs n log n, looking for such a row n times
 * the front.
 */
#include "study/results/results.h"

#include "base/clock.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double row_error(const ResultRow *row, ErrorKind kind)
{
    switch (kind) {
    case ERROR_INTERIOR_MAXIMUM:
        return row->interior_maximum;
    case ERROR_INTERIOR_RMS:
        return row->interior_rms;
    case ERROR_ALL_RMS:
        return row->all_rms;
    }
    return NAN;
}

bool row_faster(const ResultRow *a, const ResultRow *b)
{
    if (!isfinite(a->noise) || !isfinite(b->noise) ||
        !(b->time > a->time * (1 + fmax(a->noise, b->noise))))
        return false;
    for (int run = 0; run < RESULT_RUNS; run++)
        if (!(a->run_times[run] < b->run_times[run]))
            return false;
    return true;
}

bool row_beats(const ResultRow *a, const ResultRow *b, ErrorKind kind)
{
    return !row_faster(b, a) && row_error(a, kind) < row_error(b, kind) + FRONT_EQUAL_ERROR;
}

double front_noise(const Results *results, const char *scene)
{
    double *values = memory_new((size_t)results->count, sizeof *values);
    int count = 0;
    for (int i = 0; i < results->count; i++) {
        const ResultRow *row = &results->rows[i];
        if (isfinite(row->noise) && (!scene || strcmp(row->scene, scene) == 0))
            values[count++] = row->noise;
    }
    const double median = clock_median(values, count);
    free(values);
    return median;
}

bool front_busy(const Results *results, const char *scene)
{
    return front_noise(results, scene) > FRONT_NOISE_BOUND;
}

/* A row with known time and error. */
typedef struct Entry {
    const ResultRow *row;
    double error;
    int unusual;
} Entry;

/* The most exact first, then the fastest; a total order, so that results are reproducible. */
static int by_error(const void *first, const void *second)
{
    const Entry *a = first, *b = second;
    if (a->error != b->error)
        return a->error < b->error ? -1 : 1;
    if (a->row->time != b->row->time)
        return a->row->time < b->row->time ? -1 : 1;
    if (a->unusual != b->unusual)
        return a->unusual - b->unusual;
    return memcmp(a->row->quality.choice, b->row->quality.choice, sizeof a->row->quality.choice);
}

/* Keeps rows that are faster than all more exact ones. It suffices to compare with the last one
 * kept, the fastest so far. */
static int take_faster(const Entry *entries, int count, const ResultRow **rows)
{
    int taken = 0;
    for (int i = 0; i < count; i++)
        if (taken == 0 || row_faster(entries[i].row, rows[taken - 1]))
            rows[taken++] = entries[i].row;
    return taken;
}

/* Reverses the order, fastest first, and drops rows that a faster one equals in exactness. */
static int take_more_exact(const ResultRow **rows, int count, ErrorKind kind)
{
    int taken = 0;
    for (int i = 0; i < count / 2; i++) {
        const ResultRow *swapped = rows[i];
        rows[i] = rows[count - 1 - i];
        rows[count - 1 - i] = swapped;
    }
    for (int i = 0; i < count; i++)
        if (taken == 0 || !row_beats(rows[taken - 1], rows[i], kind))
            rows[taken++] = rows[i];
    return taken;
}

/* Whether the properties in the header hold. */
static bool is_front(const Front *front, const Entry *entries, int count, ErrorKind kind)
{
    for (int i = 0; i + 1 < front->count; i++)
        if (!row_faster(front->rows[i], front->rows[i + 1]) ||
            row_beats(front->rows[i], front->rows[i + 1], kind))
            return false;
    for (int i = 0; i < count; i++) {
        bool beaten = false;
        for (int j = 0; j < front->count && !beaten; j++)
            beaten = row_beats(front->rows[j], entries[i].row, kind);
        if (!beaten)
            return false;
    }
    return true;
}

/* Replaces an efficient row by an equivalent one with fewer unusual choices, if the result is still
 * a front. */
static void prefer_usual(Front *front, const Entry *entries, int count, ErrorKind kind)
{
    for (int i = 0; i < front->count; i++) {
        int fewest = quality_unusual(&front->rows[i]->quality);
        for (int j = 0; j < count; j++) {
            const ResultRow *before = front->rows[i], *row = entries[j].row;
            if (entries[j].unusual >= fewest || !row_beats(row, before, kind) ||
                !row_beats(before, row, kind))
                continue;
            front->rows[i] = row;
            if (is_front(front, entries, count, kind))
                fewest = entries[j].unusual;
            else
                front->rows[i] = before;
        }
    }
}

/* Selects and sorts the rows with known time and error; returns their number. */
static int select_entries(Entry *entries, const ResultRow *const *rows, int count, ErrorKind kind)
{
    int selected = 0;
    for (int i = 0; i < count; i++) {
        const double error = row_error(rows[i], kind);
        if (isfinite(error) && isfinite(rows[i]->time))
            entries[selected++] = (Entry){rows[i], error, quality_unusual(&rows[i]->quality)};
    }
    qsort(entries, (size_t)selected, sizeof *entries, by_error);
    return selected;
}

void front_find(Front *front, const Results *results, const char *scene, ErrorKind kind)
{
    int count;
    const ResultRow **rows = results_latest(results, scene, &count);
    Entry *entries = memory_new((size_t)count, sizeof *entries);
    *front = (Front){.rows = memory_new((size_t)count, sizeof *front->rows),
                     .tied = memory_new((size_t)count, sizeof *front->tied),
                     .busy = front_busy(results, scene)};
    count = select_entries(entries, rows, count, kind);
    front->count = take_faster(entries, count, front->rows);
    front->count = take_more_exact(front->rows, front->count, kind);
    prefer_usual(front, entries, count, kind);
    /* From the most exact on, each whose median is faster than all before it. */
    double fastest = INFINITY;
    for (int i = 0; i < count; i++) {
        if (entries[i].row->time >= fastest)
            continue;
        fastest = entries[i].row->time;
        if (!front_has(front, entries[i].row))
            front->tied[front->tied_count++] = entries[i].row;
    }
    free(entries);
    free(rows);
}

void front_open(Front *front, const Results *results, const char *scene, ErrorKind kind)
{
    front_find(front, results, scene, kind);
    if (front->busy)
        front->count = front->tied_count = 0;
}

bool front_has(const Front *front, const ResultRow *row)
{
    for (int i = 0; i < front->count; i++)
        if (front->rows[i] == row)
            return true;
    return false;
}

bool front_ties(const Front *front, const ResultRow *row)
{
    for (int i = 0; i < front->tied_count; i++)
        if (front->tied[i] == row)
            return true;
    return false;
}

void front_close(Front *front)
{
    if (!front)
        return;
    free(front->rows);
    free(front->tied);
    *front = (Front){0};
}
