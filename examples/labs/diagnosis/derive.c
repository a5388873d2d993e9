/* Of a right program all mutants are run at the same points as the submission, those first where
 * the submission is farthest from right, so that nearly all are ruled out by one or two points.
 * What is left computes the same numbers at hundreds of points. If several do, that one is named
 * which has most of the submission's values on its way: a light whose direction is reversed draws
 * what a reversed normal draws, but only one of the two is among the submission's values. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double UNIQUE = 0.9, ONE_OF_SEVERAL = 0.75, TINY = 1e-4;
static const double EQUAL = DERIVATION_EQUAL, ALIKE = 1e-6;

/* Constants of a shader that may be a mistake's numbers: they and their reciprocals. */
static void take_number(double numbers[MUTATION_NUMBERS], int *count, double number)
{
    number = fabs(number);
    for (int i = 0; i < *count; i++)
        if (fabs(numbers[i] - number) <= 1e-9 * number)
            return;
    if (number > 1e-6 && number < 1000 && *count < MUTATION_NUMBERS)
        numbers[(*count)++] = number;
}

static void take_numbers(const GlslTree *tree, int node, double *numbers, int *count)
{
    const GlslNode *at = &tree->nodes[node];
    /* A tiny one draws what 0 does, and so does a large exponent. */
    if (at->constant && at->type == GLSL_FLOAT && fabs(tree->values[at->value]) >= TINY)
        take_number(numbers, count, tree->values[at->value]);
    for (int i = at->first; i; i = tree->nodes[i].next)
        take_numbers(tree, i, numbers, count);
}

/* How often a number is multiplied by itself. */
static int count_squares(const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    char left[64], right[64];
    int count = 0;
    if ((at->kind == GLSL_BINARY || at->kind == GLSL_ASSIGN) && at->op == GLSL_MULTIPLY &&
        at->type == GLSL_FLOAT) {
        glsl_expression_text(tree, at->first, left, sizeof left);
        glsl_expression_text(tree, tree->nodes[at->first].next, right, sizeof right);
        count = strcmp(left, right) == 0;
    }
    for (int i = at->first; i; i = tree->nodes[i].next)
        count += count_squares(tree, i);
    return count;
}

static void take_own_numbers(Derivation *all)
{
    double *numbers = all->numbers;
    /* The exponent of a power without pow. */
    const int squares = count_squares(all->own[1].tree, all->own[1].tree->root);
    for (int i = 1; i <= squares && i <= 6; i++)
        take_number(numbers, &all->number_count, exp2(i));
    for (int i = 0; i < 2; i++)
        take_numbers(all->own[i].tree, all->own[i].tree->root, numbers, &all->number_count);
    const int count = all->own_number_count = all->number_count;
    for (int i = 0; i < count; i++)
        take_number(numbers, &all->number_count, 1 / numbers[i]);
    for (int i = 0; i < count; i++) {
        take_number(numbers, &all->number_count, 1 + numbers[i]);
        take_number(numbers, &all->number_count, 1 - numbers[i]);
    }
}

/* Those of a right program, of formulas that can be written in another way, and what is usual. */
static void take_right_numbers(Derivation *all)
{
    enum { FEW = 32 };
    static const double USUAL[] = {2, 0.5};
    for (int i = 0; i < 2; i++)
        take_number(all->right_numbers, &all->right_number_count, USUAL[i]);
    for (int i = 0; i < 2; i++)
        take_numbers(all->right[i].tree, all->right[i].tree->root, all->right_numbers,
                     &all->right_number_count);
    /* What is counted is wrong by one: 8 or 1 / 8 for nine, 9 for 4 * 4. */
    for (int i = 0; i < all->own_number_count; i++) {
        const double number = all->numbers[i], whole = number < 1 ? 1 / number : number;
        const double root = sqrt(whole), wanted[] = {whole - 1, whole + 1, (root - 1) * (root - 1),
                                                     (root + 1) * (root + 1)};
        for (int k = 0; k < 4 && whole > 1.5 && whole < FEW && whole == rint(whole); k++)
            if (k < 2 || root == rint(root))
                take_number(all->right_numbers, &all->right_number_count,
                            number < 1 ? 1 / wanted[k] : wanted[k]);
    }
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
        const int stride = 10007; /* a prime above both counts: none is left over */
        if (step < wrong)
            all->order[used++] = list[step * stride % wrong].point;
        if (step < count - wrong)
            all->order[used++] = list[wrong + step * stride % (count - wrong)].point;
    }
    free(list);
}

/* How far the pair is from the submission; far away: it is not looked at further. */
static double distance(Derivation *all, PointShader *const pair[2])
{
    double most = 0, numbers[POINT_NUMBERS];
    for (int i = 0; i < all->points.count && most <= EQUAL; i++) {
        const int point = all->order[i];
        points_run(&all->points, pair[0], pair[1], point, numbers);
        most = fmax(most, points_apart(numbers, all->wanted[point]));
        /* Undefined where the submission is not. */
        if (!all->noted && pair[0]->run->note_count + pair[1]->run->note_count > 0)
            return 2;
    }
    return most;
}

bool derive_is_same(Derivation *all, PointShader *const pair[2])
{
    return distance(all, pair) <= EQUAL;
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

void derive_compare_values(Derivation *all, Found *found)
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

/* Below 0: a is the better explanation: nearer, by what is on its way, and without a name or number
 * that was tried. */
static int compare_found(const Found *a, const Found *b)
{
    const bool exact = a->apart <= ALIKE, other_exact = b->apart <= ALIKE;
    const bool general = a->mutation.general, other_general = b->mutation.general;
    return exact != other_exact     ? other_exact - exact
           : a->shared != b->shared ? b->shared - a->shared
                                    : other_general - general;
}

/* Of those that are as good the likelier one; and how alike the texts are. */
static int compare_texts(const Found *a, const Found *b)
{
    const Mutation *p = &a->mutation, *q = &b->mutation;
    return p->rank != q->rank     ? p->rank - q->rank
           : a->other != b->other ? a->other - b->other
                                  : (int)strlen(p->name) - (int)strlen(q->name);
}

static void take_found(Derivation *all, Found *found)
{
    derive_compare_values(all, found);
    const Found *best = &all->best;
    const int order = best->text ? compare_found(found, best) : -1;
    const bool better = order < 0 || (order == 0 && compare_texts(found, best) < 0);
    const bool same = order == 0 && found->mutation.node == best->mutation.node &&
                      strcmp(found->mutation.by, best->mutation.by) == 0;
    /* The other is not as good, or less alike, too. */
    const int less = order != 0 ? order : found->other - best->other;
    all->unique = order < 0 || (all->unique && (same || (better ? less < 0 : less > 0)));
    if (!better) {
        free(found->text);
        return;
    }
    free(all->best.text);
    all->best = *found;
}

/* The condition on which the node is reached in its function, or "". */
static void condition_of(const GlslTree *tree, int wanted, char text[MUTATION_TEXT])
{
    text[0] = '\0';
    for (int i = 1; i < tree->node_count; i++) {
        const int condition = tree->nodes[i].first;
        if (tree->nodes[i].kind != GLSL_IF ||
            !mend_holds(tree, tree->nodes[condition].next, wanted))
            continue;
        char *printed = glsl_print(tree, condition);
        snprintf(text, MUTATION_TEXT, "%s", printed);
        free(printed);
    }
}

static bool try_mutant(void *context, const Mutation *mutation, const char *text)
{
    Derivation *all = context;
    PointShader shader, *pair[2] = {&all->right[0], &all->right[1]};
    Found found = {.mutation = *mutation, .stage = all->stage};
    if (!mend_open(all, text, false, &shader))
        return true;
    pair[all->stage] = &shader;
    found.apart = distance(all, pair);
    point_shader_close(&shader);
    if (found.apart <= EQUAL) {
        condition_of(all->right[all->stage].tree, mutation->node, found.where);
        found.text = memory_text(text);
        take_found(all, &found);
    }
    return true;
}

/* The submission's values, the right program's and the mutant's at a point. */
static void trace_all(Derivation *all, PointShader *const mutant[2], int point, Values values[3])
{
    values_trace(&all->points, &all->own[0], &all->own[1], point, &values[0]);
    values_trace(&all->points, &all->right[0], &all->right[1], point, &values[1]);
    values_trace(&all->points, mutant[0], mutant[1], point, &values[2]);
}

static bool is_wrong_at(const Values values[3], GlslStage stage, int node)
{
    bool wrong = false;
    for (int i = 0; i < values[0].count && !wrong; i++)
        wrong = values[0].items[i].node == node && values[0].items[i].stage == stage &&
                values_is_wrong(&values[0], i, &values[2], &values[1]);
    return wrong;
}

/* Finds the submission's first value that is wrong as the mutant's is; at two points, because at
 * one it may be so by chance. */
static void find_place(Derivation *all, const Found *found)
{
    Values *values = memory_new(6, sizeof *values);
    Pair pair;
    all->place_node = 0;
    if (open_pair(all, found, &pair)) {
        for (int k = 0; k < 2; k++) /* where it is wrong */
            trace_all(all, pair.stages, all->order[2 * k], values + 3 * k);
        for (int i = 0; i < values[0].count && !all->place_node; i++) {
            const int node = values[0].items[i].node;
            all->place_stage = values[0].items[i].stage;
            if (values_is_wrong(&values[0], i, &values[2], &values[1]) &&
                is_wrong_at(values + 3, all->place_stage, node))
                all->place_node = node;
        }
        close_pair(&pair);
    }
    free(values);
}

/* After a colon the right program's words become the submission's at the place, if that is known.
 */
static void name_mutation(const Mutation *mutation, const char *place, char name[MUTATION_TEXT * 2])
{
    const char *colon = strstr(mutation->name, ": "), *own = place ? strstr(place, ": ") : NULL;
    const bool number = !mutation->was[strspn(mutation->was, ".0123456789")];
    const bool both = colon && own && !number; /* which the submission may not have */
    snprintf(name, MUTATION_TEXT * 2, "%.*s%.190s",
             (int)(both ? colon - mutation->name : MUTATION_TEXT), mutation->name, both ? own : "");
}

/* Of one of two mistakes the place is not known. */
static void add(const Found *found, const char *place, bool alone, double sure, Verdict *verdict)
{
    const Mutation *mutation = &found->mutation;
    char name[MUTATION_TEXT * 2], sentence[VERDICT_SENTENCE_SIZE];
    name_mutation(mutation, alone ? place : NULL, name);
    snprintf(
        sentence, sizeof sentence,
        "%s%sIt draws what the solution would draw if it had %.120s where it has %.120s%s%.120s.",
        mutation->sentence, mutation->sentence[0] ? " " : "",
        mutation->by[0] ? mutation->by : "nothing", mutation->was,
        found->where[0] ? ", where " : "", found->where);
    verdict_add_mistake(verdict, name, sentence, place, sure);
}

/* Whether it undoes something by a formula around it, and has no name: 2 c - 1 for c. */
static bool wraps(const Mutation *mending)
{
    const size_t length = strlen(mending->was);
    return strncmp(mending->mends, mending->was, length) == 0 &&
           strncmp(mending->mends + length, " for ", 5) == 0 && strstr(mending->by, mending->was);
}

/* The line that has to change, and to what. */
static void say_mending(Derivation *all, const Found *found, Verdict *verdict)
{
    const Mutation *mending = &found->mutation, *best = &all->best.mutation;
    const bool sole = all->mended_twice ? all->unique : all->mending.apart <= EQUAL;
    const bool known = all->best.text && best->general && all->unique && all->mending.there;
    const bool likelier = known && best->rank < mending->rank && wraps(mending);
    char place[VERDICT_SENTENCE_SIZE], sentence[VERDICT_SENTENCE_SIZE], look[VERDICT_SENTENCE_SIZE];
    char name[MUTATION_TEXT * 2];
    derivation_place(all, found->stage, mending->node, place, sizeof place);
    name_mutation(best, place, name);
    snprintf(look, sizeof look, "%.250s; all is right with %s%s", place,
             mending->by[0] ? mending->by : "nothing there",
             all->mended_twice ? " and the other change" : "");
    snprintf(sentence, sizeof sentence, "%s%sIt draws what is right with %s instead of %s%s.",
             known ? best->sentence : "", known && best->sentence[0] ? " " : "",
             mending->by[0] ? mending->by : "nothing", mending->was,
             all->mended_twice ? ", once the other mistake is mended, too" : "");
    change_take_text(all, found,
                     verdict_add_mistake(verdict, likelier ? name : mending->mends, sentence, look,
                                         known || sole ? UNIQUE : ONE_OF_SEVERAL));
}

/* Whether the first wrong value is known, and not just the result. */
static bool is_inside(const Derivation *all)
{
    const GlslTree *tree = all->own[all->place_stage].tree;
    const GlslNode *node = &tree->nodes[all->place_node];
    while (node->kind != GLSL_NAME && node->kind != GLSL_VARIABLE_NODE && node->first)
        node = &tree->nodes[node->first];
    const GlslSymbol *symbol = &tree->symbols[node->symbol];
    return all->place_node && !symbol->built_in && symbol->storage != GLSL_VARYING;
}

/* A change elsewhere than at the first wrong value makes up for a mistake, but of a shadow, which a
 * function returns. */
static void say(Derivation *all, Verdict *verdict)
{
    const Found *found = all->two_found ? &all->second : &all->best;
    const double sure = all->unique ? UNIQUE : ONE_OF_SEVERAL;
    char look[VERDICT_SENTENCE_SIZE];
    const bool other = found->text && found->mutation.general && all->unique && is_inside(all);
    if (all->mended_twice || (all->mended && (all->mending.there || !other || all->lab->shadow))) {
        say_mending(all, &all->mending, verdict);
        if (all->mended_twice)
            say_mending(all, &all->second, verdict);
    } else {
        if (all->place_node)
            derivation_place(all, all->place_stage, all->place_node, look, sizeof look);
        else
            snprintf(look, sizeof look, "where %s should be", found->mutation.was);
        if (found->first)
            add(found->first, look, false, sure, verdict);
        add(found, look, !found->first && is_inside(all), sure, verdict);
        wrong_part_say(all, verdict);
    }
    const bool same = found->first && found->first->mutation.rank == found->mutation.rank;
    snprintf(verdict->message, sizeof verdict->message, "%s%s%s%s",
             verdict->mistake_count < 2 ? ""
             : same                     ? "Twice the same mistake: "
                                        : "Two mistakes: ",
             verdict->mistakes[0].name, verdict->mistake_count > 1 ? "; " : "",
             verdict->mistake_count > 1 ? verdict->mistakes[1].name : "");
}

bool derive_use_right(Derivation *all, const char *ending, LitAt lit)
{
    right_close(all);
    if (!right_open(all, ending))
        return false;
    right_run(all, lit);
    sort_points(all);
    return true;
}

static const char *const ENDINGS[] = {"_apart", "", "_terms"}; /* the last for what is left */

/* One mutation of each right program. */
static bool search(Derivation *all)
{
    bool seen = false; /* the vertex shaders of both */
    for (int i = 0; i < 6 && !all->best.text; i++) {
        const LitAt lit = i % 2 ? LIT_AT_POINTS : LIT_AT_VERTICES;
        /* Where it computes what is right, it is wrong by what is undefined, or by precision. */
        if ((i % 2 && !all->lab->either) || !derive_use_right(all, ENDINGS[i / 2], lit) ||
            all->wrong_by <= 4 * EQUAL)
            continue;
        for (int stage = GLSL_FRAGMENT; stage >= (seen ? GLSL_FRAGMENT : GLSL_VERTEX); stage--) {
            all->stage = (GlslStage)stage;
            mutations_each(all->right[stage].tree, NULL, all->numbers, all->number_count,
                           try_mutant, all);
        }
        seen = !all->lab->either;
    }
    return all->best.text;
}

/* Two of the right program that is nearest. A shadow is all or nothing, so that two explain too
 * much. */
static bool search_two(Derivation *all, TwoOf of)
{
    double apart[2] = {INFINITY, INFINITY};
    for (int i = 0; i < 2; i++)
        if (derive_use_right(all, ENDINGS[i], LIT_NEAREST) && all->wrong_by > 4 * EQUAL)
            apart[i] = all->nearest_right;
    if (all->lab->budget || all->lab->shadow ||
        !derive_use_right(all, ENDINGS[apart[0] >= apart[1]], LIT_NEAREST) || !two_find(all, of))
        return false;
    find_place(all, &all->second);
    return true;
}

/* The change that makes a right program as wrong, and that which makes the submission right; then
 * what is at the vertices, then two changes. */
static bool explain(Derivation *all, Verdict *verdict)
{
    take_own_numbers(all);
    if (!right_run_all(all) || !derive_use_right(all, "", LIT_NEAREST) ||
        all->wrong_by <= 4 * EQUAL)
        return false;
    take_right_numbers(all);
    /* No shadow, or nothing else: that many changes do says nothing. */
    const bool blind = derivation_wastes_map(all);
    if (!blind && search(all))
        find_place(all, &all->best);
    const bool exact = mend_find(all);
    if (exact && all->mending.mutation.formula && !all->best.text &&
        derive_use_right(all, "", LIT_NEAREST) && at_vertices_explain_own(all, verdict))
        return true;
    if (exact || all->best.text) {
        all->mended = exact;
        return true;
    }
    if ((derive_use_right(all, "_apart", LIT_NEAREST) && at_vertices_explain(all, verdict)) ||
        (derive_use_right(all, "", LIT_NEAREST) &&
         (at_vertices_explain(all, verdict) || at_vertices_explain_own(all, verdict))) ||
        all->mended)
        return true;
    return two_find(all, TWO_MEND) ||
           (!blind && (search_two(all, TWO_LIKELY) || search_two(all, TWO_ANY)));
}

bool derive_mistake(Derivation *all, Verdict *verdict)
{
    if (!explain(all, verdict))
        return false;
    if (verdict->mistake_count == 0)
        say(all, verdict);
    return true;
}
