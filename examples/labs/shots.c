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
        if (lab->specular && lab->reflection == REFLECTION_BLINN_PHONG)
            *shininess = truth == 0 ? probe->fitted[i] : 4 * *shininess;
    }
    return scene;
}

static bool open_truths(Shots *shots, Shot *shot, Message *message)
{
    /* Others may be judged at the same time: one thread for each. */
    const ReferenceOptions options = {.width = shot->probe.width,
                                      .height = shot->probe.height,
                                      .meshes = !shots->lab->budget,
                                      .edge_error = 255, /* edges are not compared */
                                      .threads = 1};
    for (int i = 0; i < shots->truth_count; i++) {
        Object objects[PROBE_MOST_OBJECTS];
        const Scene scene = shots_truth_scene(shots->lab, &shot->probe, i, objects);
        if (!scene_check(&scene, message) ||
            !reference_open(&shot->truths[i], &scene, &options, message))
            return false;
    }
    return image_open(&shot->image, shot->probe.width, shot->probe.height, IMAGE_BYTE, message);
}

/* G is apart: it is about precision alone. */
static bool open_all(Shots *shots, uint64_t seed, Message *message)
{
    for (int set = 0; set < 2; set++) {
        for (ProbeKind kind = PROBE_PLAIN; kind < PROBE_HUGE; kind++) {
            Shot *shot = &shots->shots[shots->count];
            if (set == 0 ? !probe_open_known(&shot->probe, shots->lab, kind, message)
                         : !probe_open_seed(&shot->probe, shots->lab, kind, seed, message))
                return false;
            shots->count++;
            if (!open_truths(shots, shot, message))
                return false;
        }
    }
    return true;
}

bool shots_open(Shots *shots, const Lab *lab, uint64_t seed, Message *message)
{
    const bool fitted = lab->specular && lab->reflection == REFLECTION_BLINN_PHONG;
    *shots = (Shots){.lab = lab, .truth_count = lab->either || fitted ? 2 : 1};
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
        if (set == 0 ? !probe_open_known(&shot->probe, shots->lab, PROBE_HUGE, message)
                     : !probe_open_seed(&shot->probe, shots->lab, PROBE_HUGE, seed, message))
            return false;
        shots->count++;
        if (!open_truths(shots, shot, message) ||
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
        const ReferenceOptions options = {.width = shot->probe.width,
                                          .height = shot->probe.height,
                                          .meshes = true,
                                          .edge_error = 255,
                                          .threads = 1};
        objects[0].mesh = &shots->mesh;
        if (!reference_open(&shot->mask, &scene, &options, message))
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
