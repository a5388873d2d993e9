/*
 * The candidates are too many to draw all: for each object some twenty meshes, two interpolations,
 * and a bit for each simplification. Four observations make it a few dozen pictures:
 *
 * 1. Every picture tries one candidate for each object at once, because the pixels of one object
 *    hardly depend on another's.
 * 2. Finer meshes are more exact, but for little: for each interpolation the coarsest one that
 *    suffices is found by bisection, in five pictures. One that costs more than what is known to
 *    suffice is not drawn at all.
 * 3. Simplifications of light add up: from the cheapest found so far they are tried one after
 *    another, and each that keeps the error stays.
 * 4. Together the objects' choices are drawn once more. If that fails after all, the objects that
 *    are off are refined step by step.
 *
 * It is right because whatever is chosen was drawn as it is shown, and compared with the exact
 * picture; the observations decide only how cheap it is. A candidate's cost is expected from
 * counts, so drawing each once is enough, and the same is chosen every time.
 *
 * Where no candidate keeps the error, the search runs again for the smallest error that it has
 * seen. Between the moments of an animation the error is not looked at, but a part of it is kept in
 * reserve, by what every second moment would have missed.
 */
#include "choose/cheapest_search.h"

#include "base/memory.h"
#include "reference/picture_error.h"
#include "reference/reference_trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Exact colors are kept in 16 bits, 0.002 steps at most from the exact ones; evaluators round. */
static const double RESERVE = 0.015;

/* A setting other than the plain one must be expected to save a tenth of a frame, which costs FRAME
 * nanoseconds besides its objects. */
static const double WORTH = 0.9, FRAME = 50e3;

/* Where the plain setting is more exact, another must be expected to take no more than this share
 * of its time: expectations and times differ. */
static const double WORTH_ERROR = 0.7;

/* So many of the pixels inside objects may have the edge of a shadow pass over them, in addition to
 * those of the plain picture. */
static const double MOVED = 0.01;

/* What is known of an object. */
typedef struct Found {
    double fragments; /* at the first moment */
    double error;     /* of what was drawn last, over all moments */
    bool has_kept;
    ObjectQuality kept, best; /* the cheapest within the error; the most exact */
    double kept_cost, best_error, best_cost;
} Found;

typedef struct Search {
    const CheapestQualityTask *task;
    Scene scene;   /* at the first moment */
    Exact *exacts; /* by moment */
    Image image;
    LightingPlan plan; /* of a candidate, to know its cost */
    int count;         /* of objects */
    double allowed;
    ObjectQuality *current; /* what is drawn, by object */
    Found *found;           /* by object */
    /* Pixels that are off by more than is allowed because other lights reach them, and that is fine
     * for so many. */
    size_t moved, most_moved;
    double every_second[2]; /* the largest error of all objects at even and odd moments */
    double difference;      /* of these for the last choice */
    Progress progress;
    int drawn; /* candidates */
} Search;

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
    for (int y = 0; y < drawn->height; y++) {
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
}

/* Adds the errors of one moment's drawn picture to those of its objects. */
static void compare(Search *search, const Exact *exact, const Scene *scene, Drawn *drawn,
                    double *largest)
{
    for (int y = 0; y < drawn->height; y++) {
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

/* Draws `current` at all moments. The errors of objects that are nowhere inside stay 0. `left_out`:
 * NULL, or what does not count is added to it. */
static bool evaluate_with(Search *search, LeftOut *left_out, Message *message)
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

static bool evaluate(Search *search, Message *message)
{
    return evaluate_with(search, NULL, message);
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
    const LightingFrame frame = {.scene = &made.scene, .parts = made.parts, .aspect = 1};
    double cost = INFINITY;
    if (lighting_decide(&search->plan, search->task->lighting, &frame, NULL)) {
        const Effects effects = lighting_plan_effects(&search->plan, 0);
        cost = quality_parts_cost(&made, 0, &effects, search->found[object].fragments);
    }
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
        largest = fmax(largest, search->found[i].error);
    return largest;
}

/* The search. */

/* Takes note of `current`, as evaluated, for one object. */
static bool note(Search *search, int i)
{
    Found *found = &search->found[i];
    const bool passes = found->error <= search->allowed;
    const double cost = cost_of(search, i, &search->current[i]);
    if (passes && (!found->has_kept || cost < found->kept_cost)) {
        found->kept = search->current[i];
        found->kept_cost = cost;
        found->has_kept = true;
    }
    if (found->error < found->best_error - RESERVE ||
        (found->error < found->best_error + RESERVE && cost < found->best_cost)) {
        found->best = search->current[i];
        found->best_error = found->error;
        found->best_cost = cost;
    }
    return passes;
}

/* The best that is known. */
static void take_best(Search *search, int i)
{
    const Found *found = &search->found[i];
    search->current[i] = found->has_kept ? found->kept : found->best;
}

/* The levels of an object that are still to be tried, and whether one is drawn. */
typedef struct Range {
    int low, high;
    bool drawn;
} Range;

/* Takes the level in the middle for an object. False: there is none to be tried. */
static bool take_middle(Search *search, int i, ObjectQuality wanted, Range *range)
{
    const Found *found = &search->found[i];
    while (range->low < range->high) {
        const int middle = (range->low + range->high) / 2;
        wanted.divisions = CANDIDATE_LEVELS[middle];
        /* As fine a mesh may cost more than what is known to suffice. */
        if (!found->has_kept || cost_of(search, i, &wanted) < found->kept_cost) {
            search->current[i] = wanted;
            return true;
        }
        range->high = middle;
    }
    return false;
}

/* Finds the coarsest of the solids' own meshes that suffices, for as many objects at once. */
static bool bisect(Search *search, const ObjectQuality *wanted, Message *message)
{
    enum { MOST = 1 + EFFECTS_MAX_LIGHTS * 8 };
    Range ranges[MOST];
    const int count = search->count < MOST ? search->count : MOST;
    for (int i = 0; i < count; i++)
        ranges[i] =
            (Range){.high = candidate_level_count(search->task->kept, &search->scene.objects[i])};
    for (;;) {
        bool any = false;
        for (int i = 0; i < count; i++) {
            take_best(search, i);
            ranges[i].drawn = take_middle(search, i, *wanted, &ranges[i]);
            any |= ranges[i].drawn;
        }
        if (!any)
            return true;
        if (!evaluate(search, message))
            return false;
        for (int i = 0; i < count; i++) {
            const int middle = (ranges[i].low + ranges[i].high) / 2;
            if (ranges[i].drawn && note(search, i))
                ranges[i].high = middle;
            else if (ranges[i].drawn)
                ranges[i].low = middle + 1;
        }
    }
}

/* All objects with this interpolation: on their meshes as given, then on coarser ones. */
static bool try_interpolation(Search *search, ObjectQuality plain, Interpolation interpolation,
                              Message *message)
{
    plain.interpolation = interpolation;
    for (int i = 0; i < search->count; i++)
        search->current[i] = plain;
    if (!evaluate(search, message))
        return false;
    for (int i = 0; i < search->count; i++)
        note(search, i);
    return bisect(search, &plain, message);
}

static bool try_relaxing(Search *search, Message *message)
{
    const int count = candidate_relaxation_count(&search->scene);
    for (int which = 0; which < count; which++) {
        bool any = false;
        for (int i = 0; i < search->count; i++) {
            take_best(search, i);
            ObjectQuality wanted = search->current[i];
            /* What saves nothing is not simplified. */
            if (search->found[i].has_kept &&
                candidate_relax(search->task->kept, &search->scene, which, &wanted) &&
                cost_of(search, i, &wanted) < search->found[i].kept_cost) {
                search->current[i] = wanted;
                any = true;
            }
        }
        if (!any)
            continue;
        if (!evaluate(search, message))
            return false;
        for (int i = 0; i < search->count; i++)
            if (search->found[i].has_kept)
                note(search, i);
    }
    return true;
}

/* The found qualities together, in `current` with `errors`: objects in front of each other may
 * depend on each other after all. */
static bool join(Search *search, const ObjectQuality *plain, Message *message)
{
    for (int i = 0; i < search->count; i++)
        take_best(search, i);
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
            const bool fails = search->found[i].error > search->allowed || round % 3 == 2;
            if (search->found[i].has_kept && (moved || fails))
                any |= candidate_refine(search->task->kept, &search->scene.objects[i],
                                        !within && fails ? plain : NULL, &search->current[i]);
        }
        if (!any)
            return true;
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
    for (int i = 0; i < search->count; i++) {
        search->found[i].has_kept = false;
        search->found[i].best_error = search->found[i].best_cost = INFINITY;
    }
    for (int i = 0; i < search->count; i++)
        search->current[i] = plain;
    if (!evaluate(search, message))
        return false;
    cheapest->plain_error = largest_error(search);
    search->most_moved = search->moved + most_more(search);
    cheapest->plain_cost = cost_of_all(search, search->current);
    for (int i = 0; i < search->count; i++)
        note(search, i);
    const bool kept = candidate_is_kept(search->task->kept, AXIS_INTERPOLATION);
    const Interpolation all[] = {kept ? plain.interpolation : INTERPOLATION_PHONG,
                                 INTERPOLATION_GOURAUD};
    for (int i = 0; i < (kept ? 1 : 2); i++)
        if (!try_interpolation(search, plain, all[i], message))
            return false;
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

/* What the choice and the plain picture are off by where it does not count. */
static bool tell_left_out(Search *search, CheapestQuality *cheapest, Message *message)
{
    LeftOut *const both[] = {cheapest->left_out, cheapest->plain_left_out};
    for (int plain = 0; plain < 2; plain++) {
        for (int i = 0; i < search->count; i++)
            search->current[i] =
                plain ? object_quality_plain(&search->scene) : cheapest->objects[i];
        memset(both[plain], 0, sizeof cheapest->left_out);
        if (!evaluate_with(search, both[plain], message))
            return false;
    }
    cheapest->moments = search->task->moments;
    cheapest->inside = 0;
    for (int moment = 0; moment < cheapest->moments; moment++)
        cheapest->inside += (long long)search->exacts[moment].inside;
    return true;
}

static void search_close(Search *search)
{
    for (int i = 0; i < search->task->moments; i++)
        exact_close(&search->exacts[i]);
    free(search->exacts);
    free(search->current);
    free(search->found);
    lighting_plan_close(&search->plan);
    image_close(&search->image);
}

static bool search_open(Search *search, const CheapestQualityTask *task, int count,
                        Message *message)
{
    const Canvas *canvas = task->canvas;
    const int *place = task->place;
    *search = (Search){.task = task,
                       .count = count,
                       .progress = progress_start("exact picture"),
                       .exacts = memory_new((size_t)task->moments, sizeof(Exact)),
                       .current = memory_new((size_t)count, sizeof(ObjectQuality)),
                       .found = memory_new((size_t)count, sizeof(Found))};
    if (!image_open(&search->image, canvas->width, canvas->height,
                    canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, message))
        return false;
    for (int moment = 0; moment < task->moments; moment++) {
        Scene scene;
        Exact *exact = &search->exacts[moment];
        const bool opened = task->scene(task->data, moment, &scene, message) &&
                            exact_open(exact, &scene, &place[2], &search->progress, message);
        progress_end(&search->progress);
        if (!opened)
            return false;
        for (size_t i = 0; i < (size_t)place[2] * (size_t)place[3]; i++) {
            exact->inside += exact->owner[i] >= 0;
            if (moment == 0 && exact->seen[i] >= 0)
                search->found[exact->seen[i]].fragments++;
        }
    }
    return true;
}

bool cheapest_search(CheapestQuality *cheapest, const CheapestQualityTask *task, Message *message)
{
    Search search;
    bool done = search_open(&search, task, cheapest->count, message);
    search.progress = progress_start("candidates");
    done =
        done && search_all(&search, cheapest, message) && tell_left_out(&search, cheapest, message);
    progress_end(&search.progress);
    search_close(&search);
    return done;
}
