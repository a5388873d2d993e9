/*
 * A program's shaders are compiled once for all its draws, and a vertex is run when a pixel needs
 * it, once for each arithmetic: what it hands to the fragment is kept.
 */
#include "probe/raster_state.h"

#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ENDLESS = 8 }; /* turns, once a loop did not end */

/* The shaders of a draw */

static const double *numbers(const GlslRun *run, const char *name, GlslVariable *found)
{
    return glsl_find(run->code, name, found) ? run->registers + found->first : NULL;
}

static void set(GlslRun *run, const char *name, const double *values, int count)
{
    GlslVariable found;
    if (!glsl_find(run->code, name, &found))
        return;
    for (int i = 0; i < count && i < found.count; i++)
        run->registers[found.first + i] = values[i];
}

/* Coordinates beyond an edge: repeated, or the edge's. */
static int texel(double at, int size, bool repeats)
{
    const double place = repeats ? at - floor(at) : at;
    return (int)fmin(fmax(floor(place * size), 0), size - 1);
}

/* The nearest texel; maps and masks have no other filter. */
static void look_up(void *context, int unit, int function, const double *coordinates, int count,
                    double color[4])
{
    const CaptureDraw *draw = context;
    const CaptureTexture *texture =
        unit >= 0 && unit < draw->texture_count ? draw->textures[unit] : NULL;
    const double divisor =
        function == GLSL_TEXTURE_2D_PROJ && count > 2 ? coordinates[count - 1] : 1;
    for (int i = 0; i < 4; i++)
        color[i] = i == 3;
    if (!texture || !texture->texels || function >= GLSL_TEXTURE_CUBE)
        return;
    const int x = texel(coordinates[0] / divisor, texture->width, texture->repeats[0]);
    const int y = texel(coordinates[1] / divisor, texture->height, texture->repeats[1]);
    for (int i = 0; i < 4; i++)
        color[i] = (double)texture->texels[4 * (y * texture->width + x) + i];
}

const char *raster_unread(const CaptureDraw *draw, const CaptureUniform *uniform)
{
    if (uniform->type == GL_SAMPLER_CUBE)
        return "a cube map, which is not read";
    if (uniform->type == GL_SAMPLER_2D && uniform->values[0] >= 0 &&
        !draw->textures[(int)uniform->values[0]]->texels)
        return "a depth texture, which cannot be read";
    return NULL;
}

static void set_uniforms(GlslRun *run, const CaptureDraw *draw)
{
    for (int i = 0; i < draw->uniform_count; i++) {
        const CaptureUniform *uniform = &draw->uniforms[i];
        for (int k = 0; k < uniform->length; k++) {
            GlslVariable found;
            if (!stages_uniform(run->code, uniform, k, &found))
                continue;
            for (int j = 0; j < uniform->numbers && j < found.count; j++)
                run->registers[found.first + j] = (double)uniform->values[k * uniform->numbers + j];
        }
    }
}

static GlslRun *begin(Raster *raster, int draw, int stage, const GlslArithmetic *arithmetic)
{
    RasterProgram *program = &raster->programs[raster->draws[draw].program];
    GlslRun *run = program->runs[stage];
    run->arithmetic = arithmetic;
    run->exact_from = INT_MAX;
    run->details = true;
    run->assigned = raster->assigned[stage];
    run->observer = raster->observer;
    run->texture = look_up;
    run->context = &raster->capture->draws[draw];
    if (program->set_for[stage] != draw + 1)
        set_uniforms(run, &raster->capture->draws[draw]);
    program->set_for[stage] = draw + 1;
    return run;
}

/* Of vertices, weighted. */
static void run_between(GlslRun *run, const CaptureDraw *draw, const unsigned *vertices,
                        const double *weights, int count)
{
    for (int i = 0; i < draw->attribute_count; i++) {
        double sum[4] = {0};
        for (int c = 0; c < count; c++) {
            float value[4];
            capture_attribute(&draw->attributes[i], vertices[c], value);
            for (int k = 0; k < 4; k++)
                sum[k] += weights[c] * (double)value[k];
        }
        set(run, draw->attributes[i].name, sum, 4);
    }
    glsl_run(run);
}

static void run_vertex(GlslRun *run, const CaptureDraw *draw, unsigned vertex)
{
    run_between(run, draw, &vertex, (const double[]){1}, 1);
}

/* Opening */

static bool find_program(Raster *raster, const CaptureDraw *draw, int *number, Message *message)
{
    for (*number = 0; *number < raster->count; ++*number) {
        const Stages *known = &raster->programs[*number].stages;
        if (known->sources[0] == draw->sources[0] && known->sources[1] == draw->sources[1])
            return true;
    }
    RasterProgram *made =
        memory_add(&raster->programs, &raster->count, &raster->room, sizeof *made);
    *made = (RasterProgram){.set_for = {0, 0}};
    if (!stages_open(&made->stages, draw, message))
        return false;
    for (int i = 0; i < 2; i++)
        made->runs[i] = glsl_run_open(made->stages.codes[i]);
    return true;
}

bool raster_is_filled(const CaptureDraw *draw)
{
    return draw->mode == GL_TRIANGLES || draw->mode == GL_TRIANGLE_STRIP ||
           draw->mode == GL_TRIANGLE_FAN;
}

/* Each vertex that is drawn, once. */
static void place_vertices(Raster *raster, int number)
{
    const CaptureDraw *draw = &raster->capture->draws[number];
    DrawState *state = &raster->draws[number];
    GlslRun *run = begin(raster, number, 0, raster->driver);
    for (int i = 0; i < draw->vertex_count; i++)
        state->most = draw->vertices[i] > state->most ? draw->vertices[i] : state->most;
    bool *done = memory_new((size_t)state->most + 1, sizeof *done);
    state->places = memory_new((size_t)state->most + 1, sizeof *state->places);
    run->trace = false;
    for (int i = 0; i < draw->vertex_count; i++) {
        const unsigned vertex = draw->vertices[i];
        GlslVariable found;
        if (done[vertex])
            continue;
        done[vertex] = true;
        run_vertex(run, draw, vertex);
        const double *place = numbers(run, "gl_Position", &found);
        if (place)
            memcpy(state->places[vertex], place, sizeof state->places[vertex]);
    }
    free(done);
}

bool raster_open(Raster **opened, const Capture *capture, const GlslArithmetic *driver,
                 Message *message)
{
    Raster *raster = *opened = memory_new(1, sizeof *raster);
    raster->capture = capture;
    raster->driver = driver;
    raster->draws = memory_new((size_t)capture->draw_count + 1, sizeof *raster->draws);
    for (int i = 0; i < capture->draw_count; i++) {
        if (!raster_is_filled(&capture->draws[i]))
            continue;
        if (!find_program(raster, &capture->draws[i], &raster->draws[i].program, message)) {
            raster_close(raster);
            *opened = NULL;
            return false;
        }
        place_vertices(raster, i);
    }
    return true;
}

const GlslArithmetic *raster_driver(const Raster *raster)
{
    return raster->driver;
}

Raster *raster_beside(const Raster *first)
{
    Raster *raster = memory_copy(first, sizeof *first);
    raster->first = first;
    raster->programs = memory_copy(first->programs, sizeof *first->programs * (size_t)first->count);
    raster->draws =
        memory_copy(first->draws, sizeof *first->draws * (size_t)first->capture->draw_count);
    for (int i = 0; i < raster->count; i++)
        for (int k = 0; k < 2; k++) {
            raster->programs[i].runs[k] = glsl_run_open(raster->programs[i].stages.codes[k]);
            raster->programs[i].set_for[k] = 0;
        }
    for (int i = 0; i < raster->capture->draw_count; i++)
        memset(raster->draws[i].handed, 0, sizeof raster->draws[i].handed);
    return raster;
}

void raster_close(Raster *raster)
{
    if (!raster)
        return;
    for (int i = 0; i < raster->count; i++) {
        for (int k = 0; k < 2; k++)
            glsl_run_close(raster->programs[i].runs[k]);
        if (!raster->first)
            stages_close(&raster->programs[i].stages);
    }
    for (int i = 0; i < raster->capture->draw_count; i++) {
        DrawState *draw = &raster->draws[i];
        for (int k = 0; k < 2; k++) {
            free(draw->handed[k].known);
            free(draw->handed[k].numbers);
        }
        if (!raster->first)
            free(draw->places);
    }
    free(raster->draws);
    free(raster->programs);
    free(raster);
}

/* Running */

const GlslRun *raster_vertex(Raster *raster, int draw, unsigned vertex,
                             const GlslArithmetic *arithmetic)
{
    GlslRun *run = begin(raster, draw, 0, arithmetic);
    run->trace = true;
    run_vertex(run, &raster->capture->draws[draw], vertex);
    return run;
}

/* The numbers of a vertex's varyings. */
static const double *hand_over(Raster *raster, int draw, unsigned vertex,
                               const GlslArithmetic *arithmetic)
{
    DrawState *state = &raster->draws[draw];
    const Stages *stages = &raster->programs[state->program].stages;
    const size_t room = (size_t)state->most + 1, each = (size_t)stages->handed;
    const int exact = arithmetic == &GLSL_EXACT;
    if (state->handed[exact].arithmetic != arithmetic) {
        free(state->handed[exact].known);
        free(state->handed[exact].numbers);
        state->handed[exact].arithmetic = arithmetic;
        state->handed[exact].known = memory_new(room, 1);
        state->handed[exact].numbers = memory_new(room * each, sizeof(double));
    }
    double *numbers = state->handed[exact].numbers + each * vertex;
    signed char *known = &state->handed[exact].known[vertex];
    raster->unset |= *known & UNSET;
    if (*known)
        return numbers;
    GlslRun *run = begin(raster, draw, 0, arithmetic);
    run->trace = false;
    run_vertex(run, &raster->capture->draws[draw], vertex);
    *known = glsl_noted(run, GLSL_NOTE_UNSET) ? HANDED | UNSET : HANDED;
    raster->unset |= *known & UNSET;
    for (int i = 0; i < stages->link_count; i++)
        memcpy(numbers + stages->links[i].at, run->registers + stages->links[i].vertex,
               sizeof(double) * (size_t)stages->links[i].count);
    return numbers;
}

/* What the fragment gets of the corners: each varying, weighted. */
static void interpolate(Raster *raster, const RasterPixel *pixel, GlslRun *fragment,
                        const GlslArithmetic *arithmetic)
{
    const Stages *stages = &raster->programs[raster->draws[pixel->draw].program].stages;
    for (int k = 0; k < stages->link_count; k++) {
        const StageLink *link = &stages->links[k];
        const bool kept = raster->kept && strcmp(link->name, raster->kept) == 0;
        const double *corners[3];
        for (int c = 0; c < 3; c++)
            corners[c] = hand_over(raster, pixel->draw, pixel->corners[c],
                                   kept ? raster->driver : arithmetic) +
                         link->at;
        for (int i = 0; i < link->count; i++) {
            double sum = 0;
            for (int c = 0; c < 3; c++)
                sum += pixel->weights[c] * corners[c][i];
            fragment->registers[link->fragment + i] = sum;
        }
    }
}

static void compute(Raster *raster, const RasterPixel *pixel, GlslRun *fragment,
                    const GlslArithmetic *arithmetic)
{
    const Stages *stages = &raster->programs[raster->draws[pixel->draw].program].stages;
    GlslRun *run = begin(raster, pixel->draw, 0, arithmetic);
    run->trace = false;
    run_between(run, &raster->capture->draws[pixel->draw], pixel->corners, pixel->weights, 3);
    raster->unset = glsl_noted(run, GLSL_NOTE_UNSET);
    for (int k = 0; k < stages->link_count; k++)
        memcpy(fragment->registers + stages->links[k].fragment,
               run->registers + stages->links[k].vertex,
               sizeof(double) * (size_t)stages->links[k].count);
}

void raster_at_pixel(Raster *raster, bool computed)
{
    raster->at_pixel = computed;
}

void raster_keep(Raster *raster, const char *varying)
{
    raster->kept = varying;
}

void raster_observe(Raster *raster, int stage,
                    void (*assigned)(GlslRun *run, const GlslEvent *event, void *observer),
                    void *observer)
{
    raster->assigned[stage] = assigned;
    raster->observer = observer;
    for (int i = 0; stage == 0 && i < raster->capture->draw_count; i++)
        for (int k = 0; k < 2; k++) /* what vertices handed over is another */
            if (raster->draws[i].handed[k].known)
                memset(raster->draws[i].handed[k].known, 0, (size_t)raster->draws[i].most + 1);
}

void raster_log(Raster *raster, bool always)
{
    raster->logs = always;
}

static GlslRun *begin_pixel(Raster *raster, const RasterPixel *pixel,
                            const GlslArithmetic *arithmetic)
{
    GlslRun *run = begin(raster, pixel->draw, 1, arithmetic);
    const double front = pixel->front;
    raster->unset = false;
    (raster->at_pixel ? compute : interpolate)(raster, pixel, run, arithmetic);
    set(run, "gl_FragCoord", pixel->coord, 4);
    set(run, "gl_FrontFacing", &front, 1);
    return run;
}

void raster_color(GlslRun *run, double color[4])
{
    GlslVariable found;
    const double *written = numbers(run, "gl_FragColor", &found);
    if (!written || !run->code->tree->symbols[found.symbol].written)
        written = numbers(run, "gl_FragData[0]", &found);
    const bool is_written = written && run->code->tree->symbols[found.symbol].written;
    for (int i = 0; i < 4; i++)
        color[i] = is_written ? written[i] : NAN;
}

const GlslRun *raster_run(Raster *raster, const RasterPixel *pixel,
                          const GlslArithmetic *arithmetic, int exact_from, double color[4])
{
    GlslRun *run = begin_pixel(raster, pixel, arithmetic);
    run->exact_from = exact_from;
    run->trace = raster->logs || exact_from == INT_MAX;
    if (!glsl_run(run) && run->loops > ENDLESS) {
        run->loops = ENDLESS;
        raster->stopped = true;
        glsl_run(run);
    }
    raster_color(run, color);
    return run;
}

bool raster_unset(const Raster *raster)
{
    return raster->unset;
}

bool raster_stopped(const Raster *raster)
{
    return raster->stopped;
}

void raster_run_each(Raster *raster, const RasterPixel *pixel, const int events[3], GlslEach *each,
                     void *context)
{
    GlslRun *run = begin_pixel(raster, pixel, raster_driver(raster));
    run->trace = false;
    glsl_run_each(run, events[0], events[1], events[2], each, context);
}

const GlslCode *raster_code(const Raster *raster, int draw, int stage)
{
    return raster_is_filled(&raster->capture->draws[draw])
               ? raster->programs[raster->draws[draw].program].stages.codes[stage]
               : NULL;
}
