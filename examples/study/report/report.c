#include "study/report/report.h"

#include "base/memory.h"
#include "base/text.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The columns before the setting, with titles on two lines. */
enum {
    MS,
    QUARTILES,
    NET,
    GPU,
    MAXIMUM,
    RMS,
    ALL_MAXIMUM,
    ALL_RMS,
    VERTICES,
    FRAGMENTS,
    OPERATIONS
};
enum { COLUMNS = OPERATIONS + 1, CELL_SIZE = 24 };

static const char *const TITLES[2][COLUMNS] = {
    {"", "", "net", "GPU", "inside", "", "all", "", "", "", "operations"},
    {"ms", "quartiles", "ms", "ms", "max", "rms", "max", "rms", "vertices", "fragments",
     "vert/frag"}};

enum { LINE_WIDTH = 120, MIN_TEXT_WIDTH = 24 };

typedef struct Line {
    char cells[COLUMNS][CELL_SIZE];
} Line;

static void put_real(char cell[CELL_SIZE], double value)
{
    if (!isfinite(value))
        snprintf(cell, CELL_SIZE, "-");
    else if (value > 0 && value < 0.005)
        snprintf(cell, CELL_SIZE, "<0.01");
    else
        snprintf(cell, CELL_SIZE, "%.2f", value);
}

static void put_count(char cell[CELL_SIZE], long long count)
{
    if (count < 0)
        snprintf(cell, CELL_SIZE, "-");
    else
        snprintf(cell, CELL_SIZE, "%lld", count);
}

static Line line_of(const ResultRow *row)
{
    Line line;
    char first[CELL_SIZE], second[CELL_SIZE];
    put_real(line.cells[MS], row->time);
    put_real(first, row->time_lower);
    put_real(second, row->time_upper);
    if (isfinite(row->time_lower) && isfinite(row->time_upper))
        snprintf(line.cells[QUARTILES], CELL_SIZE, "[%.9s, %.9s]", first, second);
    else
        put_real(line.cells[QUARTILES], NAN);
    put_real(line.cells[NET], row->net_time);
    put_real(line.cells[GPU], row->gpu_time);
    put_real(line.cells[MAXIMUM], row->interior_maximum);
    put_real(line.cells[RMS], row->interior_rms);
    put_real(line.cells[ALL_MAXIMUM], row->all_maximum);
    put_real(line.cells[ALL_RMS], row->all_rms);
    put_count(line.cells[VERTICES], row->vertices);
    put_count(line.cells[FRAGMENTS], row->fragments);
    put_count(first, row->vertex_operations);
    put_count(second, row->fragment_operations);
    snprintf(line.cells[OPERATIONS], CELL_SIZE, "%.10s/%.10s", first, second);
    return line;
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

/* What a table shows. */
typedef struct Shown {
    const ResultRow **rows;
    int count;
    Line *lines; /* of each row */
    Front front;
    bool only_efficient;
} Shown;

static void put_lines(FILE *file, const Shown *shown)
{
    const Line *lines = shown->lines;
    int widths[COLUMNS], column = 4;
    for (int i = 0; i < COLUMNS; i++) {
        bool known = i != GPU;
        widths[i] = (int)fmax((double)strlen(TITLES[0][i]), (double)strlen(TITLES[1][i]));
        for (int j = 0; j < shown->count; j++) {
            widths[i] = (int)fmax(widths[i], (double)strlen(lines[j].cells[i]));
            known = known || strcmp(lines[j].cells[i], "-") != 0;
        }
        widths[i] = known ? widths[i] : 0;
        column += known ? widths[i] + 1 : 0;
    }
    for (int line = 0; line < 2; line++) {
        fputs("  ", file);
        for (int i = 0; i < COLUMNS; i++)
            if (widths[i])
                fprintf(file, " %*s", widths[i], TITLES[line][i]);
        fputs(line ? "  setting\n" : "\n", file);
    }
    for (int j = 0; j < shown->count; j++) {
        char text[QUALITY_TEXT_SIZE];
        const bool efficient = front_has(&shown->front, shown->rows[j]);
        const bool tied = front_ties(&shown->front, shown->rows[j]);
        if (shown->only_efficient && !shown->front.busy && !efficient && !tied)
            continue;
        fprintf(file, "%c ", efficient ? '*' : tied ? '=' : ' ');
        for (int i = 0; i < COLUMNS; i++)
            if (widths[i])
                fprintf(file, " %*s", widths[i], lines[j].cells[i]);
        fputs("  ", file);
        quality_text(&shown->rows[j]->quality, text);
        text_wrap(file, text, column, column, (int)fmax(LINE_WIDTH, column + MIN_TEXT_WIDTH));
        fputc('\n', file);
    }
}

bool report_table(const Results *results, const char *scene, bool only_efficient, FILE *file,
                  Message *message)
{
    Shown shown = {.only_efficient = only_efficient};
    bool done = true;
    shown.rows = results_latest(results, scene, &shown.count);
    if (shown.count == 0) {
        free(shown.rows);
        return message_set(message, "%s: nothing was measured", scene);
    }
    shown.lines = memory_new((size_t)shown.count, sizeof *shown.lines);
    front_open(&shown.front, results, scene, ERROR_INTERIOR_MAXIMUM);
    qsort(shown.rows, (size_t)shown.count, sizeof *shown.rows, by_time);
    for (int i = 0; i < shown.count; i++)
        shown.lines[i] = line_of(shown.rows[i]);
    put_head(file, shown.rows, shown.count, shown.front.busy);
    put_lines(file, &shown);
    if (fflush(file) != 0 || ferror(file))
        done = message_set(message, "%s: cannot write the table: %s", scene, strerror(errno));
    front_close(&shown.front);
    free(shown.lines);
    free(shown.rows);
    return done;
}
