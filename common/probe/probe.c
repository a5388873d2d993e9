/* The fragment's shader is run as the driver computes and exactly, and what it assigned is
 * compared.
 */
#include "probe/probe.h"

#include "base/memory.h"
#include "core/shader_source.h"
#include "probe/origin.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What one run assigned. */
typedef struct Trail {
    GlslEvent *events;
    double *values;
    int count;
    double color[4];
    GlslNote notes[GLSL_NOTES];
    int note_count;
    bool stopped, discarded;
} Trail;

static Trail keep(const GlslRun *run, const double color[4])
{
    Trail trail = {.count = run->event_count,
                   .note_count = run->note_count,
                   .stopped = run->stopped,
                   .discarded = run->discarded};
    trail.events = memory_copy(run->events, sizeof *run->events * (size_t)run->event_count);
    trail.values = memory_copy(run->values, sizeof *run->values * (size_t)run->value_count);
    memcpy(trail.color, color, sizeof trail.color);
    memcpy(trail.notes, run->notes, sizeof trail.notes);
    return trail;
}

static void forget(Trail *trail)
{
    free(trail->events);
    free(trail->values);
}

/* What an event assigned. */
static int expression_of(const GlslTree *tree, int node)
{
    const int kind = tree->nodes[node].kind;
    return kind == GLSL_VARIABLE_NODE ? tree->nodes[node].first
           : kind == GLSL_ASSIGN      ? glsl_child(tree, node, 1)
                                      : node;
}

static int line_of(const GlslTree *tree, int node)
{
    return tree->nodes[node].place.line % SHADER_LINES_OF_FILE;
}

static void put_numbers(FILE *file, const double *values, int count)
{
    for (int i = 0; i < count && i < 4; i++)
        fprintf(file, "%s%.7g", i ? ", " : "", values[i]);
    fprintf(file, count > 4 ? ", ..." : "");
}

static void put_trail(FILE *file, const GlslTree *tree, const Trail *driver, const Trail *exact)
{
    fprintf(file, "line, name: driver | exact | difference in steps of 1/255\n");
    for (int i = 0; i < driver->count; i++) {
        const GlslEvent *event = &driver->events[i];
        const GlslEvent *other =
            i < exact->count && exact->events[i].node == event->node ? &exact->events[i] : NULL;
        const double *values = driver->values + event->value;
        double most = 0;
        fprintf(file, "%4d  %s: ", line_of(tree, event->node), tree->symbols[event->symbol].name);
        put_numbers(file, values, event->count);
        if (other) {
            fprintf(file, " | ");
            put_numbers(file, exact->values + other->value, other->count);
            for (int k = 0; k < event->count; k++)
                most = fmax(most, fabs(values[k] - exact->values[other->value + k]));
            fprintf(file, " | %.3g\n", 255 * most);
        } else {
            fprintf(file, " | the exact one goes another way\n");
        }
    }
}

static void put_verdict(FILE *file, Raster *raster, const RasterPixel *pixel, const Trail *driver,
                        const Trail *exact, const ProbeQuestion *question)
{
    const GlslTree *tree = raster_code(raster, pixel->draw, 1)->tree;
    const double rounding = origin_apart(driver->color, exact->color);
    if (question->object) {
        const double picture[4] = {(double)question->exact[0], (double)question->exact[1],
                                   (double)question->exact[2], 1};
        fprintf(file, "verdict: %.2f steps off: %.2f by the formula, %.2f by rounding",
                origin_apart(driver->color, picture), origin_apart(exact->color, picture),
                rounding);
    } else {
        fprintf(file, "verdict: %.2f steps off by rounding", rounding);
    }
    const int birth = origin_find(raster, pixel, driver->count, exact->color);
    if (rounding < 0.01) {
        fprintf(file, "\n");
    } else if (birth < 0) {
        fprintf(file, ", born in the vertex shader\n");
    } else {
        char text[64];
        const int node = expression_of(tree, driver->events[birth].node);
        glsl_expression_text(tree, node, text, sizeof text);
        fprintf(file, ", born in line %d (%s)\n", line_of(tree, driver->events[birth].node), text);
    }
    fprintf(file, "(the line from which on the error of the colour stays when all that follows is "
                  "computed exactly)\n");
}

static void put_notes(FILE *file, const GlslTree *tree, const Trail *driver)
{
    for (int i = 0; i < driver->note_count; i++)
        fprintf(file, "line %d: %s\n", line_of(tree, driver->notes[i].node),
                glsl_note_text(driver->notes[i].kind));
}

/* What samplers have is asked of the driver, which does not tell of all. False: what is
 * computed is not the picture's. */
static bool put_samplers(FILE *file, const CaptureDraw *draw)
{
    bool known = true;
    for (int i = 0; i < draw->uniform_count; i++) {
        const CaptureUniform *uniform = &draw->uniforms[i];
        const int texture = uniform->type == GL_SAMPLER_2D ? (int)uniform->values[0] : 0;
        if (uniform->type == GL_SAMPLER_2D && texture < 0)
            fprintf(file, "%s: a sampler without a texture: black\n", uniform->name);
        else if (uniform->type == GL_SAMPLER_2D && !draw->textures[texture]->texels) {
            fprintf(file, "%s: a depth texture, which cannot be read: taken as black\n",
                    uniform->name);
            known = false;
        }
    }
    return known;
}

static void put_corners(FILE *file, Raster *raster, const RasterPixel *pixel)
{
    for (int c = 0; c < 3; c++) {
        const GlslRun *run = raster_vertex(raster, pixel->draw, pixel->corners[c], &GLSL_LLVMPIPE);
        fprintf(file, "vertex %u, weight %.6f:", pixel->corners[c], pixel->weights[c]);
        for (int k = 0; k < run->code->variable_count; k++) {
            const GlslVariable *variable = &run->code->variables[k];
            if (variable->storage != GLSL_VARYING && strcmp(variable->name, "gl_Position") != 0)
                continue;
            fprintf(file, " %s (", variable->name);
            put_numbers(file, run->registers + variable->first, variable->count);
            fprintf(file, ")");
        }
        fprintf(file, "\n");
    }
}

static void put_pixel(FILE *file, Raster *raster, const RasterPixel *pixel,
                      const ProbeQuestion *question)
{
    const GlslTree *tree = raster_code(raster, pixel->draw, 1)->tree;
    double color[4];
    const GlslRun *run = raster_run(raster, pixel, &GLSL_LLVMPIPE, INT_MAX, color);
    Trail driver = keep(run, color);
    run = raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, color);
    Trail exact = keep(run, color);
    double computed[4];
    for (int i = 0; i < 4; i++)
        computed[i] = (double)question->drawn[i] / 255;
    fprintf(file, "computed: %.3f, %.3f, %.3f; exactly, the same text: %.3f, %.3f, %.3f\n",
            origin_step(driver.color[0]), origin_step(driver.color[1]),
            origin_step(driver.color[2]), origin_step(exact.color[0]), origin_step(exact.color[1]),
            origin_step(exact.color[2]));
    if (driver.stopped)
        fprintf(file, "a loop does not end\n");
    if (driver.discarded)
        fprintf(file, "the fragment is discarded: the pixel shows what is behind it\n");
    else if (origin_apart(computed, driver.color) > 0.51)
        fprintf(file, "the picture is not that: a line or point is drawn over it, an edge runs "
                      "through it, or the driver computes otherwise\n");
    put_trail(file, tree, &driver, &exact);
    const bool known = put_samplers(file, &question->capture->draws[pixel->draw]);
    put_notes(file, tree, &driver);
    if (known && !driver.discarded)
        put_verdict(file, raster, pixel, &driver, &exact, question);
    put_corners(file, raster, pixel);
    forget(&driver);
    forget(&exact);
}

char *probe_text(const ProbeQuestion *question, Message *message)
{
    Raster *raster;
    RasterPixel pixel;
    char *text = NULL;
    size_t size;
    const unsigned char *drawn = question->drawn;
    if (!raster_open(&raster, question->capture, message))
        return NULL;
    raster_find(raster, question->column, question->height - 1 - question->row, &pixel);
    FILE *file = open_memstream(&text, &size);
    if (!file)
        memory_end();
    fprintf(file, "pixel %d,%d: drawn %d, %d, %d\n", question->column, question->row, drawn[0],
            drawn[1], drawn[2]);
    if (question->object)
        fprintf(file, "exact picture: %.3f, %.3f, %.3f, %s\n", 255 * (double)question->exact[0],
                255 * (double)question->exact[1], 255 * (double)question->exact[2],
                question->object);
    if (pixel.draw < 0)
        fprintf(file, "no triangle is drawn there: the background\n");
    else
        put_pixel(file, raster, &pixel, question);
    raster_close(raster);
    fclose(file);
    return text;
}
