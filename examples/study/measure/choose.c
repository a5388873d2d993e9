/*
 * The best setting within a limit, from a survey that other programs disturbed: those that may be
 * best by the survey are measured again, against each other, and chosen among by these times alone.
 * Tied are those that none is surely faster than; of them the one with the fewest unusual choices
 * is named, so that two runs say the same; where the machine is busy all are. If none of the first
 * eight stays within the limit, the next are tried.
 */
#include "study/measure/survey.h"

#include "base/memory.h"
#include "study/measure/scenes.h"
#include "study/results/results.h"

#include <math.h>
#include <stdlib.h>

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
    double slack;
    int from;
    Quality qualities[FINALISTS];
    ResultRow rows[FINALISTS]; /* as measured again */
    int count;
} Finalists;

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

/* Those within the limit: of error, the cheapest first; of time, or finalists->slack times that,
 * the most exact first; from number finalists->from on. The usual setting, if within the limit,
 * always. */
static void select_finalists(const Survey *survey, const char *name, const ChooseLimit *limit,
                             Finalists *finalists)
{
    const Quality usual = quality_usual();
    int count, within = 0;
    const ResultRow **rows = results_latest(&survey->results, name, &count);
    Entry *entries = memory_new((size_t)count, sizeof *entries);
    finalists->count = 0;
    for (int i = 0; i < count; i++) {
        const double error = row_error(rows[i], limit->kind), time = rows[i]->time;
        if (!isfinite(error) || !isfinite(time) ||
            (limit->is_time ? time / finalists->slack : error) > limit->value)
            continue;
        const double fewest = quality_unusual(&rows[i]->quality);
        entries[within++] = limit->is_time
                                ? (Entry){rows[i], floor(error / FRONT_EQUAL_ERROR), fewest}
                                : (Entry){rows[i], time, fewest};
        if (finalists->from == 0 && quality_equal(&rows[i]->quality, &usual))
            finalists->qualities[finalists->count++] = usual;
    }
    qsort(entries, (size_t)within, sizeof *entries, by_order);
    for (int i = finalists->from; i < within && finalists->count < FINALISTS; i++)
        if (!quality_equal(&entries[i].row->quality, &usual))
            finalists->qualities[finalists->count++] = entries[i].row->quality;
    free(entries);
    free(rows);
}

/* The share by which the next measurement may differ: the noise, which on a busy machine says more
 * of the others than of this setting. */
static double margin(const ResultRow *row)
{
    static const double MIN = 0.02, MAX = 0.1;
    return isfinite(row->noise) ? fmin(fmax(row->noise, MIN), MAX) : MAX;
}

static double surely(const ResultRow *row)
{
    return row->time * (1 + margin(row));
}

/* Of time: another measurement may come to the other conclusion. Two runs on a machine that is busy
 * in one of them differ by more than the noise within either: by up to a tenth. */
static bool is_at_limit(const ResultRow *row, const ChooseLimit *limit)
{
    static const double BETWEEN_RUNS = 0.1;
    const double least = fmin(row->time_lower, surely(row) * (1 - BETWEEN_RUNS));
    const double most = fmax(row->time_upper, surely(row) * (1 + BETWEEN_RUNS));
    return limit->is_time && least <= limit->value && most > limit->value;
}

static bool is_within(const ResultRow *row, const ChooseLimit *limit)
{
    return (limit->is_time ? surely(row) : row_error(row, limit->kind)) <= limit->value;
}

static double noise_of(const ResultRow *rows, int count)
{
    return front_noise(&(Results){.rows = (ResultRow *)rows, .count = count}, NULL);
}

/* Whether a row within the limit is the best or cannot be told from it. Of error: no other that is
 * within is surely faster; of time: none is more exact. */
static bool is_among_best(const ResultRow *row, const ResultRow *rows, int count,
                          const ChooseLimit *limit)
{
    const bool busy = noise_of(rows, count) > FRONT_NOISE_BOUND;
    bool best = is_within(row, limit);
    for (int i = 0; i < count && best; i++)
        if (is_within(&rows[i], limit))
            best = limit->is_time ? row_error(row, limit->kind) <
                                        row_error(&rows[i], limit->kind) + FRONT_EQUAL_ERROR
                                  : busy || !row_faster(&rows[i], row);
    return best;
}

const ResultRow *choose_among(const ResultRow *rows, int count, const ChooseLimit *limit)
{
    const ResultRow *best = NULL;
    for (int i = 0; i < count; i++) {
        const ResultRow *row = &rows[i];
        const int more =
            best ? quality_unusual(&row->quality) - quality_unusual(&best->quality) : -1;
        if (is_among_best(row, rows, count, limit) &&
            (more < 0 || (more == 0 && row_error(row, limit->kind) < row_error(best, limit->kind))))
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
        if (row != best && is_among_best(row, finalists->rows, finalists->count, limit))
            printf("tied with it: %s, %.3f ms\n", text, row->time);
        else if (is_at_limit(row, limit) && !is_within(row, limit) &&
                 row_error(row, limit->kind) < row_error(best, limit->kind) + FRONT_EQUAL_ERROR)
            printf("%s exact, but not surely within the time: %s, %.3f ms [%.3f, %.3f]\n",
                   row_error(row, limit->kind) < row_error(best, limit->kind) - FRONT_EQUAL_ERROR
                       ? "more"
                       : "as",
                   text, row->time, row->time_lower, row->time_upper);
    }
    /* What a run chooses that finds these too slow. */
    const ResultRow *next = best;
    for (ChooseLimit less = *limit; next && is_at_limit(next, limit);) {
        less.value = nextafter(surely(next), 0);
        next = choose_among(finalists->rows, finalists->count, &less);
        if (next &&
            row_error(next, limit->kind) >= row_error(best, limit->kind) + FRONT_EQUAL_ERROR)
            say("if the next measurement finds that too slow", next, limit->kind);
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

/* On a busy machine nothing that a comparison of times says. */
static void report(const Survey *survey, const Finalists *finalists, const Front *front,
                   const ResultRow *best, const ChooseLimit *limit)
{
    char with[RESULT_WITH_SIZE];
    const double noise = noise_of(finalists->rows, finalists->count);
    const bool busy = noise > FRONT_NOISE_BOUND;
    if (busy)
        printf("the machine is busy: half these times have a noise of at least %.0f%%; none is "
               "compared\n",
               100 * noise);
    say(limit->is_time ? "most exact" : busy ? "most usual" : "cheapest", best, limit->kind);
    if (!busy)
        say_ties(finalists, best, limit);
    if (!busy && !front->busy)
        say_neighbour(front, limit);
    results_measured_with(&survey->like, with);
    printf("measured with %s\n", with);
}

static bool refuse(const Front *front, const char *name, const ChooseLimit *limit, Message *message)
{
    if (front->count == 0)
        return message_set(message, "%s: no setting has been measured", name);
    if (limit->is_time)
        return message_set(
            message, "--time-budget %g: no setting of %s is so fast; the best takes %.3f ms%s",
            limit->value, name, front->rows[0]->time,
            front->busy ? ", measured on a busy machine" : "");
    return message_set(message, "--budget %g: no setting of %s is so exact; the best has %.3f",
                       limit->value, name, row_error(front->rows[front->count - 1], limit->kind));
}

bool choose(Survey *survey, int scene, const ChooseLimit *limit, Message *message)
{
    enum { TRIES = 6, LOOSE = 2 };
    static const double SLACK = 1.5;
    const char *name = STUDY_SCENES[scene].name;
    Finalists *finalists = memory_new(1, sizeof *finalists);
    Front front;
    const ResultRow *best = NULL;
    bool done = true;
    front_find(&front, &survey->results, name, limit->kind);
    /* Measured when other programs ran, some may no longer be within the time, and some now be. */
    for (int i = 0; i < TRIES && done && !best; i++) {
        const bool loose = limit->is_time && i < LOOSE;
        finalists->from = (i < LOOSE || !limit->is_time ? i : i - LOOSE) * (FINALISTS - 1);
        finalists->slack = loose ? SLACK : 1;
        select_finalists(survey, name, limit, finalists);
        if (finalists->count == 0 && !loose)
            break;
        if (finalists->count == 0)
            continue;
        done = survey_again(survey, scene, finalists->qualities, finalists->count, finalists->rows,
                            message);
        best = choose_among(finalists->rows, finalists->count, limit);
    }
    if (done && best)
        report(survey, finalists, &front, best, limit);
    else if (done)
        done = refuse(&front, name, limit, message);
    front_close(&front);
    free(finalists);
    return done;
}
