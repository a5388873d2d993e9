/*
 * hard_cases: what goes wrong, and what does not.
 *
 * Draws each hard case three times: by the plain formula, as `lighting` does, and exactly. Says how
 * far the first two are off, and what the stable form costs in time.
 */
#include "hard_cases_sheet.h"
#include "statistics.h"

#include "options.h"
#include "output.h"
#include "progress.h"
#include "reference_error.h"
#include "stage.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 280, HEIGHT = 216, LEAST_ROUNDS = 7, MOST_ROUNDS = 99, MOST_FRAMES = 8 };

static int asked = HARD_CASE_COUNT; /* all */
static bool list;

static const Parameter parameters[] = {
    {.name = "list", .help = "say which cases there are", .kind = PARAMETER_FLAG, .value = &list},
    {.name = "case",
     .help = "draw only this one",
     .kind = PARAMETER_CHOICE,
     .value = &asked,
     .choices = HARD_CASE_NAMES},
    {.name = NULL},
};

/* One of a case's two pictures. */
typedef struct Way {
    Lighting *lighting;
    const Scene *scene;
    const Canvas *canvas;
} Way;

static bool draw(const Way *way, Message *message)
{
    canvas_clear(way->canvas, way->scene->background, 1);
    if (!lighting_draw(way->lighting, way->scene, (double)way->canvas->width / way->canvas->height,
                       false, message))
        return false;
    glFinish();
    return true;
}

static bool time_of(const Way *way, int frames, double *seconds, Message *message)
{
    const double start = progress_now();
    for (int i = 0; i < frames; i++)
        if (!draw(way, message))
            return false;
    *seconds = progress_now() - start;
    return true;
}

/* Frames of both in turn, so that what disturbs one disturbs the other. The noise is how far the
 * median of equal frames' ratios is off, and twice its standard error (1.25 deviations over the
 * root of the count; a normal distribution's quartiles are 1.35 of them apart). */
static bool measure(const Way *naive, const Way *stable, HardResult *result, Message *message)
{
    static const double ENOUGH = 0.25; /* seconds */
    double first, second, third, ratios[MOST_ROUNDS], same[MOST_ROUNDS];
    if (!time_of(naive, 1, &first, message) || !time_of(stable, 1, &second, message))
        return false;
    const int frames = (int)fmin(fmax(1e-3 / first, 1), MOST_FRAMES);
    const double start = progress_now();
    int count = 0;
    for (; count < LEAST_ROUNDS || (count < MOST_ROUNDS && progress_now() - start < ENOUGH);
         count++) {
        if (!time_of(naive, frames, &first, message) ||
            !time_of(stable, frames, &second, message) || !time_of(naive, frames, &third, message))
            return false;
        ratios[count] = 2 * second / (first + third);
        same[count] = third / first;
    }
    result->cost = statistics_quantile(ratios, count, 0.5) - 1;
    const double spread =
        statistics_quantile(same, count, 0.75) - statistics_quantile(same, count, 0.25);
    result->noise =
        fabs(statistics_quantile(same, count, 0.5) - 1) + 2 * 1.25 / 1.35 * spread / sqrt(count);
    return true;
}

static HardError error_of(const Image *image, const Reference *exact)
{
    ReferenceError error = {.all = {0}};
    reference_error_add(&error, image, 0, 0, exact, NULL);
    const ErrorSum *inside = &error.interior;
    return (HardError){
        .maximum = inside->maximum,
        .wrong = inside->pixels ? (double)inside->wrong / (double)inside->pixels : 0,
    };
}

static bool draw_ways(Way *naive, Way *stable, HardResult *result, Message *message)
{
    const Canvas *canvas = naive->canvas;
    const ReferenceOptions options = {
        .width = canvas->width, .height = canvas->height, .meshes = true};
    if (!image_open(&result->naive, canvas->width, canvas->height, IMAGE_BYTE, message) ||
        !image_open(&result->stable, canvas->width, canvas->height, IMAGE_BYTE, message) ||
        !reference_open(&result->exact, stable->scene, &options, message))
        return false;
    if (!draw(naive, message) || !canvas_read(canvas, &result->naive, message) ||
        !draw(stable, message) || !canvas_read(canvas, &result->stable, message))
        return false;
    result->naive_error = error_of(&result->naive, &result->exact);
    result->stable_error = error_of(&result->stable, &result->exact);
    return true;
}

/* As the case has it; with `first`, only the first of the files is replaced. */
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
    return true;
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
    const bool done = hard_scene_open(&made, of, message) &&
                      open_naive(&naive.lighting, of, &loader, replaced[0], false, message) &&
                      open_naive(&timed.lighting, of, &loader, replaced[1], true, message) &&
                      lighting_open(&stable.lighting, &loader, message) &&
                      draw_ways(&naive, &stable, result, message) &&
                      measure(&timed, &stable, result, message);
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
}

static void print(const HardResult *results, int count)
{
    printf("%-14s %14s %14s %14s   %s\n", "", "naive, levels", "pixels wrong", "stable, levels",
           "stable over naive, time");
    for (int i = 0; i < count; i++) {
        const HardResult *result = &results[i];
        char cost[HARD_COST_SIZE];
        hard_cost_text(result, cost);
        printf("%-14s %14.2f %13.1f%% %14.2f   %s\n", result->of->name, result->naive_error.maximum,
               100 * result->naive_error.wrong, result->stable_error.maximum, cost);
    }
}

/* The cases from `from` on, each to its own sheet, and all to one where there are several. */
static bool draw_cases(const Options *options, const Canvas *canvas, int from, int count,
                       HardResult *results, Message *message)
{
    char path[PATH_MAX];
    Progress progress = progress_start("hard cases");
    /* Small pictures are enlarged, so that there is room for text. */
    const int larger = (WIDTH + options->width - 1) / options->width;
    const int width = larger * options->width, height = larger * options->height;
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        snprintf(path, sizeof path, "%s/%s.png", options->output, HARD_CASES[from + i].name);
        done = draw_case(&HARD_CASES[from + i], canvas, options, &results[i], message) &&
               hard_sheet(&results[i], 1, 1, width, height, path, message);
        progress_update(&progress, i + 1, count + 1);
    }
    if (done && count > 1) {
        snprintf(path, sizeof path, "%s/hard_cases.png", options->output);
        done = hard_sheet(results, count, 2, width, height, path, message);
    }
    progress_end(&progress);
    return done;
}

static bool run(const Options *options, Message *message)
{
    HardResult results[HARD_CASE_COUNT] = {{.of = NULL}};
    const int from = asked < HARD_CASE_COUNT ? asked : 0;
    const int count = asked < HARD_CASE_COUNT ? 1 : HARD_CASE_COUNT;
    const CanvasOptions size = {.backend = options->canvas.backend, .width = 1, .height = 1};
    Canvas canvas;
    setenv("LP_NUM_THREADS", "0", 0); /* other programs disturb one thread less than several */
    if (!canvas_open(&canvas, &size, message))
        return false;
    if (options->verbose)
        fprintf(stderr, "renderer: %s\n", canvas.renderer);
    const bool done = output_folder(options->output, message) &&
                      draw_cases(options, &canvas, from, count, results, message);
    if (done)
        print(results, count);
    for (int i = 0; i < count; i++)
        close_result(&results[i]);
    canvas_close(&canvas);
    return done;
}

static const Usage usage = {
    .name = "hard_cases",
    .summary = "what goes wrong with plain formulas, and what does not",
    .details = "In the folder: for each case a sheet of three pictures, by the plain formula, by\n"
               "the stable one, and exact; and hard_cases.png, all of them. Errors are of pixels\n"
               "inside the objects, in steps of 1/255. Times are of frames drawn in turn; the\n"
               "noise is what frames of the same program differ by.\n"
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
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (options.doctor)
        return options_finish(usage.name, stage_doctor());
    if (list) {
        for (int i = 0; i < HARD_CASE_COUNT; i++)
            printf("%-14s %s\n", HARD_CASES[i].name, HARD_CASES[i].what);
        return options_finish(usage.name, 0);
    }
    if (!run(&options, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
