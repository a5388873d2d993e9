#include "study/report/conclusions.h"

#include "base/clock.h"
#include "base/memory.h"
#include "reference/picture_error.h"
#include "study/measure/scenes.h"
#include "study/report/report.h"
#include "study/results/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 9, QUICK_ROUNDS = 3, QUICK_STEP = 3, QUICK_KINDS = 2, FILTERED = 1, NEAR = 2 };

static const int SIZES[SHADOW_MAP_SIZES] = {64, 128, 256, 512, 1024, 2048, 4096};

/* Of maps; the first two are measured in a quick survey, too, the second is FILTERED. */
static const struct {
    const char *name;
    int smooth;
    Vec3 bias;
} KINDS[SHADOW_MAP_KINDS] = {{"map", 0, {1, 1.5, 0}},
                             {"map, 2x2", 1, {1, 1.5, 0}},
                             {"map, no bias", 0, {0, 0, 0}},
                             {"map, constant bias 2", 0, {2, 0, 0}},
                             {"map, along the normal 1.5", 0, {0.5, 0, 1.5}}};

static const struct {
    const char *name, *what;
} SCENES[SHADOW_SCENES] = {{"sphere", "a sphere over a floor"},
                           {"teapot", "teapot and torus over a floor"}};

static void make_scene(int number, StudyScene *made)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0}), large = mat4_scale((Vec3){3, 3, 3});
    const Material grey = {{0.3, 0.3, 0.3}, {0.6, 0.6, 0.6}, {0.3, 0.3, 0.3}, {0, 0, 0}, 1, 30};
    const bool teapot = number == 1;
    memset(made, 0, sizeof *made);
    made->lights[0] = (Light){.kind = LIGHT_POINT,
                              .shadows = true,
                              .position = {1.5, 3, 2},
                              .diffuse = {0.8, 0.8, 0.8},
                              .specular = {0.4, 0.4, 0.4}};
    made->objects[0] =
        (Object){.solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object =
                     mat4_product(mat4_translate((Vec3){0, -0.75, 0}), mat4_product(lying, large)),
                 .front = grey};
    made->objects[1] = (Object){
        .solid = {.kind = teapot ? SOLID_TEAPOT : SOLID_SPHERE, .radius = teapot ? 1 : 0.75},
        .closed = !teapot,
        .world_from_object = mat4_identity(),
        .front = grey};
    made->objects[2] =
        (Object){.solid = {.kind = SOLID_TORUS, .radius = 0.45, .tube = 0.15},
                 .closed = true,
                 .world_from_object = mat4_product(mat4_translate((Vec3){1.7, -0.1, -0.8}),
                                                   mat4_rotate(25, (Vec3){1, 0, 0})),
                 .front = grey};
    made->scene = (Scene){.camera = {{0, 2.5, 5.5}, {0, 0, 0}, {0, 1, 0}, 40, 1, 30, 0},
                          .background = {0.1, 0.1, 0.1},
                          .global_ambient = {0.3, 0.3, 0.3},
                          .lights = made->lights,
                          .light_count = 1,
                          .objects = made->objects,
                          .object_count = teapot ? 3 : 2};
}

/* One scene: drawn with and without shadows, and exactly. */
typedef struct Subject {
    StudyScene made;
    SettingPicture with, without;
    Reference exact;
    unsigned char *near; /* of each pixel: within NEAR of a shadow's edge */
    int rounds;
} Subject;

static bool is_dark(const Reference *exact, const Reference *bare, int pixel)
{
    for (int c = 3 * pixel; c < 3 * pixel + 3; c++)
        if (fabs((double)exact->color[c] - (double)bare->color[c]) > 0.5 / 255)
            return true;
    return false;
}

static void find_edges(const Reference *exact, const Reference *bare, unsigned char *near)
{
    for (int i = 0; i < exact->width * exact->height; i++) {
        const int x = i % exact->width, y = i / exact->width;
        bool dark = false, lit = false;
        for (int k = 0; k < (2 * NEAR + 1) * (2 * NEAR + 1); k++) {
            const int u = x + k % (2 * NEAR + 1) - NEAR, v = y + k / (2 * NEAR + 1) - NEAR;
            if (u < 0 || v < 0 || u >= exact->width || v >= exact->height)
                continue;
            const bool here = is_dark(exact, bare, v * exact->width + u);
            dark |= here;
            lit |= !here;
        }
        near[i] = dark && lit;
    }
}

static bool open_subject(Survey *survey, Subject *subject, int number, Message *message)
{
    const Quality usual = quality_usual();
    const ReferenceOptions options = {.width = survey->like.width,
                                      .height = survey->like.height,
                                      .meshes = true,
                                      .centers = true};
    Reference bare = {.width = 0};
    make_scene(number, &subject->made);
    if (!setting_picture_open(&subject->with, survey->renderer, &subject->made.scene, &usual,
                              message))
        return false;
    subject->made.lights[0].shadows = false; /* of the next drawing; the first has a copy */
    const bool done =
        setting_picture_open(&subject->without, survey->renderer, &subject->made.scene, &usual,
                             message) &&
        reference_open(&subject->exact, &subject->with.made.scene, &options, message) &&
        reference_open(&bare, &subject->without.made.scene, &options, message);
    subject->near = memory_new((size_t)(options.width * options.height), 1);
    if (done)
        find_edges(&subject->exact, &bare, subject->near);
    subject->rounds = survey->plan.quick ? QUICK_ROUNDS : ROUNDS;
    reference_close(&bare);
    return done;
}

static void close_subject(Survey *survey, Subject *subject)
{
    setting_picture_close(&subject->with);
    setting_picture_close(&subject->without);
    reference_close(&subject->exact);
    free(subject->near);
    setting_renderer_forget(survey->renderer);
}

static ShadowTime time_of(double ratios[ROUNDS], int count)
{
    return (ShadowTime){clock_median(ratios, count), clock_quantile(ratios, count, 0.25),
                        clock_quantile(ratios, count, 0.75)};
}

/* Where the processor draws, its time tells what a frame costs even if other programs run. */
static bool time_frame(Survey *survey, SettingPicture *drawing, double *seconds, Message *message)
{
    const bool software = gl_is_software(setting_renderer_name(survey->renderer));
    double wall, gpu;
    const double start = clock_processor();
    if (!setting_picture_frame(drawing, survey->renderer, &wall, &gpu, message))
        return false;
    *seconds = software ? clock_processor() - start : wall;
    return true;
}

/* Frames without shadows, with them, and with them after the light has moved, in turn. */
static bool measure_times(Survey *survey, Subject *subject, ShadowMeasured *measured,
                          Message *message)
{
    double still[ROUNDS], moving[ROUNDS], none, with, moved;
    SettingPicture *drawing = &subject->with;
    for (int i = 0; i < subject->rounds; i++) {
        if (!time_frame(survey, &subject->without, &none, message) ||
            !time_frame(survey, drawing, &with, message))
            return false;
        drawing->made.lights[0].position.x += 1e-9;
        if (!time_frame(survey, drawing, &moved, message))
            return false;
        still[i] = with / none;
        moving[i] = moved / none;
    }
    measured->still = time_of(still, subject->rounds);
    measured->moving = time_of(moving, subject->rounds);
    return true;
}

static bool measure_way(Survey *survey, Subject *subject, const ShadowSettings *settings,
                        ShadowMeasured *measured, Message *message)
{
    PictureError error = {.all = {0}};
    ErrorSum near = {0};
    double wall, gpu;
    const SettingPicture *drawing = &subject->with;
    const Reference *exact = &subject->exact;
    lighting_use_shadows(drawing->lighting, settings);
    if (!setting_picture_frame(&subject->with, survey->renderer, &wall, &gpu, message))
        return false;
    picture_error_add(&error, &drawing->image,
                      &(ExactView){.exact = exact, .scene = &drawing->made.scene});
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++)
        if (subject->near[i])
            error_sum_add(&near, pixel_error(&drawing->image, i, &exact->color[3 * i]), i);
    measured->error = error_sum_rms(&near);
    measured->all = error_sum_rms(&error.all);
    measured->wrong = error.interior.wrong;
    return measure_times(survey, subject, measured, message);
}

/* The picture of the first screen: by the map that it names. */
static bool draw_best(Survey *survey, Subject *subject, const ShadowWays *ways, int number,
                      Message *message)
{
    ShadowMeasured volumes, map;
    ShadowSettings settings = SHADOWS_DEFAULT;
    char path[PATH_MAX];
    double wall, gpu;
    if (number != 0 || !shadow_ways_best(ways, number, &volumes, &map, &settings.map_size))
        return true;
    settings.way = SHADOWS_MAP;
    settings.smooth = KINDS[FILTERED].smooth;
    settings.bias = KINDS[FILTERED].bias;
    lighting_use_shadows(subject->with.lighting, &settings);
    glance_path("shadows", survey->folder, path);
    return setting_picture_frame(&subject->with, survey->renderer, &wall, &gpu, message) &&
           report_pair(&subject->with.image, &subject->exact, path, message);
}

static bool measure_scene(Survey *survey, int number, ShadowWays *ways, Message *message)
{
    const int step = survey->plan.quick ? QUICK_STEP : 1;
    Subject *subject = memory_new(1, sizeof *subject);
    ShadowSettings settings = SHADOWS_DEFAULT;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    bool done = open_subject(survey, subject, number, message);
    settings.way = SHADOWS_VOLUMES;
    done = done && measure_way(survey, subject, &settings, &ways->scenes[number].volumes, message);
    settings.way = SHADOWS_MAP;
    for (int kind = 0; kind < (survey->plan.quick ? QUICK_KINDS : SHADOW_MAP_KINDS); kind++) {
        settings.smooth = KINDS[kind].smooth;
        settings.bias = KINDS[kind].bias;
        for (int size = 0; size < SHADOW_MAP_SIZES && SIZES[size] <= most && done; size += step) {
            settings.map_size = SIZES[size];
            done = measure_way(survey, subject, &settings, &ways->scenes[number].maps[kind][size],
                               message);
        }
    }
    done = done && draw_best(survey, subject, ways, number, message);
    if (subject->with.lighting)
        lighting_use_shadows(subject->with.lighting, &SHADOWS_DEFAULT);
    close_subject(survey, subject);
    free(subject);
    return done;
}

/* The table. */

static void put_row(int scene, const char *name, int size, const ShadowMeasured *measured,
                    Table *table)
{
    char way[64];
    const ShadowTime *still = &measured->still, *moving = &measured->moving;
    if (still->ratio <= 0)
        return;
    snprintf(way, sizeof way, size ? "%s: %d" : "%s", name, size);
    table_row(table, "%s|%s|%.2f|%.2f|%lld|%.2f [%.2f, %.2f]|%.2f [%.2f, %.2f]", SCENES[scene].name,
              way, measured->error, measured->all, measured->wrong, still->ratio, still->lower,
              still->upper, moving->ratio, moving->lower, moving->upper);
}

/* A page's table has other biases for few sizes. */
static void put_scene(const ShadowWays *ways, int scene, bool markdown, Table *table)
{
    put_row(scene, "volumes", 0, &ways->scenes[scene].volumes, table);
    for (int kind = 0; kind < SHADOW_MAP_KINDS; kind++)
        for (int size = 0; size < SHADOW_MAP_SIZES; size++)
            if (!markdown || kind < QUICK_KINDS || size % QUICK_STEP == 0)
                put_row(scene, KINDS[kind].name, SIZES[size], &ways->scenes[scene].maps[kind][size],
                        table);
}

static void print_ways(const ShadowWays *ways, bool markdown, FILE *file)
{
    Table table;
    table_open(&table, "scene|shadows|near edges|all pixels|wrong inside|time|a light moves");
    for (int i = 0; i < SHADOW_SCENES; i++)
        put_scene(ways, i, markdown, &table);
    fprintf(file,
            "\nShadows: the root mean square error of the pixels within two of a shadow's edge, "
            "and of all (steps of 1/255),\nthe pixels inside surfaces off by more than a step, and "
            "the time over that of a frame without shadows\n%s\n\n",
            ways->with);
    table_close(&table, markdown, file);
}

void shadow_ways_report(Survey *survey, bool markdown, FILE *file, ShadowWays *ways)
{
    memset(ways, 0, sizeof *ways);
    results_measured_with(&survey->like, ways->with);
    for (int i = 0; i < (survey->plan.quick ? 1 : SHADOW_SCENES); i++) {
        Message why = {0};
        if (measure_scene(survey, i, ways, &why))
            continue;
        fprintf(file, "\n%s: not measured: %s\n", SCENES[i].what, why.text); /* by this driver */
        memset(&ways->scenes[i], 0, sizeof ways->scenes[i]);
    }
    print_ways(ways, markdown, file);
}

/* The plots. */

typedef struct Lines {
    char names[SHADOW_MAP_KINDS + 3][64];
    double x[SHADOW_MAP_KINDS + 3][SHADOW_MAP_SIZES], y[SHADOW_MAP_KINDS + 3][SHADOW_MAP_SIZES];
    ReportSeries series[SHADOW_MAP_KINDS + 3];
    int count;
} Lines;

typedef enum Shown { SHOWN_ERROR, SHOWN_TIME, SHOWN_MOVING } Shown;

/* Of each size, or the same for all of them; with the least and the largest time in its name,
 * unless that is what is shown. */
static void add_line(Lines *lines, const char *name, const ShadowMeasured *measured, bool same,
                     Shown shown)
{
    const int i = lines->count;
    double least = INFINITY, most = 0;
    int points = 0;
    for (int k = 0; k < SHADOW_MAP_SIZES; k++) {
        const ShadowMeasured *here = same ? measured : &measured[k];
        if (here->still.ratio <= 0)
            continue;
        lines->x[i][points] = SIZES[k];
        lines->y[i][points++] = shown == SHOWN_ERROR  ? here->error
                                : shown == SHOWN_TIME ? here->still.ratio
                                                      : here->moving.ratio;
        least = fmin(least, here->moving.ratio);
        most = fmax(most, here->moving.ratio);
    }
    if (points == 0)
        return;
    const size_t size = sizeof lines->names[i];
    if (shown != SHOWN_ERROR)
        snprintf(lines->names[i], size, "%s", name);
    else if (same)
        snprintf(lines->names[i], size, "%s: time %.1f", name, least);
    else
        snprintf(lines->names[i], size, "%s: time %.1f to %.1f", name, least, most);
    lines->series[i] = (ReportSeries){lines->names[i], lines->x[i], lines->y[i], points};
    lines->count++;
}

static bool plot_scene(const ShadowWays *ways, int scene, bool time, const char *folder,
                       Message *message)
{
    char title[160], name[64];
    Lines lines = {.count = 0};
    const Shown shown = time ? SHOWN_TIME : SHOWN_ERROR;
    snprintf(title, sizeof title, "Shadows: %s%s", SCENES[scene].what,
             time ? "" : "; times over none");
    snprintf(name, sizeof name, "finding-shadows-%s%s", SCENES[scene].name, time ? "-time" : "");
    const ReportAxes axes = {.foot = ways->with,
                             .title = title,
                             .x = "size of the map, in texels each way",
                             .y = time ? "time of a frame over one without shadows"
                                       : "rms error near shadows' edges, in steps of 1/255",
                             .log_x = true,
                             .log_y = true,
                             .doubling_x = true};
    for (int kind = 0; kind < (time ? 2 : SHADOW_MAP_KINDS); kind++)
        add_line(&lines, KINDS[kind].name, ways->scenes[scene].maps[kind], false, shown);
    if (time)
        add_line(&lines, "map, a light moves", ways->scenes[scene].maps[0], false, SHOWN_MOVING);
    add_line(&lines, "volumes", &ways->scenes[scene].volumes, true, shown);
    return lines.count == 0 ||
           report_curves(&axes, lines.series, lines.count, folder, name, message);
}

bool shadow_ways_plot(const ShadowWays *ways, const char *folder, Message *message)
{
    for (int i = 0; i < SHADOW_SCENES; i++)
        if (!plot_scene(ways, i, false, folder, message) ||
            !plot_scene(ways, i, true, folder, message))
            return false;
    return true;
}

bool shadow_ways_best(const ShadowWays *ways, int scene, ShadowMeasured *volumes,
                      ShadowMeasured *map, int *size)
{
    static const double NEAR_ENOUGH = 8;
    const ShadowMeasured *best = NULL;
    for (int i = 0; i < SHADOW_MAP_SIZES; i++) {
        const ShadowMeasured *at = &ways->scenes[scene].maps[FILTERED][i];
        const bool enough = best && best->error <= NEAR_ENOUGH;
        if (!(at->still.ratio > 0) ||
            (best && (enough ? at->still.ratio >= best->still.ratio || at->error > NEAR_ENOUGH
                             : at->error >= best->error)))
            continue;
        best = at;
        *size = SIZES[i];
    }
    *volumes = ways->scenes[scene].volumes;
    if (best)
        *map = *best;
    return best && volumes->still.ratio > 0;
}
