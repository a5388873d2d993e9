#include "shots.h"

#include <stdlib.h>
#include <string.h>

/* Of 16-bit arithmetic on numbers of 300: without an overflow shininess 30 makes up to 80 steps of
 * it in the few pixels of a highlight (README, hard cases); an overflow blackens or whitens. */
static const double MEDIUMP_TOLERANCE = 100;

/* Without a highlight: places are rounded by 1/1000, directions by as much, colours by a step. */
static const double MEDIUMP_MATTE_TOLERANCE = 12;

Scene shots_truth_scene(const Lab *lab, const Probe *probe, int truth,
                        Object objects[PROBE_MOST_OBJECTS])
{
    Scene scene = probe->scene;
    memcpy(objects, probe->objects, PROBE_MOST_OBJECTS * sizeof *objects);
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

static bool open_exact(Reference *exact, const Probe *probe, const Scene *scene, bool meshes,
                       Message *message)
{
    /* Others may be judged at the same time: one thread for each. */
    const ReferenceOptions options = {.width = probe->width,
                                      .height = probe->height,
                                      .meshes = meshes,
                                      .edge_error = 255, /* edges are not compared */
                                      .threads = 1};
    return reference_open(exact, scene, &options, message);
}

/* The scene, known or of the seed, its exact pictures, and room for what is drawn. */
static bool add_shot(Shots *shots, ProbeKind kind, bool known, uint64_t seed, Message *message)
{
    const Lab *lab = shots->lab;
    Shot *shot = &shots->shots[shots->count];
    if (known ? !probe_open_known(&shot->probe, lab, kind, message)
              : !probe_open_seed(&shot->probe, lab, kind, seed, message))
        return false;
    shots->count++;
    for (int i = 0; i < shots->truth_count; i++) {
        Object objects[PROBE_MOST_OBJECTS];
        const Scene scene = shots_truth_scene(lab, &shot->probe, i, objects);
        if (!scene_check(&scene, message) ||
            !open_exact(&shot->truths[i], &shot->probe, &scene, !lab->budget, message))
            return false;
    }
    return image_open(&shot->image, shot->probe.width, shot->probe.height, IMAGE_BYTE, message);
}

/* G is apart: it is about precision alone. */
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

/* The truth is chosen for all scenes together: the least sum of squares. */
static void choose_truth(Shots *shots)
{
    double least = 0;
    for (int truth = 0; truth < shots->truth_count; truth++) {
        double squares = 0;
        for (int i = 0; i < shots->count; i++)
            squares += shots_error(shots, i, truth).squares;
        if (truth == 0 || squares < least) {
            shots->truth = truth;
            least = squares;
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

double shots_tolerance(const Shots *shots, int i)
{
    if (shots->shots[i].probe.kind == PROBE_HUGE)
        return shots->lab->specular ? MEDIUMP_TOLERANCE : MEDIUMP_MATTE_TOLERANCE;
    return shots->lab->budget ? 1 : COMPARE_TOLERANCE;
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
    /* The outline of a finer one is within a tenth of a pixel of the exact one's. */
    enum { FINE = 96 };
    if (!mesh_sphere(&shots->mesh, 1, slices, stacks, message))
        return false;
    for (int i = 0; i < shots->count && (slices < FINE || stacks < FINE); i++) {
        Shot *shot = &shots->shots[i];
        Object objects[PROBE_MOST_OBJECTS];
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

void shots_close(Shots *shots)
{
    if (!shots)
        return;
    for (int i = 0; i < SHOTS_MOST; i++) {
        Shot *shot = &shots->shots[i];
        probe_close(&shot->probe);
        image_close(&shot->image);
        reference_close(&shot->mask);
        for (int k = 0; k < SHOT_MOST_TRUTHS; k++)
            reference_close(&shot->truths[k]);
    }
    mesh_close(&shots->mesh);
    *shots = (Shots){.count = 0};
}
