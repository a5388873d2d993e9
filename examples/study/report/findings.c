/*
 * The conclusions that tables and plots show: each compares rows of a survey that differ in one
 * choice alone, so that the difference is of that choice. What was not measured leaves a gap, not a
 * row of zeros.
 */
#include "study/report/conclusions.h"

#include "base/clock.h"
#include "study/measure/scenes.h"
#include "study/measure/setting_picture.h"
#include "study/report/report.h"
#include "study/report/report_gnuplot.h"
#include "study/results/results.h"
#include "study/results/table.h"

#include <math.h>

/* Error over time: curves, each from a setting on along one axis. */

enum { MAX_CURVES = 4 };

typedef struct CurvePlot {
    const char *file, *scene, *title, *y;
    ErrorKind kind;
    struct {
        const char *name, *setting; /* no name: no more */
        QualityAxis axis;
    } curves[MAX_CURVES];
} CurvePlot;

static const CurvePlot CURVE_PLOTS[] = {
    {"finding-interpolation",
     "shiny32",
     "Interpolation: shiny32, with 6, 8, 12 ... 512 divisions from left to right",
     "largest error inside, in steps of 1/255",
     ERROR_INTERIOR_MAXIMUM,
     {{"Phong", "usual", AXIS_DIVISIONS},
      {"Gouraud", "interpolation=gouraud", AXIS_DIVISIONS},
      {"flat", "interpolation=flat", AXIS_DIVISIONS}}},
    {"finding-antialiasing",
     "sphere",
     "Antialiasing: sphere",
     "root mean square error of all pixels, in steps of 1/255",
     ERROR_ALL_RMS,
     {{"0 and 4 samples, 64 divisions", "usual", AXIS_SAMPLES},
      {"1, 2x2, 3x3, 4x4 supersampling, 64 divisions", "usual", AXIS_SUPERSAMPLE},
      {"0 and 4 samples, 128 divisions", "divisions=128", AXIS_SAMPLES},
      {"1, 2x2, 3x3, 4x4 supersampling, 128 divisions", "divisions=128", AXIS_SUPERSAMPLE}}},
};

static bool plot_curves(const Results *results, const CurvePlot *of, const char *foot,
                        const char *folder, Message *message)
{
    const ReportAxes axes = {.foot = foot,
                             .title = of->title,
                             .x = "time of a frame in ms",
                             .y = of->y,
                             .log_x = true,
                             .log_y = true};
    double x[MAX_CURVES][QUALITY_MAX_CHOICES], y[MAX_CURVES][QUALITY_MAX_CHOICES];
    ReportSeries series[MAX_CURVES];
    int count = 0, points = 0;
    if (front_busy(results, of->scene))
        return gnuplot_forget(folder, of->file, message);
    for (; count < MAX_CURVES && of->curves[count].name; count++) {
        const QualityAxis axis = of->curves[count].axis;
        Quality quality;
        int here = 0;
        quality_parse(&quality, of->curves[count].setting, NULL);
        for (int choice = 0; choice < QUALITY_AXES[axis].count; choice++) {
            quality = quality_with(quality, axis, choice);
            const ResultRow *row = results_find(results, of->scene, &quality);
            if (!row)
                continue;
            x[count][here] = row->time;
            y[count][here++] = row_error(row, of->kind);
        }
        series[count] = (ReportSeries){of->curves[count].name, x[count], y[count], here};
        points += here;
    }
    return points == 0 || report_curves(&axes, series, count, folder, of->file, message);
}

/* Bars from 0: one or two values per category, each with a whisker. */

enum { MAX_BARS = 12, FEW_BARS = 6 };

typedef struct Bar {
    double value, low, high;
} Bar;

typedef struct Bars {
    const char *title, *y;
    const char *names[2]; /* of the values; the second may be NULL */
    const char *foot;     /* as in ReportAxes */
    struct {
        char name[48], note[48];
        Bar values[2];
    } bars[MAX_BARS];
    int count;
} Bars;

/* Returns its largest number. Notes are shown if there are few bars. */
static double set_bar(TemplateValues *plot, const Bars *bars, int number, int values)
{
    TemplateValues *bar = template_add(plot, "bar");
    double max = 0;
    template_set(bar, "comma", "%s", number ? ", " : "");
    template_set(bar, "number", "%d", number);
    gnuplot_set(bar, "name", bars->bars[number].name);
    if (bars->count <= FEW_BARS)
        gnuplot_set(bar, "note", bars->bars[number].note);
    for (int k = 0; k < values; k++) {
        const Bar of = bars->bars[number].values[k];
        TemplateValues *value = template_add(bar, "value");
        template_set(value, "middle", "%.9g", of.value);
        template_set(value, "low", "%.9g", of.low);
        template_set(value, "high", "%.9g", of.high);
        max = fmax(max, fmax(of.value, of.high));
    }
    return max;
}

static bool draw_bars(const Bars *bars, const char *folder, const char *name, Message *message)
{
    const int values = bars->names[1] ? 2 : 1;
    const double width = 0.7 / values;
    double max = 0;
    if (bars->count == 0)
        return true;
    TemplateValues *plot = gnuplot_values(bars->title, bars->foot);
    gnuplot_set(plot, "y", bars->y);
    template_set(plot, "right", "%g", bars->count - 0.4);
    template_set(plot, "turn", "%s", bars->count <= FEW_BARS ? "norotate" : "rotate by -35");
    template_set(plot, "width", "%g", width);
    for (int i = 0; i < bars->count; i++)
        max = fmax(max, set_bar(plot, bars, i, values));
    /* Room for the key above the bars. */
    gnuplot_set_axis(plot, 'y', 0, max * (1.08 + 0.08 * values), false);
    for (int k = 0; k < values; k++) {
        TemplateValues *box = template_add(plot, "box");
        template_set(box, "comma", "%s", k ? ", \\\n  " : "");
        template_set(box, "offset", "%g", width * (k - 0.5 * (values - 1)));
        template_set(box, "middle", "%d", 3 * k + 1); /* the columns of the value */
        template_set(box, "low", "%d", 3 * k + 2);
        template_set(box, "high", "%d", 3 * k + 3);
        template_set(box, "color", "%s", GNUPLOT_PALETTE[k]);
        gnuplot_set(box, "name", bars->names[k]);
    }
    return gnuplot_draw("examples/study/report/bars.gp", plot, folder, name, message);
}

_Static_assert((int)STUDY_SCENE_COUNT <= (int)MAX_BARS, "a bar for each scene");

/* The values of a scene's bars, from its usual row and the one with the setting. */
typedef void FillBar(const ResultRow *usual, const ResultRow *other, Bar values[2]);

/* A plot of a setting's bars, scene by scene. */
typedef struct ByScene {
    const char *file, *quality, *title, *y, *names[2];
    FillBar *fill;
    bool timed;
} ByScene;

static bool plot_by_scene(const Results *results, const ByScene *of, const char *foot,
                          const char *folder, Message *message)
{
    Bars drawn = {.title = of->title, .y = of->y, .names = {of->names[0], of->names[1]}},
         *bars = &drawn;
    bars->foot = foot;
    for (int i = 0; i < STUDY_SCENE_COUNT; i++) {
        const char *scene = STUDY_SCENES[i].name;
        const ResultRow *usual = results_of(results, scene, "usual");
        const ResultRow *other = results_of(results, scene, of->quality);
        if (!usual || !other || (of->timed && front_busy(results, scene)))
            continue;
        snprintf(bars->bars[bars->count].name, sizeof bars->bars[0].name, "%s", scene);
        Bar *values = bars->bars[bars->count].values;
        of->fill(usual, other, values);
        if (isfinite(values[0].value) && (!bars->names[1] || isfinite(values[1].value)))
            bars->count++;
    }
    return of->timed && bars->count == 0 ? gnuplot_forget(folder, of->file, message)
                                         : draw_bars(bars, folder, of->file, message);
}

/* The root mean square, and up to the largest. */
static Bar error_bar(const ResultRow *row)
{
    return (Bar){row->interior_rms, row->interior_rms, row->interior_maximum};
}

static void fill_errors(const ResultRow *usual, const ResultRow *other, Bar values[2])
{
    values[0] = error_bar(usual);
    values[1] = error_bar(other);
}

/* A ratio of times, and the noise of both. */
static void fill_guards(const ResultRow *usual, const ResultRow *other, Bar values[2])
{
    const double ratio = usual->time / other->time, noise = fmax(usual->noise, other->noise);
    values[0] = (Bar){ratio, ratio / (1 + noise), ratio * (1 + noise)};
}

static bool plot_by_scenes(const Results *results, const char *foot, const char *folder,
                           Message *message)
{
    static const char errors[] = "rms, and up to the largest; steps of 1/255";
    static const ByScene plots[] = {
        {"finding-precision",
         "precision=mediump",
         "Precision of fragment shaders: the error inside the objects",
         errors,
         {"highp", "mediump"},
         fill_errors,
         false},
        {"finding-guards",
         "guards=off",
         "Guards: the time of a frame with them, over that without",
         "ratio of times, and the noise",
         {"with guards over without", NULL},
         fill_guards,
         true},
        {"finding-viewer",
         "viewer=infinite",
         "A viewer at infinity: the error inside the objects",
         errors,
         {"local viewer", "infinite viewer"},
         fill_errors,
         false},
    };
    bool done = true;
    for (size_t i = 0; i < sizeof plots / sizeof plots[0] && done; i++)
        done = plot_by_scene(results, &plots[i], foot, folder, message);
    return done;
}

/* Matrices. */

static const char *const COMPOSITIONS[] = {
    "usual",
    "matrices=float",
    "matrices=compensated",
    "order=lecture",
    "matrices=float order=lecture",
    "matrices=compensated order=lecture",
};
enum { COMPOSITION_COUNT = sizeof COMPOSITIONS / sizeof COMPOSITIONS[0] };

/* Nanoseconds for one object's matrices and one light's position: the median of some runs. */
static double time_composition(const char *text)
{
    enum { RUNS = 15, TIMES = 2000 };
    double nanoseconds[RUNS];
    volatile double kept = 0; /* so that nothing is optimized away */
    StudyScene made;
    Quality quality;
    Mat4 eye_from_world, clip_from_eye;
    study_scene(study_scene_number("far"), &made);
    if (!quality_parse(&quality, text, NULL) ||
        !scene_camera(&made.scene.camera, 1, &eye_from_world, &clip_from_eye, NULL))
        return NAN;
    const LightingTransforms *transforms = transforms_of(&quality);
    transforms = transforms ? transforms : &LIGHTING_TRANSFORMS;
    Mat4 world_from_object = made.objects[0].world_from_object;
    for (int run = 0; run < RUNS; run++) {
        const double start = clock_now();
        for (int i = 0; i < TIMES; i++) {
            world_from_object.m[12] += 1;
            const Mat4 eye_from_object =
                transforms->eye_from_object(&made.scene.camera, eye_from_world, world_from_object);
            const Mat4 clip_from_object = transforms->clip_from_object(
                clip_from_eye, eye_from_world, world_from_object, eye_from_object);
            const Vec3 light =
                transforms->eye_point(&made.scene.camera, eye_from_world, made.lights[0].position);
            kept = kept + clip_from_object.m[12] + light.x;
        }
        nanoseconds[run] = 1e9 * (clock_now() - start) / TIMES;
    }
    return clock_median(nanoseconds, RUNS);
}

void findings_matrices(const Results *results, bool markdown, FILE *file)
{
    char with[RESULT_WITH_SIZE];
    Table table;
    results_with(results, with);
    table_open(&table, "setting|ns|largest interior error, steps of 1/255");
    for (int i = 0; i < COMPOSITION_COUNT; i++) {
        const ResultRow *row = results_of(results, "far", COMPOSITIONS[i]);
        char error[32] = "not measured";
        if (row)
            snprintf(error, sizeof error, "%.2f", row->interior_maximum);
        table_row(&table, "%s|%.0f|%s", COMPOSITIONS[i], time_composition(COMPOSITIONS[i]), error);
    }
    fprintf(file,
            "\nMatrices of one object and position of one light; scene far, a million units from "
            "the origin\n%s\n\n",
            with);
    table_close(&table, markdown, file);
}

/* Tables for a page. */

/* "1.34", and the time in ms or over `usual`; empty if not measured. */
static void put_cells(char text[64], const ResultRow *row, const ResultRow *usual, ErrorKind kind)
{
    char time[24] = "same";
    if (row && !(usual && usual != row && !row_faster(row, usual) && !row_faster(usual, row)))
        snprintf(time, sizeof time, "%.2f", row->time / (usual ? usual->time : 1));
    if (row)
        snprintf(text, 64, "%.2f|%s", row_error(row, kind), time);
    else
        snprintf(text, 64, "|");
}

static void table_interpolation(const Results *results, FILE *file)
{
    const QualityAxisInfo *divisions = &QUALITY_AXES[AXIS_DIVISIONS];
    Table table;
    table_open(&table, "divisions|Phong: error|ms|Gouraud: error|ms|flat: error|ms");
    for (int i = 0; i < divisions->count; i++) {
        char cells[3][64];
        bool any = false;
        for (int k = 0; k < 3; k++) {
            const Quality quality = quality_with(
                quality_with(quality_usual(), AXIS_INTERPOLATION, k), AXIS_DIVISIONS, i);
            const ResultRow *row = results_find(results, "shiny32", &quality);
            any = any || row;
            put_cells(cells[k], row, NULL, ERROR_INTERIOR_MAXIMUM);
        }
        if (any)
            table_row(&table, "%s|%s|%s|%s", divisions->choices[i], cells[0], cells[1], cells[2]);
    }
    fputs("\nInterpolation and fineness of the mesh, scene shiny32:\n\n", file);
    table_close(&table, true, file);
}

static void table_by_scene(const Results *results, FILE *file)
{
    static const char *const columns[] = {"precision=mediump", "guards=off", "viewer=infinite",
                                          "lights=infinite"};
    enum { COUNT = sizeof columns / sizeof columns[0] };
    Table table;
    table_open(&table, "scene|usual: error|ms|`mediump`: error|time|without guards: error|time|"
                       "infinite viewer: error|time|infinite lights: error|time");
    for (int i = 0; i < STUDY_SCENE_COUNT; i++) {
        const char *scene = STUDY_SCENES[i].name;
        const ResultRow *usual = results_of(results, scene, "usual");
        char first[64], cells[COUNT][64];
        if (!usual)
            continue;
        put_cells(first, usual, NULL, ERROR_INTERIOR_MAXIMUM);
        for (int k = 0; k < COUNT; k++)
            put_cells(cells[k], results_of(results, scene, columns[k]), usual,
                      ERROR_INTERIOR_MAXIMUM);
        table_row(&table, "%s|%s|%s|%s|%s|%s", scene, first, cells[0], cells[1], cells[2],
                  cells[3]);
    }
    fputs("\nOne choice changed, scene by scene; times over the usual one, \"same\" within the "
          "noise:\n\n",
          file);
    table_close(&table, true, file);
}

static void table_antialiasing(const Results *results, FILE *file)
{
    static const char *const ways[] = {"samples=0", "samples=4", "supersample=2", "supersample=3",
                                       "supersample=4"};
    const ResultRow *usual = results_of(results, "sphere", "usual");
    Table table;
    table_open(&table, "antialiasing|64 divisions: rms|time|128 divisions: rms|time");
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        char fine[64], cells[2][64];
        snprintf(fine, sizeof fine, "%s divisions=128", ways[i]);
        put_cells(cells[0], results_of(results, "sphere", ways[i]), usual, ERROR_ALL_RMS);
        put_cells(cells[1], results_of(results, "sphere", fine), usual, ERROR_ALL_RMS);
        table_row(&table, "%s|%s|%s", ways[i], cells[0], cells[1]);
    }
    fputs("\nAntialiasing, scene sphere; root mean square error of all pixels:\n\n", file);
    table_close(&table, true, file);
}

void findings_tables(const Results *results, FILE *file)
{
    table_interpolation(results, file);
    table_by_scene(results, file);
    table_antialiasing(results, file);
}

static bool plot_matrices(const Results *results, const char *foot, const char *folder,
                          Message *message)
{
    static const char *const names[COMPOSITION_COUNT] = {
        "double", "float", "compensated", "double, lect.", "float, lect.", "comp., lect."};
    Bars bars = {.foot = foot,
                 .title = "Matrices, a million units from the origin: the error inside",
                 .y = "rms, and up to the largest; steps of 1/255",
                 .names = {"relative to the eye; lect.: in the lecture's order", NULL}};
    for (int i = 0; i < COMPOSITION_COUNT; i++) {
        const ResultRow *row = results_of(results, "far", COMPOSITIONS[i]);
        if (!row || !isfinite(row->interior_maximum))
            continue;
        snprintf(bars.bars[bars.count].name, sizeof bars.bars[0].name, "%s", names[i]);
        snprintf(bars.bars[bars.count].note, sizeof bars.bars[0].note, "%.0f ns",
                 time_composition(COMPOSITIONS[i]));
        bars.bars[bars.count++].values[0] = error_bar(row);
    }
    if (bars.count < 2)
        return true; /* nothing to compare */
    return draw_bars(&bars, folder, "finding-matrices", message);
}

bool findings_plot(const Results *results, const char *folder, Message *message)
{
    char foot[RESULT_WITH_SIZE];
    results_with(results, foot);
    bool done = true;
    for (size_t i = 0; i < sizeof CURVE_PLOTS / sizeof CURVE_PLOTS[0] && done; i++)
        done = plot_curves(results, &CURVE_PLOTS[i], foot, folder, message);
    return done && plot_by_scenes(results, foot, folder, message) &&
           plot_matrices(results, foot, folder, message);
}
