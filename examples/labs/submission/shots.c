/* Exact pictures are made once, with as many truths as are right; which of them a submission is
 * compared with is the one that it is nearest to in all scenes together. */
#include "labs/submission/shots.h"

#include "labs/program/probe_open.h"

#include <stdlib.h>
#include <string.h>

/* 16-bit arithmetic on distances of 300: without overflow shininess 30 makes errors of up to 80
 * steps in the few pixels of a highlight (examples/study, hard cases); overflow makes black or
 * white. */
static const double MEDIUMP_TOLERANCE = 100;

/* Lab 10's one step, and a quarter for rounding: the chapter's plain program, which its task calls
 * right, makes up to 1.12. */
static const double BUDGET_TOLERANCE = 1.25;

/* Without a highlight: positions and directions are rounded by 1/1000, colours by a step. */
static const double MEDIUMP_MATTE_TOLERANCE = 12;

Scene shots_truth_scene(const Lab *lab, const Probe *probe, int truth,
                        Object objects[PROBE_MAX_OBJECTS])
{
    Scene scene = probe->scene;
    memcpy(objects, probe->objects, PROBE_MAX_OBJECTS * sizeof *objects);
    scene.objects = objects;
    if (lab->either && truth == 1)
        scene.interpolation = INTERPOLATION_GOURAUD;
    for (int i = 0; i < scene.object_count; i++) {
        double *shininess = &objects[i].front.shininess;
        if (lab->fitted)
            *shininess = truth == 0 ? probe->fitted[i] : 4 * *shininess;
    }
    return scene;
}

/* Whether all pixels that near show the same object, in the same light. */
static bool is_far_from_edges(const Reference *exact, int x, int y, int reach)
{
    const size_t width = (size_t)exact->width, own = (size_t)y * width + (size_t)x;
    for (int v = y - reach; v <= y + reach; v++) {
        for (int u = x - reach; u <= x + reach; u++) {
            const size_t i = (size_t)v * width + (size_t)u;
            if (u >= 0 && v >= 0 && u < exact->width && v < exact->height &&
                (exact->object[i] != exact->object[own] || exact->lights[i] != exact->lights[own]))
                return false;
        }
    }
    return true;
}

bool shots_leave_out_edges(Reference *exact, Message *message)
{
    /* A fiftieth of the picture, or two pixels: in the scenes two to eight texels, and what a bias
     * of a few thousandths leaks. */
    const int share = (exact->height + 49) / 50, reach = share > 2 ? share : 2;
    const size_t count = (size_t)exact->width * (size_t)exact->height;
    unsigned char *interior = exact->lights ? malloc(count) : NULL;
    if (!exact->lights)
        return true;
    if (!interior)
        return message_set(message, "not enough memory");
    for (size_t i = 0; i < count; i++)
        interior[i] =
            exact->interior[i] && is_far_from_edges(exact, (int)(i % (size_t)exact->width),
                                                    (int)(i / (size_t)exact->width), reach);
    memcpy(exact->interior, interior, count);
    free(interior);
    return true;
}

static bool open_exact(Reference *exact, const Probe *probe, const Scene *scene, bool meshes,
                       Message *message)
{
    /* One thread, because other submissions are judged at the same time. */
    const ReferenceOptions options = {.width = probe->width,
                                      .height = probe->height,
                                      .meshes = meshes,
                                      .edge_error = 255, /* edges are not compared */
                                      .threads = 1};
    return reference_open(exact, scene, &options, message) && shots_leave_out_edges(exact, message);
}

static bool add_shot(Shots *shots, ProbeKind kind, bool known, uint64_t seed, Message *message)
{
    const Lab *lab = shots->lab;
    Shot *shot = &shots->shots[shots->count];
    if (known ? !probe_open_known(&shot->probe, lab, kind, message)
              : !probe_open_seed(&shot->probe, lab, kind, seed, message))
        return false;
    shots->count++;
    for (int i = 0; i < shots->truth_count; i++) {
        Object objects[PROBE_MAX_OBJECTS];
        const Scene scene = shots_truth_scene(lab, &shot->probe, i, objects);
        if (!scene_check(&scene, message) ||
            !open_exact(&shot->truths[i], &shot->probe, &scene, !lab->budget, message))
            return false;
    }
    return image_open(&shot->image, shot->probe.width, shot->probe.height, IMAGE_BYTE, message);
}

/* Without G, which tests only precision. */
static bool open_all(Shots *shots, uint64_t seed, Message *message)
{
    for (int set = 0; set < 2; set++)
        for (ProbeKind kind = PROBE_PLAIN; kind < PROBE_HUGE; kind++)
            if (!add_shot(shots, kind, set == 0, seed, message))
                return false;
    return true;
}

bool shots_open(Shots *shots, const Lab *lab, uint64_t seed, Message *message)
{
    *shots = (Shots){.lab = lab, .truth_count = lab->either || lab->fitted ? 2 : 1};
    if (open_all(shots, seed, message))
        return true;
    shots_close(shots);
    return false;
}

SubmissionGeometry shots_geometry(const Shots *shots, int i)
{
    SubmissionGeometry geometry = {.cull = shots->geometry.cull};
    if (shots->lab->given) {
        geometry.world_from_object = &shots->world_from_object[i];
        geometry.normal_matrix = &shots->normal_matrix[i];
    }
    if (shots->lab->budget)
        geometry.mesh = &shots->mesh;
    return geometry;
}

/* The least sum of squares over all scenes. */
static void choose_truth(Shots *shots)
{
    double min = 0;
    for (int truth = 0; truth < shots->truth_count; truth++) {
        double squares = 0;
        for (int i = 0; i < shots->count; i++)
            squares += shots_error(shots, i, truth).squares;
        if (truth == 0 || squares < min) {
            shots->truth = truth;
            min = squares;
        }
    }
}

bool shots_draw(Shots *shots, const Painter *painter, Canvas *canvas, Message *message)
{
    for (int i = 0; i < shots->count; i++) {
        Shot *shot = &shots->shots[i];
        const SubmissionGeometry geometry = shots_geometry(shots, i);
        if (!painter_draw(painter, &shot->probe, &geometry, canvas, &shot->image, message))
            return false;
    }
    choose_truth(shots);
    return true;
}

bool shots_draw_own(Shots *shots, const Painter *painter, Canvas *canvas, Message *message)
{
    shots->own = true;
    return shots_draw(shots, painter, canvas, message);
}

double shots_tolerance(const Shots *shots, int i)
{
    if (shots->own)
        return MEDIUMP_MATTE_TOLERANCE;
    if (shots->shots[i].probe.kind == PROBE_HUGE)
        return shots->lab->specular ? MEDIUMP_TOLERANCE : MEDIUMP_MATTE_TOLERANCE;
    return shots->lab->budget ? BUDGET_TOLERANCE : COMPARE_TOLERANCE;
}

bool shots_draw_huge(Shots *shots, uint64_t seed, const Painter *painter, Canvas *canvas,
                     Message *message)
{
    for (int set = 0; set < 2; set++) {
        Shot *shot = &shots->shots[shots->count];
        const SubmissionGeometry geometry = {.mesh = NULL};
        if (!add_shot(shots, PROBE_HUGE, set == 0, seed, message) ||
            !painter_draw(painter, &shot->probe, &geometry, canvas, &shot->image, message))
            return false;
    }
    return true;
}

bool shots_use_sphere(Shots *shots, int slices, int stacks, Message *message)
{
    /* The outline of a finer sphere is within a tenth of a pixel of the exact one. */
    enum { FINE = 96 };
    mesh_close(&shots->mesh);
    if (!mesh_sphere(&shots->mesh, 1, slices, stacks, message))
        return false;
    for (int i = 0; i < shots->count; i++) {
        Shot *shot = &shots->shots[i];
        reference_close(&shot->mask);
        shot->mask = (Reference){.width = 0};
        if (slices >= FINE && stacks >= FINE)
            continue;
        Object objects[PROBE_MAX_OBJECTS];
        Scene scene = shots_truth_scene(shots->lab, &shot->probe, 0, objects);
        objects[0].mesh = &shots->mesh;
        if (!open_exact(&shot->mask, &shot->probe, &scene, true, message))
            return false;
    }
    return true;
}

ErrorSum shots_error(const Shots *shots, int i, int truth)
{
    const Shot *shot = &shots->shots[i];
    return compare_exact(&shot->image, &shot->truths[truth], shot->mask.color ? &shot->mask : NULL);
}

/* A size and a place in a larger picture. */
typedef struct Place {
    int width, height, left, top;
} Place;

/* Draws the lab's own scene there, and compares with the exact picture. */
static bool check_place(const Shots *shots, const Painter *painter, Canvas *canvas, Place place,
                        bool *right, Message *message)
{
    Probe probe;
    Image image = {0};
    Reference exact = {.width = 0}, mask = {.width = 0};
    Object objects[PROBE_MAX_OBJECTS];
    const bool budget = shots->lab->budget;
    const SubmissionGeometry geometry = {.mesh = budget ? &shots->mesh : NULL,
                                         .cull = shots->geometry.cull};
    if (!probe_open_usual(&probe, shots->lab, 1, message))
        return false;
    probe.width = place.width;
    probe.height = place.height;
    Scene scene = shots_truth_scene(shots->lab, &probe, shots->truth, objects);
    bool done = open_exact(&exact, &probe, &scene, !budget, message);
    if (budget)
        objects[0].mesh = &shots->mesh;
    done = done && (!budget || open_exact(&mask, &probe, &scene, true, message)) &&
           image_open(&image, place.width, place.height, IMAGE_BYTE, message) &&
           painter_draw_at(painter, &probe, &geometry, (PainterView){canvas, place.left, place.top},
                           &image, message);
    if (done && compare_exact(&image, &exact, budget ? &mask : NULL).maximum >
                    (budget ? BUDGET_TOLERANCE : COMPARE_TOLERANCE))
        *right = false;
    image_close(&image);
    reference_close(&exact);
    reference_close(&mask);
    probe_close(&probe);
    return done;
}

bool shots_check_sizes(const Shots *shots, uint64_t seed, const Painter *painter, Canvas *canvas,
                       bool *right, Message *message)
{
    enum { COUNTED = 400 };
    Random random = {seed * 7919 + 17};
    Place place;
    /* About the size at which the lab's own program draws. */
    place.width = (int)random_between(&random, 380, 420);
    place.height = (int)random_between(&random, 380, 420);
    place.left = (int)random_between(&random, 100, 300);
    place.top = (int)random_between(&random, 100, 300);
    *right = true;
    return (!shots->lab->budget ||
            check_place(shots, painter, canvas, (Place){COUNTED, COUNTED, 0, 0}, right, message)) &&
           check_place(shots, painter, canvas, place, right, message);
}

void shots_close(Shots *shots)
{
    if (!shots)
        return;
    for (int i = 0; i < SHOTS_MAX; i++) {
        Shot *shot = &shots->shots[i];
        probe_close(&shot->probe);
        image_close(&shot->image);
        reference_close(&shot->mask);
        for (int k = 0; k < SHOT_MAX_TRUTHS; k++)
            reference_close(&shot->truths[k]);
    }
    mesh_close(&shots->mesh);
    *shots = (Shots){.count = 0};
}
