#include "study/measure/choose.h"

#include "study/measure/scenes.h"
#include "study/results/front.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void say(const char *what, const ResultRow *row, ErrorKind kind)
{
    char text[QUALITY_TEXT_SIZE];
    quality_text(&row->quality, text);
    /* Rounded up, so that it serves as a budget. */
    printf("%s: %s\n  %s error %.3f steps of 1/255, %.3f ms [%.3f, %.3f]\n", what, text,
           kind == ERROR_INTERIOR_RMS ? "rms" : "largest", ceil(1e3 * row_error(row, kind)) / 1e3,
           row->time, row->time_lower, row->time_upper);
}

/* The settings that may be chosen. */
enum { FINALISTS = 8 };
typedef struct Finalists {
    Quality qualities[FINALISTS];
    ResultRow rows[FINALISTS]; /* as measured again */
    int count;
} Finalists;

static int unusual(const Quality *quality)
{
    int count = 0;
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        count += quality->choice[axis] != QUALITY_AXES[axis].usual;
    return count;
}

/* Rows in the order in which they are considered. */
typedef struct Entry {
    const ResultRow *row;
    double first, second;
} Entry;

static int by_order(const void *a, const void *b)
{
    const Entry *x = a, *y = b;
    const double first = x->first - y->first, second = x->second - y->second;
    return first != 0 ? (first > 0) - (first < 0) : (second > 0) - (second < 0);
}

/* Those within the limit: of error, the cheapest first; of time, the most exact first, and from
 * number `from` on. The usual setting, if within the limit, always. */
static bool select_finalists(const Survey *survey, const char *name, const ChooseLimit *limit,
                             int from, Finalists *finalists, Message *message)
{
    const Quality usual = quality_usual();
    const ResultRow **rows;
    int count, within = 0;
    *finalists = (Finalists){.count = 0};
    if (!results_latest(&survey->results, name, &rows, &count, message))
        return false;
    Entry *entries = malloc(((size_t)count + 1) * sizeof *entries);
    for (int i = 0; entries && i < count; i++) {
        const double error = row_error(rows[i], limit->kind), time = rows[i]->time;
        if (!isfinite(error) || !isfinite(time) || (limit->is_time ? time : error) > limit->value)
            continue;
        const double fewest = unusual(&rows[i]->quality);
        entries[within++] = limit->is_time
                                ? (Entry){rows[i], floor(error / FRONT_EQUAL_ERROR), fewest}
                                : (Entry){rows[i], time, fewest};
        if (from == 0 && quality_equal(&rows[i]->quality, &usual))
            finalists->qualities[finalists->count++] = usual;
    }
    if (entries)
        qsort(entries, (size_t)within, sizeof *entries, by_order);
    for (int i = from; entries && i < within && finalists->count < FINALISTS; i++)
        if (!quality_equal(&entries[i].row->quality, &usual))
            finalists->qualities[finalists->count++] = entries[i].row->quality;
    free(entries);
    free(rows);
    return entries || message_set(message, "study: not enough memory");
}

/* Of those that are again within the limit: the one that no other beats; of tied ones that with the
 * fewest unusual choices, then the most exact. NULL: none is. */
static const ResultRow *best_finalist(const Finalists *finalists, const ChooseLimit *limit)
{
    const ResultRow *first = NULL, *best = NULL;
    /* First the one with the least time or error. */
    for (int i = 0; i < finalists->count; i++) {
        const ResultRow *row = &finalists->rows[i];
        const double error = row_error(row, limit->kind);
        /* Three of four frames are within the time. */
        if ((limit->is_time ? row->time_upper : error) > limit->value)
            continue;
        if (!first ||
            (limit->is_time ? error < row_error(first, limit->kind) : row->time < first->time))
            first = row;
    }
    for (int i = 0; first && i < finalists->count; i++) {
        const ResultRow *row = &finalists->rows[i];
        const double error = row_error(row, limit->kind);
        const bool tied =
            limit->is_time ? row->time_upper <= limit->value && row_beats(row, first, limit->kind)
                           : error <= limit->value && !row_faster(first, row);
        const int more = best ? unusual(&row->quality) - unusual(&best->quality) : -1;
        if (row != first && !tied)
            continue;
        if (!best || more < 0 || (more == 0 && error < row_error(best, limit->kind)))
            best = row;
    }
    return best;
}

static void say_ties(const Finalists *finalists, const ResultRow *best, const ChooseLimit *limit)
{
    for (int i = 0; i < finalists->count; i++) {
        const ResultRow *row = &finalists->rows[i];
        char text[QUALITY_TEXT_SIZE];
        quality_text(&row->quality, text);
        if (row != best && row_error(row, limit->kind) <= limit->value && !limit->is_time &&
            !row_faster(best, row))
            printf("tied with it: %s, %.3f ms\n", text, row->time);
    }
}

/* What less time, or less error, would cost: of the front, the last row beyond the limit. */
static void say_neighbour(const Front *front, const ChooseLimit *limit)
{
    const ResultRow *neighbour = NULL;
    for (int i = 0; i < front->count; i++) {
        const ResultRow *row = front->rows[i];
        if (limit->is_time ? row->time > limit->value && !neighbour
                           : row_error(row, limit->kind) > limit->value)
            neighbour = row;
    }
    if (neighbour)
        say(limit->is_time ? "the next slower" : "the next cheaper", neighbour, limit->kind);
    else
        printf("there is none that is %s\n", limit->is_time ? "more exact" : "cheaper");
}

static bool refuse(const Front *front, const char *name, const ChooseLimit *limit, Message *message)
{
    if (front->count == 0)
        return message_set(message, "%s: no setting has been measured", name);
    if (limit->is_time)
        return message_set(message,
                           "--time-budget %g: no setting of %s is so fast; the best takes %.3f ms",
                           limit->value, name, front->rows[0]->time);
    return message_set(message, "--budget %g: no setting of %s is so exact; the best has %.3f",
                       limit->value, name, row_error(front->rows[front->count - 1], limit->kind));
}

bool choose(Survey *survey, int scene, const ChooseLimit *limit, Message *message)
{
    enum { TRIES = 4 };
    const char *name = STUDY_SCENES[scene].name;
    char with[RESULT_WITH_SIZE];
    Finalists *finalists = calloc(1, sizeof *finalists);
    Front front = {.count = 0};
    const ResultRow *best = NULL;
    bool done = (finalists || message_set(message, "study: not enough memory")) &&
                front_open(&front, &survey->results, name, limit->kind, message);
    /* Measured when other programs ran, some may no longer be within the time. */
    for (int i = 0; i < TRIES && done && !best; i++) {
        done = select_finalists(survey, name, limit, i * (FINALISTS - 1), finalists, message);
        if (!done || finalists->count == 0)
            break;
        done = survey_again(survey, scene, finalists->qualities, finalists->count, finalists->rows,
                            message);
        best = best_finalist(finalists, limit);
    }
    if (done && best) {
        say(limit->is_time ? "most exact" : "cheapest", best, limit->kind);
        say_ties(finalists, best, limit);
        say_neighbour(&front, limit);
        results_measured_with(&survey->like, with);
        if (best->noise > FRONT_NOISE_BOUND)
            printf("the machine is busy: times have a noise of %.0f%%\n", 100 * best->noise);
        printf("measured with %s\n", with);
    } else if (done) {
        done = refuse(&front, name, limit, message);
    }
    front_close(&front);
    free(finalists);
    return done;
}
