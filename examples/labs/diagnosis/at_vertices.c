/* A value that is computed at the vertices and interpolated is another between them than one that
 * is computed there. So the right fragment shader runs at the corners of each triangle, too, and
 * then between them with one of its values interpolated: with gl_FragColor all light is at the
 * vertices.
 */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Blend {
    const Values *corners; /* of the right program, at each corner */
    const double *weights;
    int node, turn; /* whose value is interpolated; how often it was reached */
    bool unit;      /* what is interpolated is normalized again */
} Blend;

/* The value of the node's next turn at a corner; NULL: it is not reached as often there. */
static const double *value_at(const Values *values, int node, int turn)
{
    for (int i = 0; i < values->count; i++)
        if (values->items[i].stage == GLSL_FRAGMENT && values->items[i].node == node && turn-- == 0)
            return values->items[i].numbers;
    return NULL;
}

static double square_of(const double *v, int count)
{
    double square = 0;
    for (int k = 0; k < count; k++)
        square += v[k] * v[k];
    return square;
}

static bool is_unit(const double *v)
{
    return fabs(square_of(v, 3) - 1) < 1e-9;
}

static void interpolate(GlslRun *run, const GlslEvent *event, void *observer)
{
    Blend *blend = observer;
    if (event->node != blend->node || event->count > 4)
        return;
    for (int k = 0; k < event->count; k++)
        run->registers[event->first + k] = 0;
    for (int c = 0; c < POINT_CORNERS; c++) {
        const double *numbers = value_at(&blend->corners[c], blend->node, blend->turn);
        for (int k = 0; k < event->count && numbers; k++)
            run->registers[event->first + k] += blend->weights[c] * numbers[k];
    }
    double *to = run->registers + event->first;
    const double length = blend->unit ? sqrt(square_of(to, event->count)) : 0;
    for (int k = 0; k < event->count && length > 0; k++)
        to[k] /= length;
    blend->turn++;
}

/* How far the submission is from the right program with this value interpolated, as it is or
 * normalized again; more than `enough`: no further points are looked at. */
static double apart_with(Derivation *all, Values corners[POINT_CORNERS], int node, bool unit,
                         double enough)
{
    GlslRun *run = all->right[1].run;
    double apart = 0;
    for (int i = 0; i < all->points.count && apart <= enough; i++) {
        const int point = all->order[i];
        double numbers[POINT_NUMBERS];
        for (int c = 0; c < POINT_CORNERS; c++) {
            all->points.corner = c + 1;
            values_trace(&all->points, &all->right[0], &all->right[1], point, &corners[c]);
        }
        all->points.corner = 0;
        Blend blend = {corners, all->points.items[point].weights, node, 0, unit};
        run->assigned = interpolate;
        run->observer = &blend;
        points_run(&all->points, &all->right[0], &all->right[1], point, numbers);
        run->assigned = NULL;
        apart = fmax(apart, points_apart(numbers, all->wanted[point]));
    }
    return apart;
}

/* Which value of the submission's vertex shader is that of the right fragment shader's node at the
 * last corner: its number among `values`; below 0: none. */
static int find_own(Derivation *all, int node, Values *values, Values *right)
{
    all->points.corner = POINT_CORNERS;
    values_trace(&all->points, &all->right[0], &all->right[1], all->order[0], right);
    all->points.corner = 0;
    values_trace(&all->points, &all->own[0], &all->own[1], all->order[0], values);
    for (int i = 0; i < values->count; i++)
        for (int k = 0; k < right->count && values->items[i].stage == GLSL_VERTEX; k++)
            if (right->items[k].stage == GLSL_FRAGMENT && right->items[k].node == node &&
                values_equal(values, i, right, k))
                return i;
    return -1;
}

bool at_vertices_explain(Derivation *all, Verdict *verdict)
{
    Values *values = memory_new(1 + POINT_CORNERS, sizeof *values);
    char name[64], look[VERDICT_SENTENCE_SIZE];
    bool found = false;
    values_trace(&all->points, &all->right[0], &all->right[1], all->order[0], values);
    for (int i = values->count - 1; i >= 0 && !found; i--) {
        const char *what =
            all->right[values->items[i].stage].tree->symbols[values->items[i].symbol].name;
        const bool units = values->items[i].size == 3 && is_unit(values->items[i].numbers);
        for (int unit = 0; unit <= units && !found; unit++)
            found = values->items[i].stage == GLSL_FRAGMENT &&
                    apart_with(all, values + 1, values->items[i].node, unit, DERIVATION_EQUAL) <=
                        DERIVATION_EQUAL;
        if (!found)
            continue;
        const bool light = strcmp(what, "gl_FragColor") == 0;
        const int own = find_own(all, values->items[i].node, values + 1, values + 2);
        if (own >= 0) {
            what = all->own[0].tree->symbols[values[1].items[own].symbol].name;
            derivation_place(all, GLSL_VERTEX, values[1].items[own].node, look, sizeof look);
        } else
            snprintf(look, sizeof look, "the fragment shader: compute %.40s there",
                     light ? "the light" : what);
        snprintf(name, sizeof name, "%.40s at the vertices", light ? "light" : what);
        verdict_add_mistake(verdict, name,
                            "It is computed at the vertices and interpolated: the mesh shows.",
                            look, 0.9);
        snprintf(verdict->message, sizeof verdict->message, "%s", name);
    }
    free(values);
    return found;
}

/* The submission's own varying, whose value is computed at the point instead: from values of the
 * vertex shader that are interpolated, those of length 1 to length 1. */
enum { MOST_EVENTS = 64 };

typedef struct Varying {
    double numbers[POINT_CORNERS * MOST_EVENTS]
                  [4]; /* what is assigned, one corner after the other */
    int count, at;
    const double *weights;
    bool bent;        /* it is not just of another length than what is interpolated */
    int symbol, from; /* the varying; the event from which on values are computed at the point */
} Varying;

static void record(GlslRun *run, const GlslEvent *event, void *observer)
{
    Varying *varying = observer;
    if (varying->count < POINT_CORNERS * MOST_EVENTS)
        for (int k = 0; k < event->count && k < 4; k++)
            varying->numbers[varying->count][k] = run->registers[event->first + k];
    varying->count++;
}

static bool is_parallel(const double *a, const double *b)
{
    const double cross[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
    const double all = fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    return fabs(cross[0]) + fabs(cross[1]) + fabs(cross[2]) <= 1e-6 * all;
}

static void blend(GlslRun *run, const GlslEvent *event, void *observer)
{
    Varying *varying = observer;
    const int each = varying->count / POINT_CORNERS, at = varying->at++ % each;
    double mixed[4] = {0}, *to = run->registers + event->first;
    bool unit = event->count == 3;
    for (int c = 0; c < POINT_CORNERS; c++) {
        const double *numbers = varying->numbers[c * each + at];
        for (int k = 0; k < event->count && k < 4; k++)
            mixed[k] += varying->weights[c] * numbers[k];
        unit &= is_unit(numbers);
    }
    if (event->symbol == varying->symbol && at >= varying->from)
        varying->bent |= event->count != 3 || !is_parallel(mixed, to);
    if (event->count > 4 || at >= varying->from)
        return;
    const double length = unit ? sqrt(square_of(mixed, 3)) : 0;
    for (int k = 0; k < event->count; k++)
        to[k] = mixed[k] / (length > 0 ? length : 1);
}

/* Runs the submission with the varying as it is computed at the point, and all others as they are.
 * False: it computes more at one corner than at another. */
static bool run_with(Derivation *all, Varying *varying, int point, double numbers[POINT_NUMBERS])
{
    PointShader *vertex = &all->own[0];
    const int width = vertex->width;
    double *outputs = vertex->outputs + (size_t)(point * POINT_CORNERS * width);
    double *kept = memory_new((size_t)(POINT_CORNERS * width), sizeof *kept);
    varying->count = varying->at = 0;
    for (int once = 0; once < 2; once++) {
        vertex->at_once = once;
        vertex->run->assigned = once ? blend : record;
        vertex->done[point] = false;
        points_run(&all->points, vertex, &all->own[1], point, numbers);
        for (int i = 0, at = 0; i < vertex->code->variable_count; i++) {
            const GlslVariable *variable = &vertex->code->variables[i];
            const bool out = points_is_output(variable), same = variable->symbol != varying->symbol;
            for (int k = 0; k < POINT_CORNERS && out && (!once || same); k++)
                memcpy((once ? outputs : kept) + k * width + at,
                       (once ? kept : outputs) + k * width + at,
                       (size_t)variable->count * sizeof(double));
            at += out ? variable->count : 0;
        }
        if (varying->count % POINT_CORNERS || varying->count > POINT_CORNERS * MOST_EVENTS ||
            !varying->count)
            break;
    }
    const bool same = vertex->at_once;
    if (same)
        points_run(&all->points, vertex, &all->own[1], point, numbers);
    free(kept);
    return same;
}

/* Whether the submission is right with the varying computed at each point. */
static bool is_right_with(Derivation *all, Varying *varying)
{
    bool right = true;
    varying->bent = false;
    all->own[0].run->observer = varying;
    for (int i = 0; i < all->points.count && right; i++) {
        const int point = all->order[i];
        double numbers[POINT_NUMBERS];
        varying->weights = all->points.items[point].weights;
        right = run_with(all, varying, point, numbers) &&
                points_apart(numbers, all->exact[point]) <= DERIVATION_EQUAL;
        all->own[0].done[point] = false;
    }
    all->own[0].at_once = false;
    all->own[0].run->assigned = NULL;
    return right && varying->bent;
}

bool at_vertices_explain_own(Derivation *all, Verdict *verdict)
{
    PointShader *vertex = &all->own[0];
    Values *values = memory_new(1, sizeof *values);
    Varying *varying = memory_new(1, sizeof *varying);
    GlslEvent events[MOST_EVENTS];
    char name[64], place[VERDICT_SENTENCE_SIZE];
    bool found = false;
    values_trace(&all->points, vertex, &all->own[1], all->order[0], values);
    const int count =
        vertex->run->event_count < MOST_EVENTS ? vertex->run->event_count : MOST_EVENTS;
    memcpy(events, vertex->run->events, (size_t)count * sizeof *events);
    for (int i = 0; i < count && !found; i++) {
        const GlslSymbol *symbol = &vertex->tree->symbols[events[i].symbol];
        varying->symbol = events[i].symbol;
        if (symbol->storage != GLSL_VARYING)
            continue;
        for (varying->from = i; varying->from >= 0 && !found; varying->from--)
            found = is_right_with(all, varying);
        if (!found)
            continue;
        snprintf(name, sizeof name, "%.40s at the vertices", symbol->name);
        derivation_place(all, GLSL_VERTEX, events[i].node, place, sizeof place);
        verdict_add_mistake(verdict, name,
                            "It is computed at the vertices and interpolated: the mesh shows.",
                            place, 0.9);
        snprintf(verdict->message, sizeof verdict->message, "%s", name);
    }
    free(values);
    free(varying);
    return found;
}

void at_vertices_report(const LabPictures *pictures, FILE *file, Message *message)
{
    const double steps = lab_pictures_tolerance(pictures, 0);
    Values *values = memory_new(1 + POINT_CORNERS, sizeof *values);
    Derivation *all = derivation_open(pictures, pictures->lab->solutions, message);
    if (all && derive_use_right(all, "", LIT_AT_VERTICES))
        values_trace(&all->points, &all->right[0], &all->right[1], all->order[0], values);
    for (int i = 0; i < values->count; i++) {
        if (values->items[i].stage != GLSL_FRAGMENT)
            continue;
        const double apart =
            255 * apart_with(all, values + 1, values->items[i].node, false, steps / 255);
        if (apart > 255 * DERIVATION_EQUAL && apart <= steps)
            fprintf(file, "  at the vertices: %s, at most %.2f steps\n",
                    all->right[1].tree->symbols[values->items[i].symbol].name, apart);
    }
    derivation_close(all);
    free(values);
}
