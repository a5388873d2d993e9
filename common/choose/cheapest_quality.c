#include "choose/cheapest_quality.h"

#include "base/cache.h"
#include "reference/picture_error.h"
#include "reference/reference.h"
#include "reference/reference_trace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of a turn, or a side. */
static const int LEVELS[] = {4,  6,  8,  10, 12, 14,  16,  20,  24,  28,  32,  40,
                             48, 56, 64, 80, 96, 112, 128, 160, 192, 256, 384, 512};
enum { LEVEL_COUNT = sizeof LEVELS / sizeof LEVELS[0] };

/* Exact colors are kept in 16 bits, 0.002 steps at most from the exact ones; evaluators round. */
static const double RESERVE = 0.015;

/* Another setting than the plain one must be expected to save a tenth of a frame; of that so many
 * nanoseconds are no object's. */
static const double WORTH = 0.9, FRAME = 50e3;

/* Where the plain one is more exact, it must be expected to take so much of that one's time at
 * most: expectations and times differ. */
static const double WORTH_ERROR = 0.7;

/* So many of the pixels inside objects may have the edge of a shadow pass over them, in addition to
 * those of the plain picture. */
static const double MOVED = 0.01;

/* The exact picture at one moment: as much as the error needs. */
typedef struct Exact {
    uint16_t *colors; /* 65535 is 1 */
    int16_t *owner;   /* the object whose inside the pixel is; -1: none */
    int16_t *seen;    /* the object at its center; -1: none */
    uint32_t *lights; /* see Reference; NULL: no light casts shadows */
    size_t inside;    /* pixels with an owner */
} Exact;

typedef struct Search {
    const CheapestQualityTask *task;
    Scene scene;   /* at the first moment */
    Exact *exacts; /* by moment */
    Image image;
    int count; /* of objects */
    double allowed;
    double *fragments;      /* by object, of the first moment with the most */
    ObjectQuality *current; /* what is drawn */
    double *errors;         /* its errors by object, over all moments */
    /* Pixels that are off by more than is allowed because other lights reach them, and that is fine
     * for so many. */
    size_t moved, most_moved;
    double *every_second; /* the largest of all objects at even and odd moments */
    double difference;    /* of these for the last choice */
    /* By object: the cheapest within the error so far; the most exact so far. */
    ObjectQuality *kept, *best;
    double *kept_cost, *best_error, *best_cost;
    bool *has_kept;
} Search;

/* Keys. Pointers are not content; padding may differ, which is a miss. */

static void add_scene(CacheKey *key, const Scene *scene, bool meshes)
{
    Scene plain = *scene;
    plain.lights = NULL;
    plain.objects = NULL;
    cache_key_add(key, &plain, sizeof plain);
    cache_key_add(key, scene->lights, (size_t)scene->light_count * sizeof *scene->lights);
    for (int i = 0; i < scene->object_count; i++) {
        Object object = scene->objects[i];
        const Mesh *mesh = object.mesh;
        object.mesh = NULL;
        cache_key_add(key, &object, sizeof object);
        const bool seen = i > 0 && scene->objects[i - 1].mesh == mesh;
        if ((meshes || object.solid.kind == SOLID_NONE) && !seen)
            scene_key_mesh(key, mesh);
    }
}

/* Exact pictures. */

static void exact_close(Exact *exact)
{
    free(exact->colors);
    *exact = (Exact){.colors = NULL};
}

/* One block of colors, owners, objects and lights. */
static bool exact_open(Exact *exact, uint16_t *block, size_t pixels, bool casts, Message *message)
{
    if (!block)
        return message_set(message, "cheapest: not enough memory for the exact picture");
    *exact =
        (Exact){.colors = block,
                .owner = (int16_t *)(block + 3 * pixels),
                .seen = (int16_t *)(block + 4 * pixels),
                .lights = casts ? (uint32_t *)(void *)(block + 5 * pixels + pixels % 2) : NULL};
    return true;
}

static void exact_fill(Exact *exact, const Reference *reference, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++) {
        for (size_t k = 0; k < 3; k++)
            exact->colors[3 * i + k] =
                (uint16_t)lround(65535 * (double)reference->color[3 * i + k]);
        exact->seen[i] = (int16_t)reference->object[i];
        exact->owner[i] = reference->interior[i] ? exact->seen[i] : -1;
    }
    if (exact->lights)
        memcpy(exact->lights, reference->lights, pixels * sizeof *exact->lights);
}

static bool exact_make(Exact *exact, const Scene *scene, int width, int height, Message *message)
{
    const bool casts = scene_has_shadows(scene);
    const size_t pixels = (size_t)width * (size_t)height;
    const size_t size = ((casts ? 7 : 5) * pixels + (casts ? pixels % 2 : 0)) * sizeof(uint16_t);
    const int area[2] = {width, height};
    CacheKey key = {{0, 0}};
    size_t have = 0;
    cache_key_add_program(&key);
    cache_key_add(&key, area, sizeof area);
    add_scene(&key, scene, false);
    uint16_t *block = cache_read("exact", &key, &have);
    if (block && have == size)
        return exact_open(exact, block, pixels, casts, message);
    free(block);
    Reference reference;
    const ReferenceOptions options = {.width = width, .height = height};
    if (!exact_open(exact, calloc(1, size), pixels, casts, message))
        return false;
    if (!reference_open(&reference, scene, &options, message)) {
        exact_close(exact);
        return false;
    }
    exact_fill(exact, &reference, pixels);
    reference_close(&reference);
    cache_write("exact", &key, exact->colors, size);
    return true;
}

/* Drawing and comparing. */

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

/* Adds the errors of one moment's drawn picture to those of its objects. */
static void compare(Search *search, const Exact *exact, const Scene *scene, Drawn *drawn,
                    double *largest)
{
    const int *place = search->task->place;
    const Image *image = &search->image;
    for (int y = 0; y < place[3]; y++) {
        for (int x = 0; x < place[2]; x++) {
            const size_t i = (size_t)y * (size_t)place[2] + (size_t)x;
            const size_t pixel =
                (size_t)(place[1] + y) * (size_t)image->width + (size_t)(place[0] + x);
            const int owner = exact->owner[i];
            if (!pixel_is_interior(scene, owner, image, pixel))
                continue;
            float color[3];
            for (size_t k = 0; k < 3; k++)
                color[k] = (float)exact->colors[3 * i + k] / 65535;
            const double error = pixel_error(image, pixel, color).largest;
            if (error <= fmin(search->errors[owner], *largest))
                continue;
            if (!has_its_lights(drawn, exact, x, y)) {
                search->moved += error > search->allowed;
                continue;
            }
            search->errors[owner] = fmax(search->errors[owner], error);
            *largest = fmax(*largest, error);
        }
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
    return lighting_draw_parts(task->lighting, &made->scene, made->parts, aspect, task->full,
                               message);
}

/* Draws `current` at all moments. The errors of objects that are nowhere inside stay 0. */
static bool evaluate(Search *search, Message *message)
{
    const CheapestQualityTask *task = search->task;
    memset(search->errors, 0, (size_t)search->count * sizeof *search->errors);
    search->every_second[0] = search->every_second[1] = 0;
    search->moved = 0;
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
        trace_close(drawn.trace);
        quality_parts_close(&made);
        if (!done)
            return false;
        search->every_second[moment % 2] = fmax(search->every_second[moment % 2], largest);
    }
    return task->scene(task->data, 0, &search->scene, message);
}

/* The expected cost of one object, or of all. */
static double cost_of(Search *search, int object, const ObjectQuality *quality)
{
    QualityParts made;
    Scene alone = search->scene;
    alone.objects += object;
    alone.object_count = 1;
    if (!quality_parts_open(&made, &alone, quality, search->task->meshes, NULL))
        return INFINITY;
    const double cost = quality_parts_cost(&made, 0, search->fragments[object]);
    quality_parts_close(&made);
    return cost;
}

static double cost_of_all(Search *search, const ObjectQuality *qualities)
{
    double sum = 0;
    for (int i = 0; i < search->count; i++)
        sum += cost_of(search, i, &qualities[i]);
    return sum;
}

static double largest_error(const Search *search)
{
    double largest = 0;
    for (int i = 0; i < search->count; i++)
        largest = fmax(largest, search->errors[i]);
    return largest;
}

/* The search. */

/* Takes note of `current`, as evaluated, for one object. */
static bool note(Search *search, int i)
{
    const bool passes = search->errors[i] <= search->allowed;
    const double cost = cost_of(search, i, &search->current[i]);
    if (passes && (!search->has_kept[i] || cost < search->kept_cost[i])) {
        search->kept[i] = search->current[i];
        search->kept_cost[i] = cost;
        search->has_kept[i] = true;
    }
    if (search->errors[i] < search->best_error[i] - RESERVE ||
        (search->errors[i] < search->best_error[i] + RESERVE && cost < search->best_cost[i])) {
        search->best[i] = search->current[i];
        search->best_error[i] = search->errors[i];
        search->best_cost[i] = cost;
    }
    return passes;
}

static bool is_kept(const Search *search, QualityAxis axis)
{
    return (search->task->kept >> axis) & 1;
}

/* How many of LEVELS can be drawn of it. A teapot, of four patches around, is not closer to the
 * exact picture's where it is finer. */
static int level_count(const Search *search, const Object *object)
{
    enum { FINEST = 4 * REFERENCE_TEAPOT_DIVISIONS };
    int count = 0;
    if (!object->solid.kind || object->mesh->colors || object->mesh->lit_positions ||
        is_kept(search, AXIS_DIVISIONS))
        return 0;
    while (count < LEVEL_COUNT && (object->solid.kind != SOLID_TEAPOT || LEVELS[count] <= FINEST))
        count++;
    return count;
}

/* All objects with this interpolation, first on their meshes as given, then on the coarsest of the
 * solids' own that suffices, by bisection. */
static bool try_interpolation(Search *search, const ObjectQuality *plain,
                              Interpolation interpolation, Message *message)
{
    int low[1 + EFFECTS_MAX_LIGHTS * 8], high[1 + EFFECTS_MAX_LIGHTS * 8];
    const int count = search->count < (int)(sizeof low / sizeof low[0])
                          ? search->count
                          : (int)(sizeof low / sizeof low[0]);
    for (int i = 0; i < search->count; i++) {
        search->current[i] = *plain;
        search->current[i].interpolation = interpolation;
    }
    if (!evaluate(search, message))
        return false;
    for (int i = 0; i < search->count; i++)
        note(search, i);
    for (int i = 0; i < count; i++) {
        low[i] = 0;
        high[i] = level_count(search, &search->scene.objects[i]);
    }
    for (;;) {
        bool any = false, drawn[sizeof low / sizeof low[0]] = {false};
        for (int i = 0; i < count; i++) {
            ObjectQuality *quality = &search->current[i];
            *quality = search->has_kept[i] ? search->kept[i] : search->best[i];
            while (low[i] < high[i] && !drawn[i]) {
                ObjectQuality wanted = *plain;
                wanted.interpolation = interpolation;
                wanted.divisions = LEVELS[(low[i] + high[i]) / 2];
                /* As fine a mesh may cost more than what is known to suffice. */
                if (search->has_kept[i] && cost_of(search, i, &wanted) >= search->kept_cost[i]) {
                    high[i] = (low[i] + high[i]) / 2;
                    continue;
                }
                *quality = wanted;
                any = drawn[i] = true;
            }
        }
        if (!any)
            return true;
        if (!evaluate(search, message))
            return false;
        for (int i = 0; i < count; i++) {
            const int middle = (low[i] + high[i]) / 2;
            if (drawn[i] && note(search, i))
                high[i] = middle;
            else if (drawn[i])
                low[i] = middle + 1;
        }
    }
}

/* Simplifications on top of the mesh and the interpolation: the viewer, the normals, and three of
 * each light. False: there is no such one for this object. */
enum { RELAX_VIEWER, RELAX_NORMALS, RELAX_LIGHTS };
static bool relax(const Search *search, int which, ObjectQuality *quality)
{
    const ObjectQuality before = *quality;
    if (which == RELAX_VIEWER) {
        quality->distant_viewer |= !is_kept(search, AXIS_VIEWER);
    } else if (which == RELAX_NORMALS) {
        quality->skip_renormalization |= !is_kept(search, AXIS_NORMALS);
    } else if (!is_kept(search, AXIS_LIGHTS)) {
        const int number = (which - RELAX_LIGHTS) / 3;
        const uint32_t bit = (uint32_t)1 << number;
        const Light *light = &search->scene.lights[number];
        if (light->off || quality->dark_lights & bit)
            return false;
        if ((which - RELAX_LIGHTS) % 3 == 0)
            quality->dark_lights |= bit;
        else if ((which - RELAX_LIGHTS) % 3 == 1 && !color_is_black(light->specular))
            quality->matte_lights |= bit;
        else if ((which - RELAX_LIGHTS) % 3 == 2 && light->kind == LIGHT_POINT)
            quality->far_lights |= bit;
    }
    return !object_quality_equal(&before, quality);
}

static bool try_relaxing(Search *search, Message *message)
{
    const int lights = search->scene.light_count < EFFECTS_MAX_LIGHTS ? search->scene.light_count
                                                                      : EFFECTS_MAX_LIGHTS;
    for (int which = 0; which < RELAX_LIGHTS + 3 * lights; which++) {
        bool any = false;
        for (int i = 0; i < search->count; i++) {
            search->current[i] = search->has_kept[i] ? search->kept[i] : search->best[i];
            ObjectQuality wanted = search->current[i];
            /* What saves nothing is not left away. */
            if (search->has_kept[i] && relax(search, which, &wanted) &&
                cost_of(search, i, &wanted) < search->kept_cost[i]) {
                search->current[i] = wanted;
                any = true;
            }
        }
        if (!any)
            continue;
        if (!evaluate(search, message))
            return false;
        for (int i = 0; i < search->count; i++)
            if (search->has_kept[i])
                note(search, i);
    }
    return true;
}

/* The next finer level, `plainly`: without simplifications; false: there is none. */
static bool refine(const Search *search, const Object *object, const ObjectQuality *plain,
                   bool plainly, ObjectQuality *quality)
{
    const ObjectQuality before = *quality;
    if (plainly) {
        quality->distant_viewer = plain->distant_viewer;
        quality->skip_renormalization = plain->skip_renormalization;
        quality->far_lights = quality->matte_lights = quality->dark_lights = 0;
    }
    for (int i = 0; i < level_count(search, object); i++) {
        if (LEVELS[i] > quality->divisions) {
            /* Of the mesh as given the fineness is not known. */
            quality->divisions = quality->divisions ? LEVELS[i] : 32;
            break;
        }
    }
    return !object_quality_equal(&before, quality);
}

/* The found qualities together, in `current` with `errors`: objects in front of each other may
 * depend on each other after all. */
static bool join(Search *search, const ObjectQuality *plain, Message *message)
{
    for (int i = 0; i < search->count; i++)
        search->current[i] = search->has_kept[i] ? search->kept[i] : search->best[i];
    for (int round = 0;; round++) {
        bool any = false;
        if (!evaluate(search, message))
            return false;
        const bool within = largest_error(search) <= search->allowed;
        const bool moved = search->moved > search->most_moved;
        if ((within && !moved) || round == 16)
            return true;
        for (int i = 0; i < search->count; i++) {
            /* At first those that fail, then their neighbors too. Whose shadow has moved is not
             * known. */
            const bool fails = search->errors[i] > search->allowed || round % 3 == 2;
            if (search->has_kept[i] && (moved || fails))
                any |= refine(search, &search->scene.objects[i], plain, !within && fails,
                              &search->current[i]);
        }
        if (!any)
            return true;
    }
}

static void forget(Search *search)
{
    for (int i = 0; i < search->count; i++) {
        search->has_kept[i] = false;
        search->best_error[i] = search->best_cost[i] = INFINITY;
    }
}

static size_t most_more(const Search *search)
{
    double inside = 0;
    for (int moment = 0; moment < search->task->moments; moment++)
        inside += (double)search->exacts[moment].inside;
    return (size_t)(MOVED * inside);
}

/* One search, its result in `cheapest`. */
static bool search_once(Search *search, CheapestQuality *cheapest, Message *message)
{
    const CheapestQualityTask *task = search->task;
    if (!task->scene(task->data, 0, &search->scene, message))
        return false;
    const ObjectQuality plain = object_quality_plain(&search->scene);
    forget(search);
    for (int i = 0; i < search->count; i++)
        search->current[i] = plain;
    if (!evaluate(search, message))
        return false;
    cheapest->plain_error = largest_error(search);
    search->most_moved = search->moved + most_more(search);
    cheapest->plain_cost = cost_of_all(search, search->current);
    for (int i = 0; i < search->count; i++)
        note(search, i);
    static const Interpolation all[] = {INTERPOLATION_PHONG, INTERPOLATION_GOURAUD};
    if (is_kept(search, AXIS_INTERPOLATION)) {
        if (!try_interpolation(search, &plain, plain.interpolation, message))
            return false;
    } else {
        for (int i = 0; i < 2; i++)
            if (!try_interpolation(search, &plain, all[i], message))
                return false;
    }
    if (!try_relaxing(search, message) || !join(search, &plain, message))
        return false;
    memcpy(cheapest->objects, search->current, (size_t)search->count * sizeof *search->current);
    cheapest->error = largest_error(search);
    cheapest->cost = cost_of_all(search, search->current);
    const bool plain_suffices =
        cheapest->plain_error <= search->allowed || cheapest->plain_error <= cheapest->error;
    const bool less_exact = cheapest->error > cheapest->plain_error + RESERVE;
    if (plain_suffices && (cheapest->cost + FRAME > WORTH * (cheapest->plain_cost + FRAME) ||
                           (less_exact && cheapest->cost > WORTH_ERROR * cheapest->plain_cost))) {
        for (int i = 0; i < search->count; i++)
            cheapest->objects[i] = search->current[i] = plain;
        cheapest->error = cheapest->plain_error;
        cheapest->cost = cheapest->plain_cost;
        if (task->moving && !evaluate(search, message))
            return false;
    }
    search->difference = fabs(search->every_second[0] - search->every_second[1]);
    return true;
}

/* What is allowed at the moments, so that it holds between them: random animations of 51 pictures
 * exceeded the error at 17 of them by up to 30%, one of them; more where every second moment
 * already shows less than the others. */
static double allowed_at_moments(const CheapestQualityTask *task, double difference)
{
    static const double BETWEEN = 0.33;
    if (!task->moving)
        return task->error - fmin(RESERVE, task->error / 2);
    return task->error - fmin(fmax(BETWEEN * task->error, 2 * difference), task->error / 2);
}

static bool search_all(Search *search, CheapestQuality *cheapest, Message *message)
{
    const CheapestQualityTask *task = search->task;
    search->allowed = allowed_at_moments(task, 0);
    if (!search_once(search, cheapest, message))
        return false;
    const double again = allowed_at_moments(task, search->difference);
    if (cheapest->error <= search->allowed && again < search->allowed) {
        search->allowed = again;
        if (!search_once(search, cheapest, message))
            return false;
    }
    cheapest->margin = task->moving ? task->error - search->allowed : 0;
    /* Out of reach: the cheapest that is as exact as possible. */
    if (cheapest->error > search->allowed) {
        search->allowed = fmax(cheapest->error + RESERVE, search->allowed);
        return search_once(search, cheapest, message);
    }
    return true;
}

static void search_close(Search *search)
{
    for (int i = 0; search->exacts && i < search->task->moments; i++)
        exact_close(&search->exacts[i]);
    free(search->exacts);
    free(search->fragments);
    free(search->current);
    free(search->errors);
    free(search->every_second);
    free(search->kept);
    free(search->best);
    free(search->kept_cost);
    free(search->best_error);
    free(search->best_cost);
    free(search->has_kept);
    image_close(&search->image);
    *search = (Search){.task = NULL};
}

static bool search_open(Search *search, const CheapestQualityTask *task, int count,
                        Message *message)
{
    const size_t objects = (size_t)count + 1;
    const Canvas *canvas = task->canvas;
    *search = (Search){.task = task,
                       .count = count,
                       .exacts = calloc((size_t)task->moments, sizeof(Exact)),
                       .fragments = calloc(objects, sizeof(double)),
                       .current = calloc(objects, sizeof(ObjectQuality)),
                       .errors = calloc(objects, sizeof(double)),
                       .every_second = calloc(2, sizeof(double)),
                       .kept = calloc(objects, sizeof(ObjectQuality)),
                       .best = calloc(objects, sizeof(ObjectQuality)),
                       .kept_cost = calloc(objects, sizeof(double)),
                       .best_error = calloc(objects, sizeof(double)),
                       .best_cost = calloc(objects, sizeof(double)),
                       .has_kept = calloc(objects, sizeof(bool))};
    if (!search->exacts || !search->fragments || !search->current || !search->errors ||
        !search->every_second || !search->kept || !search->best || !search->kept_cost ||
        !search->best_error || !search->best_cost || !search->has_kept)
        return message_set(message, "cheapest: not enough memory");
    if (!image_open(&search->image, canvas->width, canvas->height,
                    canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, message))
        return false;
    for (int moment = 0; moment < task->moments; moment++) {
        Scene scene;
        Exact *exact = &search->exacts[moment];
        if (!task->scene(task->data, moment, &scene, message) ||
            !exact_make(exact, &scene, task->place[2], task->place[3], message))
            return false;
        for (size_t i = 0; i < (size_t)task->place[2] * (size_t)task->place[3]; i++) {
            exact->inside += exact->owner[i] >= 0;
            if (moment == 0 && exact->seen[i] >= 0)
                search->fragments[exact->seen[i]]++;
        }
    }
    return true;
}

/* The choice in the cache. */

static bool choice_key(CacheKey *key, const CheapestQualityTask *task, Message *message)
{
    const Canvas *canvas = task->canvas;
    const double numbers[] = {task->error,    task->kept,      task->full,   task->moments,
                              task->moving,   canvas->samples, canvas->real, canvas->supersample,
                              task->place[2], task->place[3]};
    const ShadowSettings shadows = lighting_shadows(task->lighting);
    const double ways[] = {shadows.way,    shadows.map_size, shadows.smooth,
                           shadows.bias.x, shadows.bias.y,   shadows.bias.z};
    *key = (CacheKey){{1, 0}};
    cache_key_add_program(key);
    cache_key_add(key, ways, sizeof ways);
    cache_key_add(key, numbers, sizeof numbers);
    cache_key_add(key, canvas->renderer, strlen(canvas->renderer));
    cache_key_add(key, canvas->version, strlen(canvas->version));
    for (int moment = 0; moment < task->moments; moment++) {
        Scene scene;
        if (!task->scene(task->data, moment, &scene, message))
            return false;
        add_scene(key, &scene, true);
        /* The shaders may have been edited. */
        for (int full = 0; full < 2 && moment == 0 && scene.object_count; full++) {
            ShaderSource sources[2];
            if (!lighting_find_maps(task->lighting, &scene, full, message) ||
                !lighting_sources(task->lighting, &scene, &scene.objects[0], full, sources,
                                  message))
                return false;
            for (int stage = 0; stage < 2; stage++) {
                cache_key_add(key, sources[stage].text, strlen(sources[stage].text));
                shader_source_close(&sources[stage]);
            }
        }
    }
    return true;
}

static bool read_choice(CheapestQuality *cheapest, const CacheKey *key, int count)
{
    const size_t objects = (size_t)count * sizeof *cheapest->objects;
    size_t size = 0;
    char *bytes = cache_read("choice", key, &size);
    const bool found = bytes && size == sizeof *cheapest + objects;
    if (found) {
        ObjectQuality *own = cheapest->objects;
        memcpy(cheapest, bytes, sizeof *cheapest);
        cheapest->objects = own;
        cheapest->cached = true;
        memcpy(own, bytes + sizeof *cheapest, objects);
    }
    free(bytes);
    return found && cheapest->count == count;
}

static void write_choice(const CheapestQuality *cheapest, const CacheKey *key)
{
    const size_t objects = (size_t)cheapest->count * sizeof *cheapest->objects;
    char *bytes = malloc(sizeof *cheapest + objects);
    CheapestQuality plain = *cheapest;
    plain.objects = NULL;
    if (!bytes)
        return;
    memcpy(bytes, &plain, sizeof plain);
    memcpy(bytes + sizeof plain, cheapest->objects, objects);
    cache_write("choice", key, bytes, sizeof plain + objects);
    free(bytes);
}

bool cheapest_quality_find(CheapestQuality *cheapest, const CheapestQualityTask *task,
                           Message *message)
{
    Scene scene;
    CacheKey key;
    *cheapest = (CheapestQuality){.count = 0};
    if (!choice_key(&key, task, message) || !task->scene(task->data, 0, &scene, message))
        return false;
    const int count = scene.object_count;
    if (count > INT16_MAX)
        return message_set(message, "cheapest: %d objects: at most %d", count, INT16_MAX);
    *cheapest = (CheapestQuality){.objects = calloc((size_t)count + 1, sizeof *cheapest->objects),
                                  .count = count};
    if (!cheapest->objects)
        return message_set(message, "cheapest: not enough memory");
    if (count == 0 || read_choice(cheapest, &key, count))
        return true;
    cheapest->count = count;
    cheapest->cached = false;
    Search search;
    const bool done =
        search_open(&search, task, count, message) && search_all(&search, cheapest, message);
    search_close(&search);
    canvas_begin(task->canvas);
    if (done)
        write_choice(cheapest, &key);
    else
        cheapest_quality_close(cheapest);
    return done;
}

void cheapest_quality_close(CheapestQuality *cheapest)
{
    if (!cheapest)
        return;
    free(cheapest->objects);
    *cheapest = (CheapestQuality){.objects = NULL};
}

static int bits_of(uint32_t bits)
{
    return __builtin_popcount(bits);
}

void cheapest_quality_text(const CheapestQuality *cheapest, const Scene *scene, char *text,
                           size_t size)
{
    const ObjectQuality plain = object_quality_plain(scene);
    FILE *file = fmemopen(text, size, "w");
    int written = 0;
    if (!file)
        return;
    for (int i = 0; i < cheapest->count; i++) {
        const ObjectQuality *quality = &cheapest->objects[i];
        const char *before = "";
        if (object_quality_equal(quality, &plain))
            continue;
        fprintf(file, "%sobject %d: ", written++ ? "; " : "", i);
        if (quality->divisions) {
            fprintf(file, "%d divisions", quality->divisions);
            before = ", ";
        }
        const struct {
            bool there;
            const char *what;
            int count;
        } all[] = {
            {quality->interpolation != plain.interpolation,
             quality->interpolation == INTERPOLATION_PHONG ? "lit per fragment" : "lit per vertex",
             0},
            {quality->distant_viewer && !plain.distant_viewer, "viewer at infinity", 0},
            {quality->skip_renormalization && !plain.skip_renormalization,
             "normals as interpolated", 0},
            {quality->far_lights != 0, "at infinity", bits_of(quality->far_lights)},
            {quality->matte_lights != 0, "without highlight", bits_of(quality->matte_lights)},
            {quality->dark_lights != 0, "off", bits_of(quality->dark_lights)},
        };
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
            if (!all[k].there)
                continue;
            if (all[k].count)
                fprintf(file, "%s%d of %d lights %s", before, all[k].count, scene->light_count,
                        all[k].what);
            else
                fprintf(file, "%s%s", before, all[k].what);
            before = ", ";
        }
    }
    if (!written)
        fprintf(file, "as the scene says");
    fclose(file);
    text[size - 1] = '\0';
}
