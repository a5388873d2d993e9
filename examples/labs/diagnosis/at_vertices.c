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
} Blend;

/* The value of the node's next turn at a corner; NULL: it is not reached as often there. */
static const double *value_at(const Values *values, int node, int turn)
{
    for (int i = 0; i < values->count; i++)
        if (values->items[i].stage == GLSL_FRAGMENT && values->items[i].node == node && turn-- == 0)
            return values->items[i].numbers;
    return NULL;
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
    blend->turn++;
}

/* How far the submission is from the right program with this value interpolated; more than
 * `enough`: no further points are looked at. */
static double apart_with(Derivation *all, Values corners[POINT_CORNERS], int node, double enough)
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
        Blend blend = {corners, all->points.items[point].weights, node, 0};
        run->assigned = interpolate;
        run->observer = &blend;
        points_run(&all->points, &all->right[0], &all->right[1], point, numbers);
        run->assigned = NULL;
        apart = fmax(apart, points_apart(numbers, all->wanted[point]));
    }
    return apart;
}

bool at_vertices_explain(Derivation *all, Verdict *verdict)
{
    Values *values = memory_new(1 + POINT_CORNERS, sizeof *values);
    char name[64], look[128];
    bool found = false;
    values_trace(&all->points, &all->right[0], &all->right[1], all->order[0], values);
    for (int i = values->count - 1; i >= 0 && !found; i--) {
        const char *what =
            all->right[values->items[i].stage].tree->symbols[values->items[i].symbol].name;
        found = values->items[i].stage == GLSL_FRAGMENT &&
                apart_with(all, values + 1, values->items[i].node, DERIVATION_EQUAL) <=
                    DERIVATION_EQUAL;
        if (!found)
            continue;
        const bool light = strcmp(what, "gl_FragColor") == 0;
        snprintf(name, sizeof name, "%s at the vertices", light ? "light" : what);
        snprintf(look, sizeof look, "the fragment shader: compute %.40s there",
                 light ? "the light" : what);
        verdict_add_mistake(verdict, name,
                            "It is computed at the vertices and interpolated: the mesh shows.",
                            look, 0.9);
        snprintf(verdict->message, sizeof verdict->message, "%s", name);
    }
    free(values);
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
        const double apart = 255 * apart_with(all, values + 1, values->items[i].node, steps / 255);
        if (apart > 255 * DERIVATION_EQUAL && apart <= steps)
            fprintf(file, "  at the vertices: %s, at most %.2f steps\n",
                    all->right[1].tree->symbols[values->items[i].symbol].name, apart);
    }
    derivation_close(all);
    free(values);
}
