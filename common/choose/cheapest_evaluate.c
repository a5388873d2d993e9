#include "choose/cheapest_evaluate.h"

#include "reference/picture_error.h"
#include "reference/reference_trace.h"

#include <math.h>

/* What is drawn, by its meshes as they are: which lights reach it is asked only where the error is
 * large. */
typedef struct Drawn {
    Scene scene;
    int width, height;
    Trace *trace; /* NULL: nothing was asked */
} Drawn;

/* See pixel_has_its_lights. Where memory runs out it has: then the error counts. */
static bool has_its_lights(Drawn *drawn, const Exact *exact, int x, int y)
{
    Sample samples[3][3];
    const Sample *const rows[] = {samples[0], samples[1], samples[2]};
    const size_t pixel = (size_t)y * (size_t)drawn->width + (size_t)x;
    const ReferenceOptions meshes = {
        .width = drawn->width, .height = drawn->height, .meshes = true, .threads = 1};
    if (!exact->lights || !exact->lights[pixel] ||
        (!drawn->trace && !trace_open(&drawn->trace, &drawn->scene, &meshes, NULL)))
        return true;
    for (int row = 0; row < 3; row++)
        for (int i = 0; i < 3; i++)
            trace_sample(drawn->trace, x + i / 2.0, y + row / 2.0, &samples[row][i]);
    return samples[1][1].object != exact->owner[pixel] ||
           !reference_lights_differ(exact->lights[pixel], trace_pixel_lights(rows));
}

/* Of a pixel of the part that is compared; `i` and `pixel`: its number there and in the image. */
static double error_at(const Search *search, const Exact *exact, int x, int y, size_t *i,
                       size_t *pixel)
{
    const int *place = search->task->place;
    const Image *image = &search->image;
    float color[3];
    *i = (size_t)y * (size_t)place[2] + (size_t)x;
    *pixel = (size_t)(place[1] + y) * (size_t)image->width + (size_t)(place[0] + x);
    for (size_t k = 0; k < 3; k++)
        color[k] = (float)exact->colors[3 * *i + k] / 65535;
    return pixel_error(image, *pixel, color).largest;
}

/* Adds what one moment's drawn picture has of pixels that do not count. */
static void leave_out(const Search *search, const Exact *exact, const Scene *scene, Drawn *drawn,
                      LeftOut left_out[LEFT_OUT_COUNT])
{
    const Image *image = &search->image;
    for (int y = 0; y < drawn->height; y++)
        for (int x = 0; x < drawn->width; x++) {
            size_t i, pixel;
            const double error = error_at(search, exact, x, y, &i, &pixel);
            const int owner = exact->owner[i];
            const bool inside = pixel_is_interior(scene, owner, image, pixel);
            if (error <= search->task->error || (owner == -2 && pixel_is_empty(image, pixel)) ||
                (inside && has_its_lights(drawn, exact, x, y)))
                continue;
            LeftOut *where = &left_out[inside ? LEFT_OUT_SHADOWS : LEFT_OUT_OUTLINES];
            where->pixels++;
            where->largest = fmax(where->largest, error);
        }
}

/* Adds the errors of one moment's drawn picture to those of its objects. */
static void compare(Search *search, const Exact *exact, const Scene *scene, Drawn *drawn,
                    double *largest)
{
    for (int y = 0; y < drawn->height; y++)
        for (int x = 0; x < drawn->width; x++) {
            size_t i, pixel;
            const double error = error_at(search, exact, x, y, &i, &pixel);
            const int owner = exact->owner[i];
            if (!pixel_is_interior(scene, owner, &search->image, pixel))
                continue;
            if (error <= fmin(search->found[owner].error, *largest))
                continue;
            if (!has_its_lights(drawn, exact, x, y)) {
                search->moved += error > search->allowed;
                continue;
            }
            search->found[owner].error = fmax(search->found[owner].error, error);
            *largest = fmax(*largest, error);
        }
}

static bool draw_parts(const CheapestQualityTask *task, const Scene *scene,
                       const ObjectQuality *qualities, QualityParts *made, Message *message)
{
    const int *place = task->place;
    const double aspect = (double)place[2] / place[3];
    if (!quality_parts_open(made, scene, qualities, task->meshes, message))
        return false;
    canvas_clear(task->canvas, scene->background, 0);
    canvas_view(task->canvas, place[0], place[1], place[2], place[3]);
    return lighting_show(
        task->lighting,
        &(LightingFrame){
            .scene = &made->scene, .parts = made->parts, .aspect = aspect, .full = task->full},
        message);
}

/* Shares of two bisections, the relaxations and the end; the search may begin all that again. */
static void show_progress(Search *search)
{
    const int some = 20 + candidate_relaxation_count(&search->scene), done = search->drawn++;
    progress_update(&search->progress, done, (1 + done / some) * some);
}

bool search_evaluate(Search *search, LeftOut *left_out, Message *message)
{
    const CheapestQualityTask *task = search->task;
    for (int i = 0; i < search->count; i++)
        search->found[i].error = 0;
    search->every_second[0] = search->every_second[1] = 0;
    search->moved = 0;
    show_progress(search);
    for (int moment = 0; moment < task->moments; moment++) {
        Scene scene;
        QualityParts made;
        double largest = 0;
        if (!task->scene(task->data, moment, &scene, message))
            return false;
        const bool done = draw_parts(task, &scene, search->current, &made, message) &&
                          canvas_read(task->canvas, &search->image, message);
        Drawn drawn = {made.scene, task->place[2], task->place[3], NULL};
        drawn.scene.interpolation = INTERPOLATION_PHONG;
        if (done)
            compare(search, &search->exacts[moment], &scene, &drawn, &largest);
        if (done && left_out)
            leave_out(search, &search->exacts[moment], &scene, &drawn, left_out);
        trace_close(drawn.trace);
        quality_parts_close(&made);
        if (!done)
            return false;
        search->every_second[moment % 2] = fmax(search->every_second[moment % 2], largest);
    }
    return task->scene(task->data, 0, &search->scene, message);
}

double search_cost(Search *search, int object, const ObjectQuality *quality)
{
    QualityParts made;
    Scene alone = search->scene;
    alone.objects += object;
    alone.object_count = 1;
    if (!quality_parts_open(&made, &alone, quality, search->task->meshes, NULL))
        return INFINITY;
    const LightingFrame frame = {.scene = &made.scene, .parts = made.parts, .aspect = 1};
    double cost = INFINITY;
    if (lighting_decide(&search->plan, search->task->lighting, &frame, NULL)) {
        const Effects effects = lighting_plan_effects(&search->plan, 0);
        cost = quality_parts_cost(&made, 0, &effects, search->found[object].fragments);
    }
    quality_parts_close(&made);
    return cost;
}
