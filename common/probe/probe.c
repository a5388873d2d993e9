/*
 * The fragment's shader is run as the driver computes and exactly. Where the error is born,
 * origin.c says; what magnifies it is the later assignment whose error is the most times larger
 * than all before, when all after the birth is computed exactly.
 */
#include "probe/probe.h"

#include "base/memory.h"
#include "probe/origin.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ProbeTrail keep(const GlslRun *run)
{
    return (ProbeTrail){
        .events = memory_copy(run->events, sizeof *run->events * (size_t)run->event_count),
        .values = memory_copy(run->values, sizeof *run->values * (size_t)run->value_count),
        .count = run->event_count};
}

static void find_magnifier(Probe *probe)
{
    double color[4], before = 0, least = 2;
    raster_log(probe->raster, true);
    const GlslRun *run =
        raster_run(probe->raster, &probe->pixel, raster_driver(probe->raster), probe->birth, color);
    raster_log(probe->raster, false);
    for (int i = probe->birth; i < run->event_count && i < probe->exact.count; i++) {
        const GlslEvent *event = &run->events[i], *exact = &probe->exact.events[i];
        double error = 0;
        if (event->node != exact->node)
            break;
        for (int k = 0; k < event->count; k++)
            error = fmax(
                error, fabs(run->values[event->value + k] - probe->exact.values[exact->value + k]));
        if (before > 0 && error > least * before) {
            probe->magnifier = i;
            probe->magnified = least = error / before;
        }
        before = fmax(before, error);
    }
}

/* Of the text, at the pixel instead of between the corners. */
static const GlslRun *run_at_pixel(Raster *raster, const RasterPixel *pixel, double color[4])
{
    raster_at_pixel(raster, true);
    const GlslRun *run = raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, color);
    raster_at_pixel(raster, false);
    return run;
}

bool probe_exact(const ProbeQuestion *question, double color[4], int *draw)
{
    Raster *raster = NULL;
    RasterPixel pixel = {.draw = -1};
    if (raster_open(&raster, question->capture, question->driver, NULL))
        raster_find(raster, question->column, question->height - 1 - question->row, &pixel);
    const GlslRun *run = pixel.draw < 0 ? NULL : run_at_pixel(raster, &pixel, color);
    const bool known = run && !run->discarded && !origin_undefined(raster, run, color);
    raster_close(raster);
    *draw = pixel.draw;
    return known;
}

static void drawn_color(const Probe *probe, double drawn[4])
{
    for (int i = 0; i < 4; i++)
        drawn[i] = (double)probe->question.drawn[i] / 255;
}

static void judge(Probe *probe)
{
    const ExactPixel *exact = probe->question.exact;
    double *picture = probe->picture;
    probe->judged = true;
    for (int i = 0; i < 3 && exact; i++)
        picture[i] = (double)exact->color[i];
    if (!exact)
        run_at_pixel(probe->raster, &probe->pixel, picture);
    double drawn[4];
    drawn_color(probe, drawn);
    probe->as_drawn = origin_apart(drawn, picture);
    probe->birth = probe->magnifier = -1;
    if (probe->undefined)
        return;
    probe->whole = origin_apart(probe->driver.color, picture);
    probe->formula = origin_apart(probe->exact.color, picture);
    probe->rounding = origin_apart(probe->driver.color, probe->exact.color);
    probe->birth =
        origin_find(probe->raster, &probe->pixel, probe->driver.count, probe->exact.color);
    if (probe->birth >= 0)
        find_magnifier(probe);
}

bool probe_samplers(FILE *file, const CaptureDraw *draw)
{
    bool known = true;
    for (int i = 0; i < draw->uniform_count; i++) {
        const CaptureUniform *uniform = &draw->uniforms[i];
        const char *unread = raster_unread(draw, uniform);
        if (unread)
            fprintf(file, "%s: %s: taken as black\n", uniform->name, unread);
        else if (uniform->type == GL_SAMPLER_2D && uniform->values[0] < 0)
            fprintf(file, "%s: a sampler without a texture: black\n", uniform->name);
        known &= !unread;
    }
    return known;
}

static void put_notes(FILE *file, const char *source, const GlslRun *run, int count)
{
    for (int i = 0; i < count; i++) {
        char place[PLACE_TEXT];
        const GlslNote *note = &run->notes[i];
        char text[PLACE_TEXT] = "";
        place_name(source, run->code->tree->nodes[note->node].place, place);
        if (note->kind == GLSL_NOTE_UNSET)
            glsl_expression_text(run->code->tree, note->node, text, sizeof text);
        fprintf(file, "%s%s%s: %s\n", place, text[0] ? ", " : "", text, glsl_note_text(note->kind));
    }
}

/* Of the driver's run, which is the last. False: there is no colour to judge. */
static bool put_remarks(FILE *file, const Probe *probe, const GlslRun *run)
{
    const CaptureDraw *draw = &probe->question.capture->draws[probe->pixel.draw];
    const bool discarded = run->discarded;
    if (run->stopped)
        fprintf(file, "a loop does not end\n");
    if (discarded)
        fprintf(file, "the fragment is discarded: the pixel shows what is behind it\n");
    else if (probe->otherwise && !probe->undefined)
        fprintf(file, "the picture is not that: a line or point is drawn over it, an edge runs "
                      "through it, or the driver computes otherwise\n");
    put_notes(file, draw->sources[1], run, run->note_count);
    for (int c = 0; c < 3; c++) {
        run = raster_vertex(probe->raster, probe->pixel.draw, probe->pixel.corners[c],
                            raster_driver(probe->raster));
        if (run->note_count)
            fprintf(file, "vertex %u: ", probe->pixel.corners[c]);
        put_notes(file, draw->sources[0], run, run->note_count > 0);
    }
    return probe_samplers(file, draw) && !discarded;
}

bool probe_open(Probe *probe, const ProbeQuestion *question, Message *message)
{
    size_t size;
    *probe = (Probe){.question = *question};
    if (!raster_open(&probe->raster, question->capture, question->driver, message))
        return false;
    FILE *file = open_memstream(&probe->remarks, &size);
    if (!file)
        memory_end();
    raster_find(probe->raster, question->column, question->height - 1 - question->row,
                &probe->pixel);
    bool judges = false;
    if (probe->pixel.draw >= 0) {
        double color[4], drawn[4];
        const GlslRun *run = raster_run(probe->raster, &probe->pixel, &GLSL_EXACT, INT_MAX, color);
        probe->exact = keep(run);
        probe->undefined = origin_undefined(probe->raster, run, color);
        memcpy(probe->exact.color, color, sizeof color);
        run =
            raster_run(probe->raster, &probe->pixel, raster_driver(probe->raster), INT_MAX, color);
        probe->driver = keep(run);
        probe->undefined |= origin_undefined(probe->raster, run, color);
        drawn_color(probe, drawn);
        probe->otherwise = origin_apart(drawn, color) > 0.51;
        memcpy(probe->driver.color, color, sizeof color);
        judges = put_remarks(file, probe, run);
    } else {
        fprintf(file, "no triangle is drawn there: the background\n");
    }
    fclose(file);
    if (judges)
        judge(probe);
    if (probe->pixel.draw >= 0) {
        double color[4];
        probe->run =
            raster_run(probe->raster, &probe->pixel, raster_driver(probe->raster), INT_MAX, color);
    }
    return true;
}

void probe_close(Probe *probe)
{
    raster_close(probe->raster);
    free(probe->driver.events);
    free(probe->driver.values);
    free(probe->exact.events);
    free(probe->exact.values);
    free(probe->remarks);
    *probe = (Probe){.raster = NULL};
}
