#include "study/arithmetic/arithmetic.h"

#include "scene/quality.h"
#include "study/measure/scenes.h"
#include "study/report/report.h"
#include "study/results/json.h"
#include "study/results/table.h"

#include <math.h>
#include <string.h>

/* Scenes that an arithmetic draws alike. */
typedef struct SceneClass {
    const char *what, *scene;
    Interpolation interpolation;
} SceneClass;

static bool forecast_scene(const Arithmetics *found, int height, const SceneClass *of,
                           SolidMeshes *meshes, double steps[2], Message *message)
{
    const Quality quality =
        quality_with(quality_usual(), AXIS_INTERPOLATION, (int)of->interpolation);
    StudyScene study;
    SceneCopy made;
    study_scene(study_scene_number(of->scene), &study);
    if (!quality_scene_open(&made, &study.scene, &quality, meshes, message))
        return false;
    for (int i = 0; i < 2; i++)
        steps[i] = predict_scene(&made.scene, height, &found->of[METER_VERTEX][METER_HIGHP],
                                 &found->of[METER_FRAGMENT][i], &found->raster);
    scene_copy_close(&made);
    return true;
}

bool forecast_make(const Arithmetics *found, int height, Forecast *forecast, Message *message)
{
    static const SceneClass classes[FORECAST_SCENES] = {
        {"diffuse, lit per vertex", "sphere", INTERPOLATION_GOURAUD},
        {"highlight of shininess 32, lit per vertex", "shiny32", INTERPOLATION_GOURAUD},
        {"diffuse, lit per fragment", "sphere", INTERPOLATION_PHONG},
        {"highlight of shininess 8", "shiny8", INTERPOLATION_PHONG},
        {"highlight of shininess 32", "shiny32", INTERPOLATION_PHONG},
        {"highlight of shininess 128", "shiny128", INTERPOLATION_PHONG},
        {"a soft spot that fades", "spot", INTERPOLATION_PHONG},
        {"a scene 300 units wide", "wide", INTERPOLATION_PHONG},
    };
    static const double shininesses[FORECAST_SHININESSES] = {8, 32, 128};
    SolidMeshes meshes = {.first = NULL};
    bool done = true;
    forecast->height = height;
    for (int i = 0; i < FORECAST_SCENES && done; i++) {
        forecast->scenes[i] = classes[i].what;
        done = forecast_scene(found, height, &classes[i], &meshes, forecast->steps[i], message);
    }
    for (int i = 0; i < FORECAST_SHININESSES; i++) {
        forecast->shininess[i] = shininesses[i];
        for (int k = 0; k < 2; k++)
            forecast->power[i][k] = predict_pow(&found->of[METER_FRAGMENT][k], shininesses[i]);
    }
    solid_meshes_close(&meshes);
    return done;
}

/* Ways that compute alike are one column. */

enum { WAYS = METER_STAGES * METER_PRECISIONS, WAY_NAME = 64 };

typedef struct Columns {
    const Arithmetic *of[WAYS];
    char names[WAYS][WAY_NAME];
    int count;
} Columns;

static bool alike(const Arithmetic *a, const Arithmetic *b)
{
    bool same = format_equal(&a->format, &b->format);
    for (int i = 0; i < FUNCTION_COUNT; i++)
        same = same && a->accuracies[i].largest == b->accuracies[i].largest &&
               a->accuracies[i].sum == b->accuracies[i].sum &&
               a->accuracies[i].wrong == b->accuracies[i].wrong;
    return same;
}

/* "mediump, lowp" if both stages are alike, else "vertex mediump". */
static void add_name(const Arithmetics *found, int stage, int precision, char name[WAY_NAME])
{
    const bool both =
        alike(&found->of[METER_VERTEX][precision], &found->of[METER_FRAGMENT][precision]);
    const size_t used = strlen(name);
    if (both && stage == METER_FRAGMENT)
        return;
    const bool said = both || strstr(name, METER_STAGE_NAMES[stage]);
    snprintf(name + used, WAY_NAME - used, "%s%s%s%s", used ? ", " : "",
             said ? "" : METER_STAGE_NAMES[stage], said ? "" : " ",
             METER_PRECISION_NAMES[precision]);
}

static void columns_of(const Arithmetics *found, Columns *columns)
{
    *columns = (Columns){.count = 0};
    for (int stage = 0; stage < METER_STAGES; stage++)
        for (int precision = 0; precision < METER_PRECISIONS; precision++) {
            const Arithmetic *of = &found->of[stage][precision];
            int i = 0;
            while (i < columns->count && !alike(columns->of[i], of))
                i++;
            columns->of[i] = of;
            columns->count += i == columns->count;
            add_name(found, stage, precision, columns->names[i]);
        }
}

static const char *const ROUNDING_NAMES[] = {"nearest, ties to even", "nearest", "towards 0",
                                             "other"};

static const char *smaller_text(const Format *format)
{
    return format->denormals != format->denormal_inputs ? format->denormals
                                                              ? "become 0 as inputs, not as results"
                                                              : "become 0 as results, not as inputs"
           : format->denormals                          ? "are kept"
                                                        : "become 0";
}

static void put_formats(const Columns *columns, bool markdown, FILE *file)
{
    Table table;
    table_open(&table, "floats|bits|normal range|smaller ones|rounding|overflow|inf - inf");
    for (int i = 0; i < columns->count; i++) {
        const Format *format = &columns->of[i]->format;
        table_row(&table, "%s|%d|2^%d to 2^%d|%s|%s|%s|%s", columns->names[i], format->bits,
                  format->min_exponent, format->max_exponent + 1, smaller_text(format),
                  ROUNDING_NAMES[format->rounding], format->infinity ? "not finite" : "finite",
                  format->nan ? "NaN" : "a number");
    }
    table_close(&table, markdown, file);
}

static void error_text(const Accuracy *accuracy, char text[64])
{
    if (accuracy->wrong)
        snprintf(text, 64, "not finite");
    else
        snprintf(text, 64, accuracy->largest < 100 ? "%.2f, %.2f" : "%.0f, %.2f", accuracy->largest,
                 accuracy_mean(accuracy));
}

static void put_functions(const Columns *columns, bool markdown, FILE *file)
{
    Table table;
    char row[WAYS * 96] = "error in units: largest, mean";
    for (int i = 0; i < columns->count; i++)
        snprintf(row + strlen(row), sizeof row - strlen(row), "|%s", columns->names[i]);
    snprintf(row + strlen(row), sizeof row - strlen(row), "|worst at (first column)");
    table_open(&table, row);
    for (int function = 0; function < FUNCTION_COUNT; function++) {
        const FunctionInfo *info = &FUNCTIONS[function];
        const Accuracy *first = &columns->of[0]->accuracies[function];
        char text[64];
        snprintf(row, sizeof row, "%s%s%s%s", info->name, info->domain ? " (" : "",
                 info->domain ? info->domain : "", info->domain ? ")" : "");
        for (int i = 0; i < columns->count; i++) {
            error_text(&columns->of[i]->accuracies[function], text);
            snprintf(row + strlen(row), sizeof row - strlen(row), "|%s", text);
        }
        text[0] = '\0';
        if (info->inputs == 1) /* nine digits tell every float */
            snprintf(text, sizeof text, "%.9g", (double)first->at[0]);
        else if (info->inputs == 2)
            snprintf(text, sizeof text, "%.9g, %.9g", (double)first->at[0], (double)first->at[1]);
        snprintf(row + strlen(row), sizeof row - strlen(row), "|%s", text);
        table_row(&table, "%s", row);
    }
    table_close(&table, markdown, file);
}

static void put_raster(const Raster *raster, FILE *file)
{
    fprintf(file,
            "A varying is up to %.1f units off in a large triangle, %.1f where the depth varies "
            "eightfold,\n%.1f along an edge that two triangles share; in one of a few pixels by "
            "%.0f units of the corners'\ndifferences. Of %ld pixels on shared edges %ld are drawn "
            "twice and %ld not at all.\n",
            raster->flat, raster->perspective, raster->edge, raster->small, raster->edge_pixels,
            raster->edge_twice, raster->edge_missed);
    fprintf(file, "Corners lie on a grid of 1/%d of a pixel", 1 << raster->subpixel_bits);
    if (raster->subpixel_bits == RASTER_SUBPIXELS)
        fputs(" or finer", file);
    else if (raster->subpixel_bits != raster->claimed_subpixel)
        fprintf(file, " (the driver says 1/%d)", 1 << (raster->claimed_subpixel & 31));
    fprintf(
        file,
        ". Depth has %d bits, in steps of at most %.4g of its units;\ntwo triangles of one plane are up to "
        "%g units apart. Bytes are off by up to %.4f steps.\n",
        raster->depth_bits, raster->depth_step, raster->depth_error, raster->bytes);
}

static void put_forecast(const Forecast *forecast, bool markdown, FILE *file)
{
    Table table;
    char head[96];
    snprintf(head, sizeof head, "in pictures of %d rows, at most, in steps of 1/255|highp|mediump",
             forecast->height);
    table_open(&table, head);
    for (int i = 0; i < FORECAST_SCENES; i++)
        table_row(&table, "%s|%.2f|%.*f", forecast->scenes[i], forecast->steps[i][0],
                  forecast->steps[i][1] < 10 ? 2 : 0, forecast->steps[i][1]);
    for (int i = 0; i < FORECAST_SHININESSES; i++)
        table_row(&table, "pow alone, shininess %g|%.2g|%.2g", forecast->shininess[i],
                  forecast->power[i][0], forecast->power[i][1]);
    table_close(&table, markdown, file);
}

/* What a precision that is declared really is, and what it is said to be. */
static void put_meaning(const Arithmetics *found, FILE *file)
{
    const Arithmetic *high = &found->of[METER_FRAGMENT][METER_HIGHP];
    const Arithmetic *medium = &found->of[METER_FRAGMENT][METER_MEDIUMP];
    if (alike(high, medium))
        fprintf(file, "mediump is computed as highp: it costs no accuracy here, and hides what it "
                      "would cost elsewhere.\n");
    else
        fprintf(file,
                "mediump has %d bits less than highp, and ends at %g: the square of a length "
                "above %.0f is infinite.\n",
                high->format.bits - medium->format.bits, format_max(&medium->format),
                sqrt(format_max(&medium->format)));
    for (int stage = 0; stage < METER_STAGES; stage++)
        for (int precision = 0; precision < METER_PRECISIONS; precision++) {
            char text[CLAIM_SIZE];
            const Arithmetic *of = &found->of[stage][precision];
            claim_text(&of->claim, &of->format, text);
            if (text[0])
                fprintf(file, "The driver, of %s in %s shaders, %s.\n",
                        METER_PRECISION_NAMES[precision], METER_STAGE_NAMES[stage], text);
        }
}

void arithmetic_text(const Arithmetics *found, const Forecast *forecast, bool markdown, FILE *file)
{
    Columns columns;
    columns_of(found, &columns);
    if (!markdown)
        fprintf(file, "%s, %s\n", found->renderer, found->version);
    fprintf(file,
            "%ld inputs of each function, or every one of 16 bits; truth: %s. A unit is one in the "
            "last place.\n\n",
            found->inputs,
            truth_is_checked() ? "doubles, checked with MPFR" : "doubles (built without MPFR)");
    put_formats(&columns, markdown, file);
    fputc('\n', file);
    put_functions(&columns, markdown, file);
    fputc('\n', file);
    put_raster(&found->raster, file);
    fputc('\n', file);
    put_forecast(forecast, markdown, file);
    fputc('\n', file);
    put_meaning(found, file);
}

/* JSON. */

/* A number, or null if it is none. */
static void put_number(FILE *file, const char *name, double value, bool last)
{
    if (isfinite(value))
        fprintf(file, "\"%s\": %.9g", name, value);
    else
        fprintf(file, "\"%s\": null", name);
    fputs(last ? "" : ", ", file);
}

static void put_flag(FILE *file, const char *name, bool value, bool last)
{
    fprintf(file, "\"%s\": %s%s", name, value ? "true" : "false", last ? "" : ", ");
}

static void put_arithmetic_json(const Arithmetic *of, FILE *file)
{
    const Format *format = &of->format;
    fputs("{", file);
    put_number(file, "bits", format->bits, false);
    put_number(file, "min_exponent", format->min_exponent, false);
    put_number(file, "max_exponent", format->max_exponent, false);
    put_flag(file, "denormals", format->denormals, false);
    put_flag(file, "denormal_inputs", format->denormal_inputs, false);
    fprintf(file, "\"rounding\": \"%s\", ", ROUNDING_NAMES[format->rounding]);
    put_flag(file, "infinity", format->infinity, false);
    put_flag(file, "nan", format->nan, false);
    fprintf(file, "\"claim\": {\"min\": %d, \"max\": %d, \"bits\": %d},\n      \"functions\": {\n",
            of->claim.min, of->claim.max, of->claim.bits);
    for (int i = 0; i < FUNCTION_COUNT; i++) {
        const Accuracy *accuracy = &of->accuracies[i];
        fprintf(file, "        \"%s\": {", FUNCTIONS[i].name);
        put_number(file, "largest", accuracy->largest, false);
        put_number(file, "mean", accuracy_mean(accuracy), false);
        put_number(file, "inputs", (double)accuracy->count, false);
        put_number(file, "not_finite", (double)accuracy->wrong, false);
        put_number(file, "x", (double)accuracy->at[0], false);
        put_number(file, "y", (double)accuracy->at[1], true);
        fputs(i + 1 < FUNCTION_COUNT ? "},\n" : "}\n      }}", file);
    }
}

static void put_raster_json(const Raster *raster, FILE *file)
{
    fputs("  \"raster\": {", file);
    put_number(file, "varying", raster->flat, false);
    put_number(file, "perspective", raster->perspective, false);
    put_number(file, "small", raster->small, false);
    put_number(file, "shared_edge", raster->edge, false);
    put_number(file, "edge_pixels", (double)raster->edge_pixels, false);
    put_number(file, "edge_twice", (double)raster->edge_twice, false);
    put_number(file, "edge_missed", (double)raster->edge_missed, false);
    put_number(file, "bytes", raster->bytes, false);
    put_number(file, "subpixel_bits", raster->subpixel_bits, false);
    put_number(file, "depth_bits", raster->depth_bits, false);
    put_number(file, "depth_step", raster->depth_step, false);
    put_number(file, "depth_error", raster->depth_error, true);
    fputs("},\n", file);
}

void arithmetic_json(const Arithmetics *found, const Forecast *forecast, FILE *file)
{
    fputs("{\n  \"renderer\": ", file);
    json_put_string(file, found->renderer);
    fputs(",\n  \"version\": ", file);
    json_put_string(file, found->version);
    fprintf(file, ",\n  \"inputs\": %ld,\n", found->inputs);
    for (int stage = 0; stage < METER_STAGES; stage++) {
        fprintf(file, "  \"%s\": {\n", METER_STAGE_NAMES[stage]);
        for (int precision = 0; precision < METER_PRECISIONS; precision++) {
            fprintf(file, "    \"%s\": ", METER_PRECISION_NAMES[precision]);
            put_arithmetic_json(&found->of[stage][precision], file);
            fputs(precision + 1 < METER_PRECISIONS ? ",\n" : "\n  },\n", file);
        }
    }
    put_raster_json(&found->raster, file);
    fprintf(file, "  \"picture_height\": %d,\n  \"pictures\": {\n", forecast->height);
    for (int i = 0; i < FORECAST_SCENES; i++)
        fprintf(file, "    \"%s\": {\"highp\": %.4f, \"mediump\": %.4f},\n", forecast->scenes[i],
                forecast->steps[i][0], forecast->steps[i][1]);
    for (int i = 0; i < FORECAST_SHININESSES; i++) {
        fprintf(file, "    \"pow alone, shininess %g\": {", forecast->shininess[i]);
        put_number(file, "highp", forecast->power[i][0], false);
        put_number(file, "mediump", forecast->power[i][1], true);
        fputs(i + 1 < FORECAST_SHININESSES ? "},\n" : "}\n  }\n}\n", file);
    }
}

bool arithmetic_plot(const Arithmetics *found, const char *folder, Message *message)
{
    enum { SERIES = 7 };
    static const struct {
        Function function;
        MeterPrecision precision;
        const char *name;
    } shown[SERIES] = {
        {FUNCTION_POW, METER_HIGHP, "pow, highp"},
        {FUNCTION_EXP2, METER_HIGHP, "exp2, highp"},
        {FUNCTION_LOG2, METER_HIGHP, "log2, highp"},
        {FUNCTION_INVERSESQRT, METER_HIGHP, "inversesqrt, highp"},
        {FUNCTION_DIVIDE, METER_HIGHP, "/, highp"},
        {FUNCTION_POW, METER_MEDIUMP, "pow, mediump"},
        {FUNCTION_INVERSESQRT, METER_MEDIUMP, "inversesqrt, mediump"},
    };
    static double x[SERIES][NUMBER_BINADES], y[SERIES][NUMBER_BINADES];
    ReportSeries series[SERIES];
    char foot[300];
    for (int i = 0; i < SERIES; i++) {
        const Accuracy *of =
            &found->of[METER_FRAGMENT][shown[i].precision].accuracies[shown[i].function];
        series[i] = (ReportSeries){shown[i].name, x[i], y[i], 0};
        for (int k = 0; k < NUMBER_BINADES; k++)
            if (of->by_binade[k] > 0) {
                x[i][series[i].count] = k + NUMBER_FIRST_BINADE;
                y[i][series[i].count++] = (double)of->by_binade[k];
            }
    }
    snprintf(foot, sizeof foot, "%s; %s", found->renderer, found->version);
    const ReportAxes axes = {.title = "Errors of functions in fragment shaders",
                             .x = "exponent of the (first) input, as a power of two",
                             .y = "largest error in units in the last place",
                             .log_y = true,
                             .foot = foot};
    return report_curves(&axes, series, SERIES, folder, "precision", message);
}
