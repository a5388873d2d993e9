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
#include "choose/cheapest_evaluate.h"

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

static double cost_of_all(Search *search, const ObjectQuality *qualities)
{
    double sum = 0;
    for (int i = 0; i < search->count; i++)
        sum += search_cost(search, i, &qualities[i]);
    return sum;
}

static double largest_error(const Search *search)
{
    double largest = 0;
    for (int i = 0; i < search->count; i++)
        largest = fmax(largest, search->found[i].error);
    return largest;
}

/* Takes note of `current`, as evaluated, for one object. */
static bool note(Search *search, int i)
{
    Found *found = &search->found[i];
    const bool passes = found->error <= search->allowed;
    const double cost = search_cost(search, i, &search->current[i]);
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
        if (!found->has_kept || search_cost(search, i, &wanted) < found->kept_cost) {
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
        if (!search_evaluate(search, NULL, message))
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
    if (!search_evaluate(search, NULL, message))
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
                search_cost(search, i, &wanted) < search->found[i].kept_cost) {
                search->current[i] = wanted;
                any = true;
            }
        }
        if (!any)
            continue;
        if (!search_evaluate(search, NULL, message))
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
        if (!search_evaluate(search, NULL, message))
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
    if (!search_evaluate(search, NULL, message))
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
        if (task->moving && !search_evaluate(search, NULL, message))
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
        if (!search_evaluate(search, both[plain], message))
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
