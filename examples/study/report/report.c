#include "study/report/report.h"

#include "study/results/table.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Cell {
    char text[48];
} Cell;

static Cell real(double value)
{
    Cell cell = {"-"};
    if (value > 0 && value < 0.005)
        return (Cell){"<0.01"};
    if (isfinite(value))
        snprintf(cell.text, sizeof cell.text, "%.2f", value);
    return cell;
}

static Cell count(long long value)
{
    Cell cell = {"-"};
    if (value >= 0)
        snprintf(cell.text, sizeof cell.text, "%lld", value);
    return cell;
}

#define ERRORS "inside: max|rms|all: max|rms|vertices|fragments|operations|setting"
static const char HEAD[] = "|ms|quartiles|net ms|" ERRORS;
static const char HEAD_GPU[] = "|ms|quartiles|net ms|GPU ms|" ERRORS;

static void put_row(Table *table, const ResultRow *row, char mark, bool gpu)
{
    char setting[QUALITY_TEXT_SIZE];
    quality_text(&row->quality, setting);
    table_row(table, "%c|%s|[%s, %s]|%s%s%s|%s|%s|%s|%s|%s|%s|%s/%s|%s", mark, real(row->time).text,
              real(row->time_lower).text, real(row->time_upper).text, real(row->net_time).text,
              gpu ? "|" : "", gpu ? real(row->gpu_time).text : "", real(row->interior_maximum).text,
              real(row->interior_rms).text, real(row->all_maximum).text, real(row->all_rms).text,
              count(row->vertices).text, count(row->fragments).text,
              count(row->vertex_operations).text, count(row->fragment_operations).text, setting);
}

static int by_time(const void *first, const void *second)
{
    const ResultRow *a = *(const ResultRow *const *)first, *b = *(const ResultRow *const *)second;
    if (isnan(a->time) || isnan(b->time))
        return isnan(a->time) - isnan(b->time);
    if (a->time != b->time)
        return a->time < b->time ? -1 : 1;
    return memcmp(a->quality.choice, b->quality.choice, sizeof a->quality.choice);
}

static void put_head(FILE *file, const ResultRow *const *rows, int count, bool busy)
{
    const ResultRow *first = rows[0];
    double min = NAN, max = NAN;
    for (int i = 0; i < count; i++) {
        min = fmin(min, rows[i]->noise);
        max = fmax(max, rows[i]->noise);
    }
    fprintf(file, "%s, %dx%d; %s, LP_NUM_THREADS %s; ", first->scene, first->width, first->height,
            first->renderer, first->threads);
    if (isnan(max))
        fprintf(file, "noise not known\n");
    else if (min == max)
        fprintf(file, "noise %.1f %%\n", 100 * max);
    else
        fprintf(file, "noise %.1f to %.1f %%\n", 100 * min, 100 * max);
    if (busy) {
        fprintf(file,
                "Errors in steps of 1/255. The machine was busy, half the noise above %.0f %%: no "
                "setting is marked as efficient.\n\n",
                100 * FRONT_NOISE_BOUND);
        return;
    }
    fputs("Errors in steps of 1/255. * efficient by the largest error inside the objects.\n"
          "= tied: its median would make it efficient too, but that is within the noise.\n\n",
          file);
}

bool report_table(const Results *results, const char *scene, bool only_efficient, FILE *file,
                  Message *message)
{
    Front front;
    Table table;
    int row_count;
    bool gpu = false;
    const ResultRow **rows = results_latest(results, scene, &row_count);
    if (row_count == 0) {
        free(rows);
        return message_set(message, "%s: nothing was measured", scene);
    }
    front_open(&front, results, scene, ERROR_INTERIOR_MAXIMUM);
    qsort(rows, (size_t)row_count, sizeof *rows, by_time);
    put_head(file, rows, row_count, front.busy);
    for (int i = 0; i < row_count; i++)
        gpu = gpu || isfinite(rows[i]->gpu_time);
    table_open(&table, gpu ? HEAD_GPU : HEAD);
    table.last_left = true;
    for (int i = 0; i < row_count; i++) {
        const bool efficient = front_has(&front, rows[i]), tied = front_ties(&front, rows[i]);
        if (!only_efficient || front.busy || efficient || tied)
            put_row(&table, rows[i], efficient ? '*' : tied ? '=' : ' ', gpu);
    }
    table_close(&table, false, file);
    front_close(&front);
    free(rows);
    if (fflush(file) != 0 || ferror(file))
        return message_set(message, "%s: cannot write the table: %s", scene, strerror(errno));
    return true;
}
