/* Of a right program all mutants are run at the same points as the submission, those first where
 * the submission is farthest from right, so that nearly all are ruled out by one or two points.
 * What is left computes the same numbers at hundreds of points. If several do, that one is named
 * which has most of the submission's values on its way: a light whose direction is reversed draws
 * what a reversed normal draws, but only one of the two is among the submission's values. */
#include "labs/diagnosis/derive.h"

#include "base/memory.h"
#include "core/shader_source.h"
#include "labs/diagnosis/derivation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Equal formulas differ by 1e-12, with attributes in floats by 1e-7, with constants like 3.14159 by
 * more. A highlight that nearly vanishes is 1e-4 from one that does. */
static const double UNIQUE = 0.9, ONE_OF_SEVERAL = 0.75;
static const double EQUAL = 5e-5, ALIKE = 1e-6;

/* Constants of a shader that may be a mistake's numbers: they and their reciprocals. */
static void take_number(Derivation *all, double number)
{
    number = fabs(number);
    for (int i = 0; i < all->number_count; i++)
        if (fabs(all->numbers[i] - number) <= 1e-9 * number)
            return;
    if (number > 1e-6 && number < 1e6 && all->number_count < MUTATION_NUMBERS)
        all->numbers[all->number_count++] = number;
}

static void take_numbers(Derivation *all, const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    if (at->constant && at->type == GLSL_FLOAT)
        take_number(all, tree->values[at->value]);
    for (int i = at->first; i; i = tree->nodes[i].next)
        take_numbers(all, tree, i);
}

static void take_all_numbers(Derivation *all)
{
    for (int i = 0; i < 2; i++)
        take_numbers(all, all->own[i].tree, all->own[i].tree->root);
    const int count = all->own_number_count = all->number_count;
    for (int i = 0; i < count; i++)
        take_number(all, 1 / all->numbers[i]);
    for (int i = 0; i < count; i++)
        take_number(all, 1 + all->numbers[i]), take_number(all, 1 - all->numbers[i]);
}

typedef struct Apart {
    double apart;
    int point;
} Apart;

static int farthest_first(const void *a, const void *b)
{
    const Apart *p = a, *q = b;
    return p->apart != q->apart ? (p->apart < q->apart) - (p->apart > q->apart)
                                : p->point - q->point;
}

/* The worst first; then some where it is wrong, in steps that leave none out, and some where it is
 * right, in turn. */
static void sort_points(Derivation *all)
{
    const int count = all->points.count;
    int wrong = 0, used = 0;
    Apart *list = memory_new((size_t)count, sizeof *list);
    for (int i = 0; i < count; i++) {
        list[i] = (Apart){points_apart(all->wanted[i], all->exact[i]), i};
        wrong += list[i].apart > 4 * EQUAL;
    }
    qsort(list, (size_t)count, sizeof *list, farthest_first);
    all->wrong_by = list[0].apart;
    for (int step = 0; used < count; step++) {
        const int stride = 1009; /* a prime above both counts: none is left over */
        if (step < wrong)
            all->order[used++] = list[step * stride % wrong].point;
        if (step < count - wrong)
            all->order[used++] = list[wrong + step * stride % (count - wrong)].point;
    }
    free(list);
}

enum { FIRST_POINTS = 16, MOST = 40000 /* mutants: some seconds */ };

/* How far the pair is from the submission, and how many of the first points are alike; far away:
 * it is not looked at further. */
static double distance(Derivation *all, PointShader *vertex, PointShader *fragment, int *like)
{
    double most = 0, numbers[POINT_NUMBERS];
    *like = 0;
    for (int i = 0; i < all->points.count && (most <= EQUAL || i < FIRST_POINTS); i++) {
        const int point = all->order[i];
        points_run(&all->points, vertex, fragment, point, numbers);
        const double apart = points_apart(numbers, all->wanted[point]);
        most = fmax(most, apart);
        *like += i < FIRST_POINTS && apart <= EQUAL;
        if ((i == FIRST_POINTS / 2 && *like == 0) || /* hopeless */
            (!all->noted && vertex->run->note_count + fragment->run->note_count > 0))
            return 2;
    }
    return most;
}

static void keep_nearest(Derivation *all, const Found *found)
{
    int at = all->nearest_count;
    if (all->first || found->like <= all->like ||
        (at == MAX_FIRST && found->like <= all->nearest[at - 1].like))
        return;
    if (at == MAX_FIRST)
        free(all->nearest[--at].text);
    else
        all->nearest_count++;
    for (; at > 0 && all->nearest[at - 1].like < found->like; at--)
        all->nearest[at] = all->nearest[at - 1];
    all->nearest[at] = *found;
    all->nearest[at].text = memory_text(found->text);
}

/* Opens a mutant again, beside the right program's other stage. */
static bool open_found(Derivation *all, const Found *found, PointShader *shader)
{
    if (!point_shader_open(shader, found->text, found->stage))
        return false;
    shader->at_once = found->stage == GLSL_VERTEX && all->right[0].at_once;
    return true;
}

/* Both stages of a mutant: one is the right program's, unless the first of two mutations is there.
 */
typedef struct Pair {
    PointShader own, other;
    PointShader *stages[2];
} Pair;

static bool open_pair(Derivation *all, const Found *found, Pair *pair)
{
    const bool both = found->first && found->first->stage != found->stage;
    *pair = (Pair){.other = {.setting = -1}};
    if (!open_found(all, found, &pair->own) ||
        (both && !open_found(all, found->first, &pair->other))) {
        point_shader_close(&pair->own);
        return false;
    }
    pair->stages[found->stage] = &pair->own;
    pair->stages[1 - found->stage] = both ? &pair->other : &all->right[1 - found->stage];
    return true;
}

static void close_pair(Pair *pair)
{
    point_shader_close(&pair->own);
    point_shader_close(&pair->other);
}

/* How many of the submission's values it has on its way, and how alike the texts are. */
static void compare_values(Derivation *all, Found *found)
{
    Values *own = memory_new(2, sizeof *own), *other = own + 1;
    Pair pair;
    if (open_pair(all, found, &pair)) {
        for (int k = 0; k < TRACED && 2 * k < all->points.count; k++) {
            const int point = all->order[2 * k];
            values_trace(&all->points, &all->own[0], &all->own[1], point, own);
            values_trace(&all->points, pair.stages[0], pair.stages[1], point, other);
            found->shared += values_shared(own, other);
        }
        for (int k = 0; k < 2; k++)
            found->other += values_count_other(pair.stages[k]->tree, all->own[k].tree);
        close_pair(&pair);
    }
    free(own);
}

/* Below 0: a is the better explanation. */
static int compare_found(const Found *a, const Found *b)
{
    const bool exact = a->apart <= ALIKE, other_exact = b->apart <= ALIKE;
    return exact != other_exact     ? other_exact - exact
           : a->shared != b->shared ? b->shared - a->shared
                                    : a->other - b->other;
}

static void take_found(Derivation *all, Found *found)
{
    compare_values(all, found);
    const int order = all->best.text ? compare_found(found, &all->best) : -1;
    const Mutation *mutation = &found->mutation, *best = &all->best.mutation;
    const bool earlier = mutation->rank != best->rank ? mutation->rank < best->rank
                                                      : strlen(mutation->name) < strlen(best->name);
    const bool same =
        order == 0 && mutation->node == best->node && strcmp(mutation->by, best->by) == 0;
    all->unique = order < 0 || (all->unique && (order > 0 || same));
    if (order > 0 || (order == 0 && !earlier)) {
        free(found->text);
        return;
    }
    free(all->best.text);
    all->best = *found;
}

static bool try_mutant(void *context, const Mutation *mutation, const char *text)
{
    Derivation *all = context;
    PointShader shader;
    Found found = {.mutation = *mutation, .stage = all->stage, .first = all->first};
    all->tried++;
    if (!point_shader_open(&shader, text, all->stage))
        return true;
    shader.at_once = all->stage == GLSL_VERTEX && all->right[0].at_once;
    found.text = memory_text(text);
    found.apart = all->stage == GLSL_VERTEX ? distance(all, &shader, all->base[1], &found.like)
                                            : distance(all, all->base[0], &shader, &found.like);
    keep_nearest(all, &found);
    point_shader_close(&shader);
    if (found.apart <= EQUAL)
        take_found(all, &found);
    else
        free(found.text);
    return !all->first || all->tried < MOST;
}

/* Where the submission's first value is that is wrong; else the name of what is. */
static void find_place(Derivation *all, const Found *found, char *place, size_t size)
{
    Values *own = memory_new(3, sizeof *own), *mutant = own + 1, *right = own + 2;
    Pair pair;
    const int point = all->order[0];
    int first = -1;
    if (open_pair(all, found, &pair)) {
        values_trace(&all->points, &all->own[0], &all->own[1], point, own);
        values_trace(&all->points, &all->right[0], &all->right[1], point, right);
        values_trace(&all->points, pair.stages[0], pair.stages[1], point, mutant);
        first = values_first(own, mutant, right);
        close_pair(&pair);
    }
    if (first >= 0)
        derivation_place(all, own->items[first].stage, own->items[first].node, place, size);
    else
        snprintf(place, size, "where %s should be", found->mutation.was);
    free(own);
}

static void add(const Mutation *mutation, const char *place, double sure, Verdict *verdict)
{
    char name[64], sentence[VERDICT_SENTENCE_SIZE];
    snprintf(name, sizeof name, "%.63s", mutation->name);
    snprintf(sentence, sizeof sentence,
             "%s%sIt draws what the right program draws with %s instead of %s.", mutation->sentence,
             mutation->sentence[0] ? " " : "", mutation->by[0] ? mutation->by : "nothing",
             mutation->was);
    verdict_add_mistake(verdict, name, sentence, place, sure);
}

static void say(Derivation *all, const Found *found, Verdict *verdict)
{
    char place[VERDICT_SENTENCE_SIZE];
    const double sure = all->unique ? UNIQUE : ONE_OF_SEVERAL;
    find_place(all, found, place, sizeof place);
    if (found->first)
        add(&found->first->mutation, place, sure, verdict);
    add(&found->mutation, place, sure, verdict);
    snprintf(verdict->message, sizeof verdict->message, "%s%s%s%s",
             found->first ? "Two mistakes: " : "", found->first ? found->first->mutation.name : "",
             found->first ? "; " : "", found->mutation.name);
}

/* All mutants of both stages of the base. */
static void mutate(Derivation *all)
{
    for (int stage = GLSL_FRAGMENT; stage >= GLSL_VERTEX; stage--) {
        all->stage = (GlslStage)stage;
        mutations_each(all->base[stage]->tree, all->numbers, all->number_count, try_mutant, all);
    }
}

/* Two mutations: of those that explain some points more than none, each with all others. */
static void mutate_twice(Derivation *all)
{
    for (int i = 0; i < all->nearest_count && !all->best.text && all->tried < MOST; i++) {
        PointShader shader;
        const Found *first = &all->nearest[i];
        if (!open_found(all, first, &shader))
            continue;
        all->first = first;
        all->base[first->stage] = &shader;
        mutate(all);
        all->base[first->stage] = &all->right[first->stage];
        point_shader_close(&shader);
    }
}

static bool use_right(Derivation *all, const char *ending)
{
    right_close(all);
    if (!right_open(all, ending))
        return false;
    right_run(all);
    sort_points(all);
    for (int i = 0; i < 2; i++)
        all->base[i] = &all->right[i];
    distance(all, all->base[0], all->base[1], &all->like);
    return true;
}

/* One mutation of each right program, then two. */
static bool search(Derivation *all)
{
    static const char *const ENDINGS[] = {"_apart", ""};
    for (int count = 1; count <= 2; count++) {
        for (int i = 0; i < 2 && !all->best.text; i++) {
            /* Where it computes what is right, it is wrong by what is undefined, or by precision.
             */
            if (!use_right(all, ENDINGS[i]) || all->wrong_by <= 4 * EQUAL)
                continue;
            mutate(all);
            if (count == 2 && !all->best.text)
                mutate_twice(all);
        }
    }
    return all->best.text;
}

bool derive_name(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                 bool *named, Message *message)
{
    Derivation *all = derivation_open(pictures, files, message);
    *named = false;
    if (!all)
        return !message->text[0];
    derivation_run(all, all->own, all->wanted, NULL);
    take_all_numbers(all);
    *named = search(all);
    if (*named)
        say(all, &all->best, verdict);
    else if (all->wrong_by > 4 * EQUAL)
        wrong_part_describe(all, verdict);
    derivation_close(all);
    return true;
}
