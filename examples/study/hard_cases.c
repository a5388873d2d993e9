/*
 * hard_cases: scenes on which plain formulas fail.
 *
 * Draws each case three times: with the plain formula, as `lighting` does, and exactly. Reports the
 * errors of the first two, and what the stable form costs in time.
 */
#include "app/options.h"
#include "base/clock.h"
#include "base/output.h"
#include "base/output_text.h"
#include "base/progress.h"
#include "probe/probe.h"
#include "probe/stages.h"
#include "reference/picture_error.h"
#include "study/cases/hard_sheet.h"
#include "study/results/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pictures of the common sheet fit in this; ten rows of them stay below 2000 pixels. */
enum { SHEET_WIDTH = 168, SHEET_HEIGHT = 130 };

enum { WIDTH = 280, HEIGHT = 216, MIN_ROUNDS = 7, MAX_ROUNDS = 99, MAX_FRAMES = 8 };

static int asked = HARD_CASE_COUNT; /* all */
static bool list, markdown;

/* The cases, and the last: all of them. */
static const char *names[HARD_CASE_COUNT + 2];

static const Parameter parameters[] = {
    {"list", "list the cases", PARAMETER_FLAG, .value = &list},
    {"case", "draw only this one", PARAMETER_CHOICE, .value = &asked, .choices = names},
    {"markdown", "print the table as Markdown, with processor, driver and compiler", PARAMETER_FLAG,
     .value = &markdown},
    {.name = NULL},
};

/* One of a case's two pictures. */
typedef struct Way {
    Lighting *lighting;
    const Scene *scene;
    const Canvas *canvas;
} Way;

static bool draw_frame(const Way *way, Message *message)
{
    canvas_clear(way->canvas, way->scene->background, 1);
    if (!lighting_show(way->lighting,
                       &(LightingFrame){.scene = way->scene,
                                        .aspect = (double)way->canvas->width / way->canvas->height},
                       message))
        return false;
    glFinish();
    return true;
}

/* Where the processor draws, its time tells what a frame costs even if other programs run. */
static double clock_of(const Canvas *canvas)
{
    return gl_is_software(canvas->renderer) ? clock_processor() : clock_now();
}

static bool time_of(const Way *way, int frames, double *seconds, Message *message)
{
    const double start = clock_of(way->canvas);
    for (int i = 0; i < frames; i++)
        if (!draw_frame(way, message))
            return false;
    *seconds = clock_of(way->canvas) - start;
    return true;
}

/* The distance of the quartiles. */
static double spread_of(double *values, int count)
{
    return clock_quantile(values, count, 0.75) - clock_quantile(values, count, 0.25);
}

/* Frames of both in turn, so that a disturbance affects both. The noise is how far the median ratio
 * of equal frames is from 1, plus twice the standard error of a median ratio (1.25 sigma /
 * sqrt(count); the quartiles of a normal distribution are 1.35 sigma apart), the larger one. */
static bool measure(const Way *naive, const Way *stable, HardResult *result, Message *message)
{
    static const double ENOUGH = 0.25; /* seconds */
    double first, second, third, ratios[MAX_ROUNDS], same[MAX_ROUNDS];
    if (!time_of(naive, 1, &first, message) || !time_of(stable, 1, &second, message))
        return false;
    const int frames = (int)fmin(fmax(1e-3 / first, 1), MAX_FRAMES);
    const double start = clock_now();
    int count = 0;
    for (; count < MIN_ROUNDS || (count < MAX_ROUNDS && clock_now() - start < ENOUGH); count++) {
        if (!time_of(naive, frames, &first, message) ||
            !time_of(stable, frames, &second, message) || !time_of(naive, frames, &third, message))
            return false;
        ratios[count] = 2 * second / (first + third);
        same[count] = third / first;
    }
    result->cost = clock_median(ratios, count) - 1;
    const double spread = fmax(spread_of(same, count), spread_of(ratios, count));
    result->noise = fabs(clock_median(same, count) - 1) + 2 * 1.25 / 1.35 * spread / sqrt(count);
    return true;
}

static HardError error_of(const Image *image, const Reference *exact, const Scene *scene,
                          size_t *worst)
{
    PictureError error = {.all = {0}};
    picture_error_add(&error, image, &(ExactView){.exact = exact, .scene = scene});
    const ErrorSum *inside = &error.interior;
    *worst = inside->worst;
    return (HardError){
        .maximum = inside->maximum,
        .wrong = inside->pixels ? (double)inside->wrong / (double)inside->pixels : 0,
    };
}

static bool draw_ways(Way *naive, Way *stable, HardResult *result, Message *message)
{
    const Canvas *canvas = naive->canvas;
    /* Drawn without antialiasing, too. */
    const ReferenceOptions options = {
        .width = canvas->width, .height = canvas->height, .meshes = true, .centers = true};
    if (!image_open(&result->naive, canvas->width, canvas->height, IMAGE_BYTE, message) ||
        !image_open(&result->stable, canvas->width, canvas->height, IMAGE_BYTE, message) ||
        !reference_open(&result->exact, stable->scene, &options, message) ||
        !draw_frame(naive, message) || !canvas_read(canvas, &result->naive, message) ||
        !draw_frame(stable, message) || !canvas_read(canvas, &result->stable, message))
        return false;
    size_t unused;
    result->naive_error =
        error_of(&result->naive, &result->exact, stable->scene, &result->naive_worst);
    result->stable_error = error_of(&result->stable, &result->exact, stable->scene, &unused);
    return true;
}

/* Volumes, unless they say otherwise. */
static void use_shadows(Lighting *lighting, const ShadowSettings *settings)
{
    ShadowSettings volumes = SHADOWS_DEFAULT;
    volumes.way = SHADOWS_VOLUMES;
    lighting_use_shadows(lighting, settings->way != SHADOWS_OFF ? settings : &volumes);
}

/* With `first`, only the first of the case's files is replaced. */
static bool open_naive(Lighting **lighting, const HardCase *of, const ShaderLoader *stable,
                       ShaderReplacement replaced[3], bool first, Message *message)
{
    ShaderLoader loader = *stable;
    memcpy(replaced, of->replaced, sizeof of->replaced);
    if (first)
        replaced[1] = (ShaderReplacement){NULL, NULL};
    loader.replacements = replaced;
    if (of->precision)
        loader.precision = of->precision;
    if (!lighting_open(lighting, &loader, message))
        return false;
    lighting_use_normal_matrix(*lighting, of->normal_matrix);
    lighting_use_transforms(*lighting, of->transforms ? of->transforms() : NULL);
    use_shadows(*lighting, &of->shadows);
    lighting_use_depth_pass(*lighting, of->depth_pass);
    return true;
}

static bool capture_way(Capture *capture, const Way *way, const HardCase *of,
                        const ShaderLoader *stable, Message *message)
{
    ShaderReplacement replaced[3];
    Way captured = *way;
    captured.lighting = NULL;
    capture_begin(capture, way->canvas);
    const bool done = open_naive(&captured.lighting, of, stable, replaced, false, message) &&
                      draw_frame(&captured, message);
    capture_end(capture);
    lighting_close(captured.lighting);
    return done;
}

/* Goes on from an instruction to the next line that its stage has; false: there is none. */
static bool next_line(const Stages *stages, int stage, int *at, GlslPlace *place,
                      char line[PLACE_TEXT])
{
    const GlslCode *code = stages->codes[stage];
    const int before = place->line;
    for (; place->line == before && *at < code->instruction_count; ++*at)
        *place = code->tree->nodes[code->instructions[*at].node].place;
    place_line(stages->sources[stage], *place, line);
    return place->line != before;
}

/* Adds the first line that is compiled in one way alone. */
static bool say_line(FILE *file, const Stages *one, const Stages *other, const char *what)
{
    char line[PLACE_TEXT], known[PLACE_TEXT], name[PLACE_TEXT];
    for (int stage = 1; stage >= 0; stage--) {
        GlslPlace place = {.line = -1};
        for (int at = 0; next_line(one, stage, &at, &place, line);) {
            GlslPlace there = {.line = -1};
            bool has = false;
            for (int k = 0; !has && next_line(other, stage, &k, &there, known);)
                has = strcmp(line, known) == 0;
            if (has)
                continue;
            place_name(one->sources[stage], place, name);
            fprintf(file, "%s: %s: %s\n", what, name, line);
            return true;
        }
    }
    return false;
}

/* What the formulas of the two differ in. */
static void say_difference(FILE *file, const CaptureDraw *naive, const CaptureDraw *stable)
{
    Stages ways[2];
    const bool opened = stages_open(&ways[0], naive, NULL);
    if (stages_open(&ways[1], stable, NULL) && opened &&
        !say_line(file, &ways[0], &ways[1], "the stable form has another line here"))
        say_line(file, &ways[1], &ways[0], "only the stable form has this line");
    stages_close(&ways[0]);
    stages_close(&ways[1]);
}

/* What the plain formula's shader does at its worst pixel inside an object. */
static bool find_cause(HardResult *result, const Way *naive, const Way *stable,
                       const ShaderLoader *loader, Message *message)
{
    static const HardCase none = {.name = ""};
    const size_t worst = result->naive_worst, width = (size_t)naive->canvas->width;
    ExactPixel exact = {.object = "inside an object"};
    ProbeQuestion question = {.driver = &GLSL_LLVMPIPE,
                              .column = (int)(worst % width),
                              .row = (int)(worst / width),
                              .height = naive->canvas->height,
                              .exact = &exact};
    Capture captures[2];
    Probe probe = {.raster = NULL};
    OutputText said;
    bool done = capture_way(&captures[1], stable, &none, loader, message);
    done = capture_way(&captures[0], naive, result->of, loader, message) && done;
    question.capture = &captures[0];
    memcpy(question.drawn, (unsigned char *)result->naive.pixels + 4 * worst, 4);
    memcpy(exact.color, result->exact.color + 3 * worst, sizeof exact.color);
    done = done && probe_open(&probe, &question, message);
    output_text_open(&said);
    const int draw = probe.pixel.draw;
    if (done && probe.judged && probe.formula > probe.rounding && draw < captures[1].draw_count)
        say_difference(said.file, &captures[0].draws[draw], &captures[1].draws[draw]);
    char *verdict = done ? probe_verdict(&probe) : NULL;
    fputs(verdict ? verdict : "", said.file);
    free(verdict);
    result->verdict = output_text_close(&said);
    probe_close(&probe);
    capture_close(&captures[0]);
    capture_close(&captures[1]);
    return done;
}

/* Whether it is in a shader that lights. */
static bool is_shaders(const HardCase *of, const Scene *naive)
{
    return of->precision || naive->skip_renormalization ||
           (of->replaced[0].name && strncmp(of->replaced[0].name, "lighting/", 9) == 0);
}

static bool draw_case(const HardCase *of, const Canvas *first, const Options *options,
                      HardResult *result, Message *message)
{
    HardScene made;
    Canvas canvas;
    const bool own = of->width > 0;
    const CanvasOptions size = {.width = own ? of->width : options->width,
                                .height = own ? of->height : options->height};
    const ShaderLoader loader = {.folder = options->shaders.folder, .precision = "highp"};
    ShaderReplacement replaced[2][3];
    result->of = of;
    if (!canvas_open_beside(&canvas, first, &size, message))
        return false;
    Way naive = {.scene = &made.naive, .canvas = &canvas};
    Way timed = naive, stable = {.scene = &made.scene, .canvas = &canvas};
    bool done = hard_scene_open(&made, of, message) &&
                open_naive(&naive.lighting, of, &loader, replaced[0], false, message) &&
                open_naive(&timed.lighting, of, &loader, replaced[1], true, message) &&
                lighting_open(&stable.lighting, &loader, message);
    if (done)
        use_shadows(stable.lighting, &(ShadowSettings){.way = SHADOWS_OFF});
    done = done && draw_ways(&naive, &stable, result, message) &&
           measure(&timed, &stable, result, message);
    if (done && asked < HARD_CASE_COUNT && is_shaders(of, &made.naive))
        done = find_cause(result, &naive, &stable, &loader, message);
    lighting_close(naive.lighting);
    lighting_close(timed.lighting);
    lighting_close(stable.lighting);
    hard_scene_close(&made);
    canvas_close(&canvas);
    return done;
}

static void close_result(HardResult *result)
{
    image_close(&result->naive);
    image_close(&result->stable);
    reference_close(&result->exact);
    free(result->verdict);
}

static void print_table(const HardResult *results, int count)
{
    Table table;
    table_open(&table, markdown ? "case|plain formula: error|pixels wrong|stable form: error|time "
                                  "of stable over plain|what is hard|plain|stable"
                                : "|plain, steps|pixels wrong|stable, steps|stable over plain, "
                                  "time");
    for (int i = 0; i < count; i++) {
        const HardResult *result = &results[i];
        char cost[HARD_COST_SIZE];
        hard_cost_text(result, cost);
        char details[256] = "";
        if (markdown)
            snprintf(details, sizeof details, "|%s|%s|%s", result->of->what, result->of->naive,
                     result->of->stable);
        table_row(&table, "%s|%.2f|%.1f%%|%.2f|%s%s", result->of->name, result->naive_error.maximum,
                  100 * result->naive_error.wrong, result->stable_error.maximum, cost, details);
    }
    table_close(&table, markdown, stdout);
}

/* A common sheet of several cases. */
static bool draw_sheet(const Options *options, const char *name, const HardResult *results,
                       int count, Message *message)
{
    char path[PATH_MAX];
    const double scale =
        fmin((double)SHEET_WIDTH / options->width, (double)SHEET_HEIGHT / options->height);
    snprintf(path, sizeof path, "%s/%s", options->output, name);
    const HardSheet sheet = {results, count, 2, (int)fmax(1, scale * options->width),
                             (int)fmax(1, scale * options->height)};
    return hard_sheet(&sheet, path, message);
}

/* Each case to its own sheet; all also to one of formulas and one of shadows. */
static bool draw_cases(const Options *options, const Canvas *canvas, int from, int count,
                       HardResult *results, Message *message)
{
    char path[PATH_MAX];
    Progress progress = progress_start("hard cases");
    /* Enlarges small pictures to make room for text. */
    const int larger = (WIDTH + options->width - 1) / options->width;
    const int width = larger * options->width, height = larger * options->height;
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        snprintf(path, sizeof path, "%s/%s.png", options->output, hard_case(from + i)->name);
        const HardSheet sheet = {&results[i], 1, 1, width, height};
        done = draw_case(hard_case(from + i), canvas, options, &results[i], message) &&
               hard_sheet(&sheet, path, message);
        progress_update(&progress, i + 1, count + 1);
    }
    if (done && count > 1)
        done = draw_sheet(options, "hard_cases.png", results, HARD_FORMULA_COUNT, message) &&
               draw_sheet(options, "hard_shadows.png", results + HARD_FORMULA_COUNT,
                          HARD_SHADOW_COUNT, message);
    progress_end(&progress);
    return done;
}

static bool draw_and_report(const Options *options, Message *message)
{
    HardResult results[HARD_CASE_COUNT] = {{.of = NULL}};
    const int from = asked < HARD_CASE_COUNT ? asked : 0;
    const int count = asked < HARD_CASE_COUNT ? 1 : HARD_CASE_COUNT;
    const CanvasOptions size = {.backend = options->canvas.backend, .width = 1, .height = 1};
    Canvas canvas;
    setenv("LP_NUM_THREADS", "0", 0); /* one thread is disturbed less by other programs */
    if (!canvas_open(&canvas, &size, message))
        return false;
    if (options->verbose)
        fprintf(stderr, "renderer: %s\n", canvas.renderer);
    if (markdown) {
        char driver[256];
        snprintf(driver, sizeof driver, "%s; %s", canvas.renderer, canvas.version);
        table_machine(driver, stdout);
        putchar('\n');
    }
    const bool done = output_folder(options->output, message) &&
                      draw_cases(options, &canvas, from, count, results, message);
    if (done)
        print_table(results, count);
    if (done && !markdown)
        printf("\nwrote %s/%s.png\n", options->output, count > 1 ? "*" : results[0].of->name);
    if (done && !markdown && results[0].verdict)
        printf("\nThe plain formula at its worst pixel, %d,%d:\n%s",
               (int)results[0].naive_worst % results[0].naive.width,
               (int)results[0].naive_worst / results[0].naive.width, results[0].verdict);
    for (int i = 0; i < count; i++)
        close_result(&results[i]);
    canvas_close(&canvas);
    return done;
}

static const Usage usage = {
    .name = "hard_cases",
    .summary = "scenes on which plain formulas fail and stable ones do not",
    .details = "The folder has a sheet for each case, drawn with the plain formula, with the\n"
               "stable one, and exactly; hard_cases.png has all but those of shadows, and\n"
               "hard_shadows.png those. Errors are of pixels inside the objects, away from edges\n"
               "of shadows, in steps of 1/255. Times are of frames drawn in turn, and\n"
               "processor time if the processor draws; the noise is the difference between frames\n"
               "of the same program. If a shader is at fault, --case ends with what --probe finds\n"
               "at the worst pixel: which line is undefined, loses the digits or is another one.\n"
               "\nTry:  hard_cases\n"
               "      hard_cases --list\n"
               "      hard_cases --case mirror -s 560x432\n",
    .study = true,
    .width = WIDTH,
    .height = HEIGHT,
    .parameters = parameters,
};

int main(int argc, char *argv[])
{
    Options options;
    int code;
    Message message = {0};
    for (int i = 0; i <= HARD_CASE_COUNT; i++)
        names[i] = i < HARD_CASE_COUNT ? hard_case(i)->name : "all";
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (list) {
        for (int i = 0; i < HARD_CASE_COUNT; i++)
            printf("%-14s %s\n", hard_case(i)->name, hard_case(i)->what);
        return options_finish(usage.name, 0);
    }
    if (!draw_and_report(&options, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
