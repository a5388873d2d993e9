/* Exact pictures are made once, with as many truths as are right; which of them a submission is
 * compared with is the one that it is nearest to in all scenes together. */
#include "labs/submission/lab_pictures.h"

#include "base/memory.h"
#include "labs/program/lab_scene_open.h"

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

Scene lab_pictures_truth_scene(const Lab *lab, const LabScene *lab_scene, int truth,
                               Object objects[LAB_SCENE_MAX_OBJECTS])
{
    Scene scene = lab_scene->scene;
    memcpy(objects, lab_scene->objects, LAB_SCENE_MAX_OBJECTS * sizeof *objects);
    scene.objects = objects;
    if (lab->either && truth == 1 && !lab->solution_count)
        scene.interpolation = INTERPOLATION_GOURAUD;
    for (int i = 0; i < scene.object_count; i++) {
        double *shininess = &objects[i].front.shininess;
        if (lab->fitted)
            *shininess = truth == 0 ? lab_scene->fitted[i] : 4 * *shininess;
    }
    return scene;
}

/* Whether all pixels that near show the same object, in the same light. */
static bool is_far_from_edges(const Reference *exact, int x, int y, int reach)
{
    const size_t width = (size_t)exact->width, own = (size_t)y * width + (size_t)x;
    for (int v = y - reach; v <= y + reach; v++)
        for (int u = x - reach; u <= x + reach; u++) {
            const size_t i = (size_t)v * width + (size_t)u;
            if (u >= 0 && v >= 0 && u < exact->width && v < exact->height &&
                (exact->object[i] != exact->object[own] || exact->lights[i] != exact->lights[own]))
                return false;
        }
    return true;
}

void lab_pictures_leave_out_edges(Reference *exact)
{
    /* A fiftieth of the picture, or two pixels: in the scenes two to eight texels, and what a bias
     * of a few thousandths leaks. */
    const int share = (exact->height + 49) / 50, reach = share > 2 ? share : 2;
    const size_t count = (size_t)exact->width * (size_t)exact->height;
    if (!exact->lights)
        return;
    unsigned char *interior = memory_new(count, 1);
    for (size_t i = 0; i < count; i++)
        interior[i] =
            exact->interior[i] && is_far_from_edges(exact, (int)(i % (size_t)exact->width),
                                                    (int)(i / (size_t)exact->width), reach);
    memcpy(exact->interior, interior, count);
    free(interior);
}

static bool open_exact(Reference *exact, const LabScene *lab_scene, const Scene *scene, bool meshes,
                       Message *message)
{
    /* One thread, because other submissions are judged at the same time. */
    const ReferenceOptions options = {.width = lab_scene->width,
                                      .height = lab_scene->height,
                                      .meshes = meshes,
                                      .edge_error = 255, /* edges are not compared */
                                      .threads = 1};
    if (!reference_open(exact, scene, &options, message))
        return false;
    lab_pictures_leave_out_edges(exact);
    return true;
}

static bool add_picture(LabPictures *pictures, LabSceneKind kind, bool known, uint64_t seed,
                        Message *message)
{
    const Lab *lab = pictures->lab;
    LabPicture *picture = &pictures->items[pictures->count];
    if (known ? !lab_scene_open_known(&picture->lab_scene, lab, kind, message)
              : !lab_scene_open_seed(&picture->lab_scene, lab, kind, seed, message))
        return false;
    pictures->count++;
    for (int i = 0; i < pictures->truth_count; i++) {
        Object objects[LAB_SCENE_MAX_OBJECTS];
        const Scene scene = lab_pictures_truth_scene(lab, &picture->lab_scene, i, objects);
        if (!scene_check(&scene, message) ||
            !open_exact(&picture->truths[i], &picture->lab_scene, &scene, !lab->budget, message))
            return false;
    }
    return image_open(&picture->image, picture->lab_scene.width, picture->lab_scene.height,
                      IMAGE_BYTE, message);
}

/* Without G, which tests only precision. */
static bool open_all(LabPictures *pictures, uint64_t seed, Message *message)
{
    for (int set = 0; set < 2; set++)
        for (LabSceneKind kind = LAB_SCENE_PLAIN; kind < LAB_SCENE_HUGE; kind++)
            if (!add_picture(pictures, kind, set == 0, seed, message))
                return false;
    return true;
}

bool lab_pictures_open(LabPictures *pictures, const Lab *lab, uint64_t seed, Message *message)
{
    *pictures = (LabPictures){.lab = lab,
                              .truth_count = lab->solution_count          ? lab->solution_count
                                             : lab->either || lab->fitted ? 2
                                                                          : 1};
    if (open_all(pictures, seed, message))
        return true;
    lab_pictures_close(pictures);
    return false;
}

/* Draws a solution there. */
static bool take_solution(const Painter *solution, const LabScene *lab_scene, PainterView view,
                          Reference *exact, Message *message)
{
    const SubmissionGeometry geometry = {.mesh = NULL};
    Image image = {0};
    const bool done =
        image_open(&image, lab_scene->width, lab_scene->height, IMAGE_BYTE, message) &&
        painter_draw_at(solution, lab_scene, &geometry, view, &image, message);
    if (done)
        compare_take(exact, &image);
    image_close(&image);
    return done;
}

bool lab_pictures_use_solutions(LabPictures *pictures, const Painter *solutions, Canvas *canvas,
                                Message *message)
{
    bool done = true;
    pictures->solutions = solutions;
    for (int i = 0; i < pictures->count; i++)
        for (int k = 0; k < pictures->truth_count && done; k++)
            done =
                take_solution(&solutions[k], &pictures->items[i].lab_scene,
                              (PainterView){canvas, 0, 0}, &pictures->items[i].truths[k], message);
    return done;
}

SubmissionGeometry lab_pictures_geometry(const LabPictures *pictures, int i)
{
    SubmissionGeometry geometry = {.cull = pictures->geometry.cull};
    if (pictures->lab->given) {
        geometry.world_from_object = &pictures->world_from_object[i];
        geometry.normal_matrix = &pictures->normal_matrix[i];
    }
    if (pictures->lab->budget)
        geometry.mesh = &pictures->mesh;
    return geometry;
}

ErrorSum lab_picture_error(const LabPicture *picture, int truth)
{
    return compare_exact(&picture->image, &picture->truths[truth],
                         picture->mask.color ? &picture->mask : NULL);
}

/* The least sum of squares over all scenes. */
static void choose_truth(LabPictures *pictures)
{
    double min = 0;
    for (int truth = 0; truth < pictures->truth_count; truth++) {
        double squares = 0;
        for (int i = 0; i < pictures->count; i++)
            squares += lab_picture_error(&pictures->items[i], truth).squares;
        if (truth == 0 || squares < min) {
            pictures->truth = truth;
            min = squares;
        }
    }
}

bool lab_pictures_draw(LabPictures *pictures, const Painter *painter, Canvas *canvas,
                       Message *message)
{
    for (int i = 0; i < pictures->count; i++) {
        LabPicture *picture = &pictures->items[i];
        const SubmissionGeometry geometry = lab_pictures_geometry(pictures, i);
        if (!painter_draw(painter, &picture->lab_scene, &geometry, canvas, &picture->image,
                          message))
            return false;
    }
    choose_truth(pictures);
    return true;
}

bool lab_pictures_is_right(const LabPictures *pictures, const Painter *painter, Canvas *canvas,
                           bool *right, Message *message)
{
    const int all = (1 << pictures->truth_count) - 1;
    int wrong = 0; /* a bit for each truth */
    bool done = true;
    for (int i = 0; i < pictures->count && done && wrong != all; i++) {
        LabPicture drawn = pictures->items[i];
        const SubmissionGeometry geometry = lab_pictures_geometry(pictures, i);
        done =
            image_open(&drawn.image, drawn.image.width, drawn.image.height, IMAGE_BYTE, message) &&
            painter_draw(painter, &drawn.lab_scene, &geometry, canvas, &drawn.image, message);
        for (int k = 0; k < pictures->truth_count && done; k++)
            if (lab_picture_error(&drawn, k).maximum > lab_pictures_tolerance(pictures, i))
                wrong |= 1 << k;
        image_close(&drawn.image);
    }
    *right = done && wrong != all;
    return done;
}

static double tolerance_of(const Lab *lab)
{
    return lab->tolerance > 0 ? lab->tolerance : lab->budget ? BUDGET_TOLERANCE : COMPARE_TOLERANCE;
}

double lab_pictures_tolerance(const LabPictures *pictures, int i)
{
    if (pictures->own)
        return MEDIUMP_MATTE_TOLERANCE;
    if (pictures->items[i].lab_scene.kind == LAB_SCENE_HUGE)
        return pictures->lab->specular ? MEDIUMP_TOLERANCE : MEDIUMP_MATTE_TOLERANCE;
    return tolerance_of(pictures->lab);
}

bool lab_pictures_draw_huge(LabPictures *pictures, uint64_t seed, const Painter *painter,
                            Canvas *canvas, Message *message)
{
    for (int set = 0; set < 2; set++) {
        LabPicture *picture = &pictures->items[pictures->count];
        const SubmissionGeometry geometry = {.mesh = NULL};
        if (!add_picture(pictures, LAB_SCENE_HUGE, set == 0, seed, message) ||
            !painter_draw(painter, &picture->lab_scene, &geometry, canvas, &picture->image,
                          message))
            return false;
    }
    return true;
}

bool lab_pictures_use_sphere(LabPictures *pictures, int slices, int stacks, Message *message)
{
    /* The outline of a finer sphere is within a tenth of a pixel of the exact one. */
    enum { FINE = 96 };
    mesh_close(&pictures->mesh);
    if (!mesh_sphere(&pictures->mesh, 1, slices, stacks, message))
        return false;
    for (int i = 0; i < pictures->count; i++) {
        LabPicture *picture = &pictures->items[i];
        reference_close(&picture->mask);
        picture->mask = (Reference){.width = 0};
        if (slices >= FINE && stacks >= FINE)
            continue;
        Object objects[LAB_SCENE_MAX_OBJECTS];
        Scene scene = lab_pictures_truth_scene(pictures->lab, &picture->lab_scene, 0, objects);
        objects[0].mesh = &pictures->mesh;
        if (!open_exact(&picture->mask, &picture->lab_scene, &scene, true, message))
            return false;
    }
    return true;
}

/* A size and a place in a larger picture. */
typedef struct Place {
    int width, height, left, top;
} Place;

/* Compares the lab's own scene there with the exact picture: each pixel, or each ninth. */
static bool check_place(const LabPictures *pictures, const Painter *painter, Canvas *canvas,
                        Place place, bool *right, Message *message)
{
    LabScene lab_scene;
    Image image = {0};
    Reference exact = {.width = 0}, mask = {.width = 0};
    Object objects[LAB_SCENE_MAX_OBJECTS];
    const bool budget = pictures->lab->budget;
    const SubmissionGeometry geometry = {.mesh = budget ? &pictures->mesh : NULL,
                                         .cull = pictures->geometry.cull};
    if (!lab_scene_open_usual(&lab_scene, pictures->lab, 1, message))
        return false;
    const int every = budget ? 1 : 3;
    lab_scene.width = place.width / every;
    lab_scene.height = place.height / every;
    Scene scene = lab_pictures_truth_scene(pictures->lab, &lab_scene, pictures->truth, objects);
    const PainterView view = {canvas, place.left, place.top};
    bool done = open_exact(&exact, &lab_scene, &scene, !budget, message);
    if (budget)
        objects[0].mesh = &pictures->mesh;
    done = done && (!budget || open_exact(&mask, &lab_scene, &scene, true, message));
    lab_scene.width *= every;
    lab_scene.height *= every;
    done = done &&
           (!pictures->solutions || take_solution(&pictures->solutions[pictures->truth], &lab_scene,
                                                  view, &exact, message)) &&
           image_open(&image, lab_scene.width, lab_scene.height, IMAGE_BYTE, message) &&
           painter_draw_at(painter, &lab_scene, &geometry, view, &image, message);
    if (done &&
        compare_exact(&image, &exact, budget ? &mask : NULL).maximum > tolerance_of(pictures->lab))
        *right = false;
    image_close(&image);
    reference_close(&exact);
    reference_close(&mask);
    lab_scene_close(&lab_scene);
    return done;
}

bool lab_pictures_check_sizes(const LabPictures *pictures, uint64_t seed, const Painter *painter,
                              Canvas *canvas, bool *right, Message *message)
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
    return (!pictures->lab->budget ||
            check_place(pictures, painter, canvas, (Place){COUNTED, COUNTED, 0, 0}, right,
                        message)) &&
           check_place(pictures, painter, canvas, place, right, message);
}

void lab_pictures_close(LabPictures *pictures)
{
    if (!pictures)
        return;
    for (int i = 0; i < LAB_PICTURES_MAX; i++) {
        LabPicture *picture = &pictures->items[i];
        lab_scene_close(&picture->lab_scene);
        image_close(&picture->image);
        reference_close(&picture->mask);
        for (int k = 0; k < LAB_PICTURE_MAX_TRUTHS; k++)
            reference_close(&picture->truths[k]);
    }
    mesh_close(&pictures->mesh);
    *pictures = (LabPictures){.count = 0};
}
