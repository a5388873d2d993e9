/*
 * Two surveys of the same scenes and settings, by two drivers or machines. Milliseconds of two
 * machines say nothing of a setting: compared is its time over that of the usual setting of the
 * same survey, in each of its three runs. Two such ratios differ if all of the one's runs are on
 * one side of all of the other's.
 */
#include "study/report/compare.h"

#include "base/output.h"
#include "study/measure/scenes.h"
#include "study/results/results.h"
#include "study/results/table.h"

#include <math.h>
#include <stdlib.h>

/* Errors that differ by less are the same. */
static const double EQUAL_STEPS = 0.05;

/* Of a row over the usual one: the median, and the range of its runs; NAN: unknown. */
typedef struct Ratio {
    double middle, low, high;
} Ratio;

typedef struct Pair {
    const Results *results;
    bool all; /* are printed */
    Table table;
    int rows, errors, timed, times; /* in both; with other errors; with known times; with others */
    double most;                    /* difference of errors */
    char at[QUALITY_TEXT_SIZE + 40];
} Pair;

static Ratio ratio_of(const Results *results, const ResultRow *row)
{
    const ResultRow *usual = results_of(results, row->scene, "usual");
    if (!usual || front_busy(results, row->scene))
        return (Ratio){.middle = NAN};
    const double middle = row->time / usual->time;
    Ratio ratio = {middle, middle, middle};
    for (int i = 0; i < RESULT_RUNS; i++) {
        ratio.low = fmin(ratio.low, row->run_times[i] / usual->run_times[i]);
        ratio.high = fmax(ratio.high, row->run_times[i] / usual->run_times[i]);
    }
    return ratio;
}

/* "1.80, 1.72 to 1.93". */
static void put_ratio(char text[48], const Ratio *ratio)
{
    if (isfinite(ratio->middle))
        snprintf(text, 48, "%.2f, %.2f to %.2f", ratio->middle, ratio->low, ratio->high);
    else
        snprintf(text, 48, "too noisy");
}

/* A setting in both. */
static void add_row(Pair *pair, const ResultRow *a, const ResultRow *b)
{
    const Ratio first = ratio_of(&pair->results[0], a), second = ratio_of(&pair->results[1], b);
    const double more = b->interior_maximum - a->interior_maximum;
    const bool timed = isfinite(first.middle) && isfinite(second.middle);
    const bool apart = timed && (first.high < second.low || second.high < first.low);
    char setting[QUALITY_TEXT_SIZE], ratios[3][48] = {"", "", ""};
    quality_text(&a->quality, setting);
    put_ratio(ratios[0], &first);
    put_ratio(ratios[1], &second);
    if (timed)
        snprintf(ratios[2], sizeof ratios[2], apart ? "x %.2f, %.2f to %.2f" : "the same",
                 second.middle / first.middle, second.low / first.high, second.high / first.low);
    pair->rows++;
    pair->timed += timed;
    pair->times += apart;
    pair->errors += fabs(more) >= EQUAL_STEPS;
    if (fabs(more) > fabs(pair->most)) {
        pair->most = more;
        snprintf(pair->at, sizeof pair->at, "%s: %s", a->scene, setting);
    }
    if (pair->all || quality_unusual(&a->quality) <= 1)
        table_row(&pair->table, "%s: %s|%.2f|%.2f|%+.2f|%s|%s|%s", a->scene, setting,
                  a->interior_maximum, b->interior_maximum, more, ratios[0], ratios[1], ratios[2]);
}

static void add_scene(Pair *pair, const char *name)
{
    int count;
    const ResultRow **rows = results_latest(&pair->results[0], name, &count);
    for (int i = 0; i < count; i++) {
        const ResultRow *other = results_find(&pair->results[1], name, &rows[i]->quality);
        if (other && isfinite(rows[i]->interior_maximum) && isfinite(other->interior_maximum))
            add_row(pair, rows[i], other);
    }
    free(rows);
}

static bool read_folder(Results *results, const char *folder, Message *message)
{
    char path[PATH_MAX];
    if (!output_path(path, folder, "results.csv", message) ||
        !results_read(results, path, NULL, message))
        return false;
    return results->count > 0 ||
           message_set(message, "%s: has no results; accuracy -o %s measures them", path, folder);
}

static void say_all(const Pair *pair, const char *const folders[2], FILE *file)
{
    for (int i = 0; i < 2; i++) {
        char with[RESULT_WITH_SIZE];
        results_with(&pair->results[i], with);
        fprintf(file, "%c, %s: %s\n", "AB"[i], folders[i], with);
    }
    fprintf(file, "%d settings are in both; %d have another error in B%s%s\n", pair->rows,
            pair->errors, pair->errors ? ", most of all " : "", pair->errors ? pair->at : "");
    fprintf(file,
            "%d of the %d with known times take another multiple of the usual setting's time\n\n",
            pair->times, pair->timed);
}

bool compare_folders(const char *const folders[2], bool all, FILE *file, Message *message)
{
    Results results[2] = {{.rows = NULL}, {.rows = NULL}};
    Pair pair = {.results = results, .all = all};
    bool done = read_folder(&results[0], folders[0], message) &&
                read_folder(&results[1], folders[1], message);
    table_open(&pair.table, "setting|error A|B|B - A|time over the usual: A|B|B / A");
    for (int i = 0; i < STUDY_SCENE_COUNT && done; i++)
        add_scene(&pair, STUDY_SCENES[i].name);
    if (done && !pair.rows)
        done = message_set(message, "%s and %s: have no setting of a scene in common", folders[0],
                           folders[1]);
    if (done) {
        say_all(&pair, folders, file);
        table_close(&pair.table, false, file);
    } else {
        free(output_text_close(&pair.table.rows));
    }
    results_close(&results[0]);
    results_close(&results[1]);
    return done;
}
