/*
 * Bands of rows are taken by threads in turn, each with registers of its own. The triangles of a
 * band are scanned once; then the shaders are run for each pixel that shows one.
 *
 * With c(i) the colour that is computed as the driver does up to assignment i, and exactly from
 * there on, c(i) - c(i - 1) is what assignment i causes, and all of them add up to the error.
 */
#include "probe/show.h"

#include "base/memory.h"
#include "base/text.h"
#include "probe/origin.h"

#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROWS = 16, THREADS = 64 }; /* of a band; at most */

/* Names */

static bool is_shown(const GlslCode *code, const GlslVariable *variable)
{
    return variable->count <= 4 &&
           (variable->storage != GLSL_OUT || code->tree->symbols[variable->symbol].written);
}

static bool is_listed(const GlslCode *code, int symbol)
{
    const GlslSymbol *variable = &code->tree->symbols[symbol];
    return !variable->built_in || variable->storage == GLSL_OUT;
}

/* The variables that a stage can show. */
static void add_names(const GlslCode *code, const char ***names, int *count, int *room)
{
    for (int i = 0; i < code->variable_count + code->instruction_count; i++) {
        const int k = i - code->variable_count;
        const GlslVariable *variable = k < 0 ? &code->variables[i] : NULL;
        const int symbol = variable ? variable->symbol : glsl_event_symbol(code, k);
        const char *name = variable ? variable->name : code->tree->symbols[symbol].name;
        const bool fits = variable ? is_shown(code, variable) && is_listed(code, symbol)
                                   : symbol && glsl_is_vector(code->tree->symbols[symbol].type);
        bool known = !fits;
        for (int j = 0; j < *count && !known; j++)
            known = strcmp((*names)[j], name) == 0;
        if (!known)
            *(const char **)memory_add(names, count, room, sizeof **names) = name;
    }
}

bool show_names(const Capture *capture, const GlslArithmetic *driver, int stage, FILE *file,
                Message *message)
{
    Raster *raster;
    const char **names = NULL;
    int count = 0, room = 0;
    if (!raster_open(&raster, capture, driver, message))
        return false;
    for (int d = 0; d < capture->draw_count; d++)
        if (raster_code(raster, d, stage))
            add_names(raster_code(raster, d, stage), &names, &count, &room);
    for (int i = 0; i < count; i++)
        fprintf(file, "%s\n", names[i]);
    free(names);
    raster_close(raster);
    return true;
}

static bool has_name(const GlslCode *code, const char *name)
{
    GlslVariable variable;
    bool has = glsl_find(code, name, &variable) && is_shown(code, &variable);
    for (int i = 0; i < code->instruction_count && !has; i++) {
        const GlslSymbol *symbol = &code->tree->symbols[glsl_event_symbol(code, i)];
        has = symbol->name && strcmp(symbol->name, name) == 0 && glsl_is_vector(symbol->type);
    }
    return has;
}

typedef struct Job {
    Show *show;
    const Raster *raster;
    atomic_int next;     /* band */
    atomic_bool stopped; /* as Show.stopped */
    char name[CAPTURE_NAME];
    int component;       /* of it; -1: all */
    signed char *stages; /* of each draw, which has the name; -1: none */
} Job;

/* Which names there are, the nearest first. */
static bool unknown(const Job *job, const Raster *raster, Message *message)
{
    const char **names = NULL;
    int count = 0, room = 0;
    for (int d = 0; d < job->show->capture->draw_count; d++)
        for (int stage = 1; stage >= (job->show->kind == SHOW_ERROR); stage--)
            if (raster_code(raster, d, stage))
                add_names(raster_code(raster, d, stage), &names, &count, &room);
    *(const char **)memory_add(&names, &count, &room, sizeof *names) = NULL;
    const char *nearest = text_nearest(job->name, names);
    message_set(message, "%s: no %sshader here has it; there are %s", job->show->what,
                job->show->kind == SHOW_ERROR ? "fragment " : "", nearest ? nearest : "");
    for (int i = 0; names[i]; i++)
        if (names[i] != nearest)
            message_add(message, "%s%s", i || nearest ? ", " : "", names[i]);
    free(names);
    return false;
}

/* Values */

static int value_of(const GlslRun *run, const char *name, double value[4])
{
    const GlslTree *tree = run->code->tree;
    GlslVariable variable;
    if (glsl_find(run->code, name, &variable) && is_shown(run->code, &variable)) {
        memcpy(value, run->registers + variable.first, sizeof *value * (size_t)variable.count);
        return variable.count;
    }
    const GlslEvent *event = glsl_last(run, name);
    if (!event || !glsl_is_vector(tree->symbols[event->symbol].type))
        return 0;
    memcpy(value, run->values + event->value, sizeof *value * (size_t)event->count);
    return event->count;
}

/* Of the vertices, weighted as varyings are. */
static int vertex_value(Raster *raster, const RasterPixel *pixel, const char *name, double value[4])
{
    int count = 0;
    memset(value, 0, 4 * sizeof *value);
    for (int c = 0; c < 3; c++) {
        const GlslRun *run =
            raster_vertex(raster, pixel->draw, pixel->corners[c], raster_driver(raster));
        double corner[4];
        count = value_of(run, name, corner);
        for (int i = 0; i < count; i++)
            value[i] += pixel->weights[c] * corner[i];
    }
    return count;
}

static int find_value(const Job *job, Raster *raster, const RasterPixel *pixel, double value[4])
{
    const int stage = job->stages[pixel->draw];
    double color[4];
    int count = 0;
    if (stage == 0) {
        count = vertex_value(raster, pixel, job->name, value);
    } else if (stage == 1) {
        const GlslRun *run = raster_run(raster, pixel, raster_driver(raster), INT_MAX, color);
        count = run->discarded ? 0 : value_of(run, job->name, value);
    }
    if (job->component < 0)
        return count;
    if (job->component >= count)
        return 0;
    value[0] = value[job->component];
    return 1;
}

/* Errors */

static void add_apart(double value[4], const double a[4], const double b[4])
{
    for (int i = 0; i < 3; i++)
        value[i] += origin_step(a[i]) - origin_step(b[i]);
}

/* What the events of a name cause, of those that the driver's run logged. */
static void add_events(const Job *job, Raster *raster, const RasterPixel *pixel,
                       const GlslRun *driver, double value[4])
{
    const int count = driver->event_count;
    bool *named = memory_new((size_t)count + 1, sizeof *named);
    double before[4], after[4];
    int known = INT_MIN; /* the event of `after` */
    for (int i = 0; i < count; i++)
        named[i] =
            strcmp(driver->code->tree->symbols[driver->events[i].symbol].name, job->name) == 0;
    for (int i = 0; i < count; i++) {
        if (!named[i])
            continue;
        if (known == i - 1)
            memcpy(before, after, sizeof before);
        else
            raster_run(raster, pixel, raster_driver(raster), i - 1, before);
        raster_run(raster, pixel, raster_driver(raster), i, after);
        known = i;
        add_apart(value, after, before);
    }
    free(named);
}

static bool is_varying(const GlslCode *code, const char *name)
{
    GlslVariable found;
    return glsl_find(code, name, &found) && found.storage == GLSL_VARYING;
}

static int no_number(double value[4])
{
    for (int i = 0; i < 3; i++)
        value[i] = NAN;
    return 3;
}

static int find_error(const Job *job, Raster *raster, const RasterPixel *pixel, double value[4])
{
    double exact[4], color[4];
    memset(value, 0, 4 * sizeof *value);
    const GlslRun *run = raster_run(raster, pixel, raster_driver(raster), INT_MAX, color);
    if (run->discarded || job->stages[pixel->draw] != 1)
        return 0;
    if (origin_undefined(raster, run, color))
        return no_number(value);
    if (job->name[0] && !is_varying(run->code, job->name)) {
        add_events(job, raster, pixel, run, value);
        return 3;
    }
    if (job->name[0]) {
        raster_keep(raster, job->name);
        raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, color);
        raster_keep(raster, NULL);
    }
    if (origin_undefined(raster, raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, exact), exact))
        return no_number(value);
    add_apart(value, color, exact);
    return 3;
}

static void find_blame(Raster *raster, const RasterPixel *pixel, ShowPixel *shown)
{
    double exact[4], color[4];
    const GlslRun *run = raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, exact);
    bool undefined = origin_undefined(raster, run, exact);
    run = raster_run(raster, pixel, raster_driver(raster), INT_MAX, color);
    undefined |= origin_undefined(raster, run, color);
    if (run->discarded)
        return;
    shown->count = 1;
    shown->draw = pixel->draw;
    shown->place.line = undefined ? -2 : -1;
    if (undefined || !(origin_apart(color, exact) >= SHOW_LEAST))
        return;
    const int count = run->event_count;
    GlslEvent *events = memory_copy(run->events, sizeof *events * (size_t)count);
    const int born = origin_find(raster, pixel, count, exact);
    shown->place =
        born < 0 ? (GlslPlace){.line = 0} : run->code->tree->nodes[events[born].node].place;
    free(events);
}

/* All pixels */

static void show_pixel(const Job *job, Raster *raster, const RasterPixel *pixel, ShowPixel *shown)
{
    double value[4] = {0};
    *shown = (ShowPixel){.count = 0};
    if (pixel->draw < 0)
        return;
    if (job->show->kind == SHOW_BLAME) {
        find_blame(raster, pixel, shown);
        return;
    }
    if (job->show->kind == SHOW_COLOR) {
        const GlslRun *run = raster_run(raster, pixel, raster_driver(raster), INT_MAX, value);
        shown->count = run->discarded ? 0 : 4;
    } else {
        shown->count =
            (signed char)(job->show->kind == SHOW_ERROR ? find_error(job, raster, pixel, value)
                                                        : find_value(job, raster, pixel, value));
    }
    for (int i = 0; i < 4; i++)
        shown->values[i] = (float)value[i];
}

static void *work(void *argument)
{
    Job *job = argument;
    const Show *show = job->show;
    Raster *raster = raster_beside(job->raster);
    RasterPixel *pixels = memory_new((size_t)show->width * ROWS, sizeof *pixels);
    for (int first = ROWS * atomic_fetch_add(&job->next, 1); first < show->height;
         first = ROWS * atomic_fetch_add(&job->next, 1)) {
        const int rows = show->height - first < ROWS ? show->height - first : ROWS;
        raster_scan(raster, (const int[4]){0, first, show->width, rows}, pixels);
        for (int i = 0; i < show->width * rows; i++) {
            const int row = show->height - 1 - first - i / show->width;
            show_pixel(
                job, raster, &pixels[i],
                &show->pixels[(size_t)row * (size_t)show->width + (size_t)(i % show->width)]);
        }
    }
    if (raster_stopped(raster))
        atomic_store(&job->stopped, true);
    free(pixels);
    raster_close(raster);
    return NULL;
}

static void work_all(Job *job)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    pthread_t threads[THREADS];
    int running = 0;
    while (running + 1 < processors && running < THREADS &&
           pthread_create(&threads[running], NULL, work, job) == 0)
        running++;
    work(job);
    while (running > 0)
        pthread_join(threads[--running], NULL);
}

/* The name and component, and where they are. False: nowhere. */
static bool find_name(Job *job, const char *name, const Raster *raster)
{
    static const char SETS[3][5] = {"xyzw", "rgba", "stpq"};
    bool found = false;
    snprintf(job->name, sizeof job->name, "%s", name);
    job->component = -1;
    for (int attempt = 0; attempt < 2 && !found; attempt++) {
        for (int d = 0; d < job->show->capture->draw_count; d++) {
            job->stages[d] = -1;
            for (int stage = 1; stage >= (job->show->kind == SHOW_ERROR) && job->stages[d] < 0;
                 stage--)
                if (raster_code(raster, d, stage) &&
                    (!job->name[0] || has_name(raster_code(raster, d, stage), job->name)))
                    job->stages[d] = (signed char)stage;
            found |= job->stages[d] >= 0;
        }
        char *dot = strrchr(job->name, '.');
        if (found || !dot || !dot[1] || dot[2] || job->show->kind == SHOW_ERROR)
            break;
        for (int i = 0; i < 12; i++)
            if (SETS[i / 4][i % 4] == dot[1])
                job->component = i % 4;
        *dot = '\0';
    }
    return found || !job->name[0];
}

static ShowKind kind_of(const char *what)
{
    if (!what)
        return SHOW_COLOR;
    if (strcmp(what, "blame") == 0)
        return SHOW_BLAME;
    return strcmp(what, "error") == 0 || strncmp(what, "error:", 6) == 0 ? SHOW_ERROR : SHOW_VALUE;
}

/* Each pixel is one triangle's or the background's; lines and points are left out. */
static bool check_draws(const Capture *capture, Message *message)
{
    for (int i = 0; i < capture->draw_count; i++) {
        const CaptureDraw *draw = &capture->draws[i];
        if (draw->mode >= GL_TRIANGLES && (draw->blends || draw->tests_stencil))
            return message_set(message, "it is drawn with %s, which is not imitated",
                               draw->blends ? "blending" : "a stencil");
        for (int k = 0; k < draw->uniform_count; k++) {
            const char *unread = raster_unread(draw, &draw->uniforms[k]);
            if (unread)
                return message_set(message, "%s is %s", draw->uniforms[k].name, unread);
        }
    }
    return true;
}

bool show_open(Show *show, const Capture *capture, const GlslArithmetic *driver, const char *what,
               const int size[2], Message *message)
{
    *show = (Show){.capture = capture,
                   .what = what,
                   .width = size[0],
                   .height = size[1],
                   .color_bits = driver->color_bits};
    show->kind = kind_of(what);
    const char *name = show->kind == SHOW_VALUE                                     ? what
                       : show->kind == SHOW_ERROR && strlen(what) > strlen("error") ? what + 6
                                                                                    : "";
    Raster *raster;
    if ((!what && !check_draws(capture, message)) ||
        !raster_open(&raster, capture, driver, message))
        return false;
    Job job = {.show = show, .raster = raster};
    job.stages = memory_new((size_t)capture->draw_count + 1, 1);
    show->unknown = !find_name(&job, name, raster);
    bool done = !show->unknown || unknown(&job, raster, message);
    show->pixels = done ? calloc((size_t)size[0] * (size_t)size[1], sizeof *show->pixels) : NULL;
    if (done && !show->pixels)
        done = message_set(message, "show: not enough memory for %dx%d pixels", size[0], size[1]);
    if (done)
        work_all(&job);
    show->stopped = atomic_load(&job.stopped);
    bool shown = !done || job.component < 0;
    for (int i = 0; i < size[0] * size[1] && !shown; i++)
        shown = show->pixels[i].count > 0;
    show->unknown |= !shown;
    if (!shown)
        done = message_set(message, "%s: nothing that is drawn has this component", what);
    free(job.stages);
    raster_close(raster);
    return done;
}

void show_close(Show *show)
{
    free(show->pixels);
    *show = (Show){.capture = NULL};
}
