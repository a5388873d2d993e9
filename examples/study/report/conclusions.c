#include "study/report/conclusions.h"

#include "study/measure/scenes.h"
#include "study/results/results.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Errors above the smallest one by this share are as good. */
static const double SLACK = 1.001;

/* Of a scene's rows with this interpolation: the smallest error; the fastest with at most `limit`.
 * NAN and NULL: there are none. */
static double least_error(const Results *results, const char *scene, int interpolation)
{
    double least = NAN;
    for (int i = 0; i < results->count; i++) {
        const ResultRow *row = &results->rows[i];
        if (strcmp(row->scene, scene) == 0 &&
            row->quality.choice[AXIS_INTERPOLATION] == interpolation && isfinite(row->time))
            least = fmin(least, row->interior_maximum);
    }
    return least;
}

static const ResultRow *fastest(const Results *results, const char *scene, int interpolation,
                                double limit)
{
    const ResultRow *best = NULL;
    for (int i = 0; i < results->count; i++) {
        const ResultRow *row = &results->rows[i];
        if (strcmp(row->scene, scene) != 0 ||
            row->quality.choice[AXIS_INTERPOLATION] != interpolation ||
            results_find(results, scene, &row->quality) != row) /* a later one counts */
            continue;
        if (row->interior_maximum <= limit && (!best || row->time < best->time))
            best = row;
    }
    return best;
}

/* Two significant digits. */
static void put_time(char text[24], double milliseconds)
{
    snprintf(text, 24, milliseconds < 9.95 ? "%.1f ms" : "%.0f ms", milliseconds);
}

void conclusion_of_scene(const Results *results, const char *scene, char text[CONCLUSION_SIZE])
{
    const double phong = least_error(results, scene, INTERPOLATION_PHONG);
    const double gouraud = least_error(results, scene, INTERPOLATION_GOURAUD);
    const double limit = fmax(phong, gouraud) * SLACK;
    const ResultRow *first = fastest(results, scene, INTERPOLATION_PHONG, limit);
    const ResultRow *second = fastest(results, scene, INTERPOLATION_GOURAUD, limit);
    char times[2][24];
    text[0] = '\0';
    if (isnan(phong) || isnan(gouraud) || !first || !second || front_busy(results, scene))
        return;
    put_time(times[0], first->time);
    put_time(times[1], second->time);
    const bool tied = !row_faster(first, second) && !row_faster(second, first);
    int used = snprintf(text, CONCLUSION_SIZE, "%.*f steps: Phong interpolation %s, Gouraud %s",
                        limit < 9.95, limit / SLACK, times[0], times[1]);
    if (tied)
        snprintf(text + used, (size_t)(CONCLUSION_SIZE - used), " (the same within the noise)");
}

__attribute__((format(printf, 2, 3))) static void add(Conclusions *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(to->lines[to->count++], CONCLUSION_SIZE, format, arguments);
    va_end(arguments);
}

/* One choice changed, over some scenes. */
typedef struct Change {
    int count;           /* scenes */
    int timed, same;     /* those with times; of these those the same within the noise */
    double most;         /* by how many steps the error grows */
    const char *at_most; /* the scene */
    double slow[2];      /* the time over the usual one: least, most */
} Change;

static Change change_of(const Results *results, const int *scenes, int count, const char *setting)
{
    Change change = {.slow = {INFINITY, 0}, .most = -INFINITY};
    for (int i = 0; i < count; i++) {
        const char *scene = STUDY_SCENES[scenes[i]].name;
        const ResultRow *usual = results_of(results, scene, "usual");
        const ResultRow *other = results_of(results, scene, setting);
        const double more =
            usual && other ? other->interior_maximum - usual->interior_maximum : NAN;
        if (!isfinite(more))
            continue;
        const double ratio = other->time / usual->time;
        change.count++;
        if (more > change.most) {
            change.most = more;
            change.at_most = scene;
        }
        if (front_busy(results, scene))
            continue;
        change.timed++;
        change.same += !row_faster(usual, other) && !row_faster(other, usual);
        change.slow[0] = fmin(change.slow[0], ratio);
        change.slow[1] = fmax(change.slow[1], ratio);
    }
    return change;
}

/* "time x 0.97 to 1.05, within the noise in 9 of 12 scenes" */
static void put_change_time(char text[96], const Change *change)
{
    if (change->timed == 0)
        snprintf(text, 96, "time: too noisy to tell");
    else if (change->same == change->timed)
        snprintf(text, 96, "time the same within the noise");
    else if (change->timed == 1)
        snprintf(text, 96, "time x %.2f", change->slow[0]);
    else
        snprintf(text, 96, "time x %.2f to %.2f, within the noise in %d of %d scenes",
                 change->slow[0], change->slow[1], change->same, change->timed);
}

static void add_changes(Conclusions *to, const Results *results, const int *scenes, int count)
{
    static const struct {
        const char *setting, *name;
    } changes[] = {{"precision=mediump", "mediump"},
                   {"viewer=infinite", "a viewer at infinity"},
                   {"lights=infinite", "lights at infinity"},
                   {"guards=off", "without guards"}};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        const Change change = change_of(results, scenes, count, changes[i].setting);
        char time[96];
        put_change_time(time, &change);
        if (change.count && change.most < 0.05)
            add(to, "%s: no larger error; %s", changes[i].name, time);
        else if (change.count)
            add(to, "%s: the error grows by up to %.1f steps (%s); %s", changes[i].name,
                change.most, change.at_most, time);
    }
}

static void add_antialiasing(Conclusions *to, const Results *results, const char *scene)
{
    const ResultRow *usual = results_of(results, scene, "usual");
    const ResultRow *samples = results_of(results, scene, "samples=4");
    const ResultRow *finest = results_of(results, scene, "supersample=4");
    char more[64] = "";
    if (!usual || !samples)
        return;
    if (finest)
        snprintf(more, sizeof more, ", 4x4 supersampling %.2f", finest->all_rms);
    add(to, "antialiasing (%s): rms error of all pixels %.2f steps, with 4 samples %.2f%s", scene,
        usual->all_rms, samples->all_rms, more);
}

static void add_matrices(Conclusions *to, const Results *results)
{
    const ResultRow *usual = results_of(results, "far", "usual");
    const ResultRow *floats = results_of(results, "far", "matrices=float");
    const ResultRow *lecture = results_of(results, "far", "matrices=float order=lecture");
    if (usual && floats && lecture)
        add(to,
            "matrices (far): error %.2f steps in double, %.0f in float, %.0f in the lecture's order",
            usual->interior_maximum, floats->interior_maximum, lecture->interior_maximum);
}

Conclusions conclusions_of(const Results *results, const int *scenes, int count,
                           const ModelsApart *apart)
{
    Conclusions to = {.count = 0};
    const int shiny = study_scene_number("shiny32");
    const double noise = front_noise(results, NULL);
    int busy = 0, shown = count > 0 ? scenes[0] : 0;
    char text[CONCLUSION_SIZE];
    for (int i = 0; i < count; i++)
        shown = scenes[i] == shiny ? shiny : shown;
    for (int i = 0; i < count; i++)
        busy += front_busy(results, STUDY_SCENES[scenes[i]].name);
    to.busy = busy > 0;
    const char *scene = STUDY_SCENES[shown].name;
    if (busy)
        add(&to,
            "the machine was busy in %d of %d scenes: half the times there have a noise of more than "
            "%.0f%%; they are not compared; measure again with --fresh",
            busy, count, 100 * FRONT_NOISE_BOUND);
    else
        add(&to, "%d scene%s; half the times have a noise of at most %.0f%%", count,
            count == 1 ? "" : "s", ceil(100 * noise));
    conclusion_of_scene(results, scene, text);
    if (text[0])
        add(&to, "%s: %s", scene, text);
    add_changes(&to, results, scenes, count);
    add_antialiasing(&to, results, count == 1 ? scene : "sphere");
    add_matrices(&to, results);
    add(&to,
        "Blinn-Phong: %.0f to %.0f steps from Phong with the same exponent, %.0f to %.0f with "
        "the fitted one",
        apart->same[0], apart->same[1], apart->fitted[0], apart->fitted[1]);
    return to;
}
