#include "study/report/conclusions.h"

#include "base/clock.h"
#include "study/measure/scenes.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
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

/* The first screen */

static const Glance GLANCE_ROWS[] = {
    {.name = "mediump", .file = "mediump", .setting = "precision=mediump"},
    {.name = "Gouraud", .file = "gouraud", .setting = "interpolation=gouraud"},
    {.name = "4 samples", .file = "samples", .setting = "samples=4"},
    {.name = "viewer at infinity", .file = "viewer", .setting = "viewer=infinite"},
    {.name = "lights at infinity", .file = "lights", .setting = "lights=infinite"},
    {.name = "no guards", .file = "guards", .setting = "guards=off"},
};

double glance_bar(double ratio)
{
    return isnan(ratio) ? 0 : fmin(fmax(log2(ratio) / 2, -1), 1);
}

void glance_path(const char *file, const char *folder, char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%s/glance-%s.png", folder, file);
}

/* Errors of less than this are not to be seen in any picture, and those of less than SEEN hardly.
 */
static const double EXACT = 0.05, SEEN = 2;

/* `slower`: 1, -1 or 0: the same within the noise. */
static const char *verdict_of(int slower, double more)
{
    const int worse = (more >= EXACT) - (more <= -EXACT);
    static const char *const words[3][3] = {
        {"faster and more exact", "faster, as exact", "faster, less exact"},
        {"more exact, as fast", "changes nothing", "less exact, saves nothing"},
        {"slower, more exact", "slower, gains nothing", "slower and less exact: avoid"}};
    return worse > 0 && more < SEEN && slower < 0 ? "faster, hardly less exact"
                                                  : words[slower + 1][worse + 1];
}

/* "time x 1.80, 1.10 to 3.20" and the verdict; `slower`: of the ratios so many surely are, or,
 * below 0, are surely less. */
static void judge(Glance *glance, double *ratios, int count, int slower)
{
    glance->ratio = NAN;
    if (count == 0) {
        snprintf(glance->time, GLANCE_TEXT, "time: too noisy to tell");
        snprintf(glance->verdict, GLANCE_TEXT, "%s",
                 fabs(glance->more) < EXACT ? "as exact"
                 : glance->more > 0         ? "less exact"
                                            : "more exact");
        return;
    }
    glance->ratio = clock_median(ratios, count); /* sorts them */
    glance->least = ratios[0];
    glance->most = ratios[count - 1];
    const int used = snprintf(glance->time, GLANCE_TEXT, "time x %.2f", glance->ratio);
    if (count > 1)
        snprintf(glance->time + used, (size_t)(GLANCE_TEXT - used), ", %.2f to %.2f", glance->least,
                 glance->most);
    const bool most = 2 * abs(slower) > count;
    snprintf(glance->verdict, GLANCE_TEXT, "%s",
             verdict_of(!most        ? 0
                        : slower > 0 ? 1
                                     : -1,
                        glance->more));
}

/* One choice changed, over the scenes that have it. Samples are for edges: the error of all pixels
 * counts. */
static void add_glance(Conclusions *to, const Glance *row, const Results *results,
                       const int *scenes, int count)
{
    Glance glance = *row;
    const bool edges = strstr(row->setting, "samples") != NULL;
    double ratios[STUDY_SCENE_COUNT], from = NAN;
    int measured = 0, timed = 0, slower = 0;
    glance.more = -INFINITY;
    for (int i = 0; i < count; i++) {
        const char *scene = STUDY_SCENES[scenes[i]].name;
        const ResultRow *usual = results_of(results, scene, "usual");
        const ResultRow *other = results_of(results, scene, row->setting);
        const ErrorKind kind = edges ? ERROR_ALL_RMS : ERROR_INTERIOR_MAXIMUM;
        const double more = usual && other ? row_error(other, kind) - row_error(usual, kind) : NAN;
        if (!isfinite(more))
            continue;
        measured++;
        if (edges ? isnan(from) || strcmp(scene, "sphere") == 0 : more > glance.more) {
            from = row_error(usual, kind);
            glance.more = more;
            glance.scene = scenes[i];
        }
        if (front_busy(results, scene))
            continue;
        slower += row_faster(usual, other) - row_faster(other, usual);
        ratios[timed++] = other->time / usual->time;
    }
    if (isnan(from))
        return;
    if (edges)
        snprintf(glance.error, GLANCE_TEXT, "rms error %.1f to %.1f", from, from + glance.more);
    else
        snprintf(glance.error, GLANCE_TEXT, "error %+.*f steps", fabs(glance.more) < 9.95,
                 glance.more);
    const size_t used = strlen(glance.error);
    snprintf(glance.error + used, GLANCE_TEXT - used, ", %s", STUDY_SCENES[glance.scene].name);
    judge(&glance, ratios, 2 * timed < measured ? 0 : timed, slower); /* else few speak for all */
    to->glances[to->glance_count++] = glance;
}

/* Maps against a frame without shadows, while the light rests; volumes beside them. */
static void add_shadows(Conclusions *to, const ShadowWays *ways)
{
    ShadowMeasured volumes, map;
    int size;
    Glance *glance = &to->glances[to->glance_count];
    if (!shadow_ways_best(ways, 0, &volumes, &map, &size))
        return;
    *glance = (Glance){.name = "shadows by maps",
                       .file = "shadows",
                       .scene = -1,
                       .ratio = map.still.ratio,
                       .least = map.still.lower,
                       .most = map.still.upper,
                       .more = map.error - volumes.error};
    snprintf(glance->error, GLANCE_TEXT, "error %.1f steps, volumes %.1f", map.error,
             volumes.error);
    const bool apart =
        map.still.upper < volumes.still.lower || volumes.still.upper < map.still.lower;
    if (to->busy) {
        glance->ratio = NAN;
        snprintf(glance->time, GLANCE_TEXT, "time: too noisy to tell");
    } else {
        snprintf(glance->time, GLANCE_TEXT, "time x %.2f, volumes x %.2f", map.still.ratio,
                 volumes.still.ratio);
    }
    snprintf(glance->verdict, GLANCE_TEXT, "%s%s",
             to->busy                                ? ""
             : !apart                                ? "as fast as volumes, "
             : map.still.ratio < volumes.still.ratio ? "faster than volumes, "
                                                     : "slower than volumes, ",
             glance->more < EXACT ? "as exact" : "coarser");
    to->glance_count++;
}

static void add_matrices(Conclusions *to, const Results *results)
{
    const ResultRow *usual = results_of(results, "far", "usual");
    const ResultRow *floats = results_of(results, "far", "matrices=float");
    const ResultRow *lecture = results_of(results, "far", "matrices=float order=lecture");
    if (usual && floats && lecture)
        add(to, "matrices (far): %.2f steps in double, %.0f in float, %.0f in the lecture's order",
            usual->interior_maximum, floats->interior_maximum, lecture->interior_maximum);
}

Conclusions conclusions_of(const Results *results, const int *scenes, int count,
                           const ModelsApart *apart, const ShadowWays *ways)
{
    Conclusions to = {.count = 0};
    const int shiny = study_scene_number("shiny32");
    const double noise = front_noise(results, NULL);
    const char *driver = results->count > 0 ? results->rows[0].renderer : "no driver";
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
            "%s: the machine was busy in %d of %d scenes: half the times there have a noise of more "
            "than %.0f%%; they are not compared; measure again with --fresh",
            driver, busy, count, 100 * FRONT_NOISE_BOUND);
    else
        add(&to, "%s: %d scene%s; half the times have a noise of at most %.0f%%", driver, count,
            count == 1 ? "" : "s", ceil(100 * noise));
    conclusion_of_scene(results, scene, text);
    if (text[0])
        add(&to, "%s: %s", scene, text);
    for (size_t i = 0; i < sizeof GLANCE_ROWS / sizeof GLANCE_ROWS[0]; i++)
        add_glance(&to, &GLANCE_ROWS[i], results, scenes, count);
    add_shadows(&to, ways);
    add_matrices(&to, results);
    add(&to, "Blinn-Phong: %.0f to %.0f steps from Phong, %.0f to %.0f with a fitted exponent",
        apart->same[0], apart->same[1], apart->fitted[0], apart->fitted[1]);
    return to;
}
