#include "study/arithmetic/arithmetic.h"

#include "base/json_writer.h"
#include "glsl/glsl_run.h"
#include "scene/quality.h"
#include "study/measure/scenes.h"
#include "study/report/report.h"
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
            "A varying is off by up to %.1f times what a unit in the last place of the window's "
            "coordinates, of\nits slopes and of itself changes. Of %ld pixels on edges that two "
            "triangles share %ld are drawn twice\nand %ld not at all.\n",
            raster->units, raster->edge_pixels, raster->edge_twice, raster->edge_missed);
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

/* Roots that are rounded to the nearest are off by half a unit at most, by a quarter on average;
 * those that are cut by a unit and by a half. */
static bool are_cut(const Arithmetic *arithmetic)
{
    const Accuracy *root = &arithmetic->accuracies[FUNCTION_SQRT];
    return root->largest <= 1 && root->sum > 0.4 * (double)root->count;
}

/* For --arithmetic: of fragment shaders. */
static void device_text(const Arithmetics *found, char *text, size_t size)
{
    static const int precisions[] = {[METER_HIGHP] = GLSL_HIGHP, [METER_MEDIUMP] = GLSL_MEDIUMP};
    GlslArithmetic arithmetic = {.color_bits = found->raster.color_bits};
    for (int i = METER_HIGHP; i <= METER_MEDIUMP; i++) {
        const Format *format = &found->of[SHADER_FRAGMENT][i].format;
        arithmetic.of[precisions[i]] =
            (GlslNumbers){format->bits, format->min_exponent, format->max_exponent,
                          format->denormals, are_cut(&found->of[SHADER_FRAGMENT][i])};
    }
    glsl_arithmetic_print(&arithmetic, text, size);
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
    char device[128];
    device_text(found, device, sizeof device);
    fprintf(file, "\nTo draw as this driver does elsewhere: --arithmetic \"%s\"\n", device);
}

/* JSON. */

static void put_format(JsonWriter *json, const Format *format)
{
    json_write_number(json, "bits", format->bits);
    json_write_number(json, "min_exponent", format->min_exponent);
    json_write_number(json, "max_exponent", format->max_exponent);
    json_write_flag(json, "denormals", format->denormals);
    json_write_flag(json, "denormal_inputs", format->denormal_inputs);
    json_write_text(json, "rounding", ROUNDING_NAMES[format->rounding]);
    json_write_flag(json, "infinity", format->infinity);
    json_write_flag(json, "nan", format->nan);
}

static void put_arithmetic_json(const Arithmetic *of, const char *name, JsonWriter *json)
{
    json_write_object(json, name);
    put_format(json, &of->format);
    json_write_object(json, "claim");
    json_write_whole(json, "min", of->claim.min);
    json_write_whole(json, "max", of->claim.max);
    json_write_whole(json, "bits", of->claim.bits);
    json_write_end(json);
    json_write_object(json, "functions");
    for (int i = 0; i < FUNCTION_COUNT; i++) {
        const Accuracy *accuracy = &of->accuracies[i];
        json_write_object(json, FUNCTIONS[i].name);
        json_write_number(json, "largest", accuracy->largest);
        json_write_number(json, "mean", accuracy_mean(accuracy));
        json_write_number(json, "inputs", (double)accuracy->count);
        json_write_number(json, "not_finite", (double)accuracy->wrong);
        json_write_number(json, "x", (double)accuracy->at[0]);
        json_write_number(json, "y", (double)accuracy->at[1]);
        json_write_end(json);
    }
    json_write_end(json);
    json_write_end(json);
}

static void put_raster_json(const Raster *raster, JsonWriter *json)
{
    json_write_object(json, "raster");
    json_write_number(json, "varying", raster->units);
    json_write_number(json, "edge_pixels", (double)raster->edge_pixels);
    json_write_number(json, "edge_twice", (double)raster->edge_twice);
    json_write_number(json, "edge_missed", (double)raster->edge_missed);
    json_write_number(json, "bytes", raster->bytes);
    json_write_number(json, "subpixel_bits", raster->subpixel_bits);
    json_write_number(json, "depth_bits", raster->depth_bits);
    json_write_number(json, "depth_step", raster->depth_step);
    json_write_number(json, "depth_error", raster->depth_error);
    json_write_end(json);
}

/* What each precision costs a picture. */
static void put_steps(JsonWriter *json, const char *name, double highp, double mediump)
{
    json_write_object(json, name);
    json_write_number(json, "highp", highp);
    json_write_number(json, "mediump", mediump);
    json_write_end(json);
}

void arithmetic_json(const Arithmetics *found, const Forecast *forecast, FILE *file)
{
    JsonWriter json = {.file = file, .lines = 4};
    json_write_object(&json, NULL);
    json_write_text(&json, "renderer", found->renderer);
    json_write_text(&json, "version", found->version);
    char device[128];
    device_text(found, device, sizeof device);
    json_write_text(&json, "arithmetic", device);
    json_write_whole(&json, "inputs", found->inputs);
    for (int stage = 0; stage < METER_STAGES; stage++) {
        json_write_object(&json, METER_STAGE_NAMES[stage]);
        for (int precision = 0; precision < METER_PRECISIONS; precision++)
            put_arithmetic_json(&found->of[stage][precision], METER_PRECISION_NAMES[precision],
                                &json);
        json_write_end(&json);
    }
    put_raster_json(&found->raster, &json);
    json_write_whole(&json, "picture_height", forecast->height);
    json_write_object(&json, "pictures");
    for (int i = 0; i < FORECAST_SCENES; i++)
        put_steps(&json, forecast->scenes[i], rint(1e4 * forecast->steps[i][0]) / 1e4,
                  rint(1e4 * forecast->steps[i][1]) / 1e4);
    for (int i = 0; i < FORECAST_SHININESSES; i++) {
        char name[64];
        snprintf(name, sizeof name, "pow alone, shininess %g", forecast->shininess[i]);
        put_steps(&json, name, forecast->power[i][0], forecast->power[i][1]);
    }
    json_write_end(&json);
    json_write_end(&json);
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
