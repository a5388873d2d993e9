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

static const double TINY = 1e-4;
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
            values_trace_right(&all->points, pair.stages, point, all->in_eye, other);
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
    if (!mutation->name[0] || !mend_open(all, text, false, &shader))
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
    PointShader *const right[2] = {&all->right[0], &all->right[1]};
    values_trace_right(&all->points, right, point, all->in_eye, &values[1]);
    values_trace_right(&all->points, mutant, point, all->in_eye, &values[2]);
}

/* Whether what is assigned there is, at all these points, a value of the mutant, and at one after
 * the first wrong, because at one it may be so by chance. `strict`: else only the latter. */
static bool is_wrong_at(const Values (*values)[3], int count, const Assigned *first, bool strict)
{
    bool wrong = false, shared = true;
    for (int k = 0; k < count; k++) {
        bool any = false, of_mutant = false;
        for (int i = 0; i < values[k][0].count; i++) {
            const Assigned *own = &values[k][0].items[i];
            if (own->node != first->node || own->stage != first->stage)
                continue;
            any = true;
            of_mutant |= values_have(&values[k][2], &values[k][0], i);
            if (k > 0 && values_is_wrong(&values[k][0], i, &values[k][2], &values[k][1])) {
                wrong = true;
                break;
            }
        }
        shared &= !any || of_mutant;
    }
    return wrong && (shared || !strict);
}

/* Whether a variable just is an attribute, a varying or a uniform: it may be used rightly, too. */
static bool is_copy(const GlslTree *tree, int node)
{
    const GlslNode *value = &tree->nodes[values_given(tree, node)];
    const int storage = tree->symbols[value->symbol].storage;
    return value->kind == GLSL_NAME && storage >= GLSL_ATTRIBUTE && storage <= GLSL_VARYING;
}

/* Whether a variable begins with a constant to be computed later, as a sum does with 0. */
static bool is_begun(const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    bool begun = false;
    for (int i = 1; i < tree->node_count && at->kind == GLSL_VARIABLE_NODE && !begun; i++)
        begun = tree->nodes[at->first].constant && tree->nodes[i].kind == GLSL_ASSIGN &&
                tree->nodes[tree->nodes[i].first].symbol == at->symbol;
    return begun;
}

/* What is missing there belongs to the submission's own condition, if it has it. */
static void look_at_condition(Derivation *all, const Found *found)
{
    const GlslTree *tree = all->own[found->stage].tree;
    char text[MUTATION_TEXT];
    for (int i = 1; i < tree->node_count; i++) {
        if (tree->nodes[i].kind != GLSL_IF)
            continue;
        condition_of(tree, tree->nodes[tree->nodes[i].first].next, text);
        if (strcmp(text, found->where) == 0) {
            all->shown.stage = found->stage;
            all->shown.node = tree->nodes[i].first;
        }
    }
}

/* The submission's first value that is wrong as the mutant's is; NULL: none. */
static const Assigned *find_wrong(const Derivation *all, const Values (*values)[3], int count,
                                  bool strict)
{
    const Values *own = values[0];
    for (int i = 0; i < own->count; i++) {
        const Assigned *value = &own->items[i];
        const GlslTree *tree = all->own[value->stage].tree;
        if (!is_copy(tree, value->node) && !is_begun(tree, value->node) &&
            values_is_wrong(own, i, &values[0][2], &values[0][1]) &&
            is_wrong_at(values, count, value, strict))
            return value;
    }
    return NULL;
}

static void find_place(Derivation *all, const Found *found)
{
    Values(*values)[3] = memory_new(TRACED, sizeof *values);
    const int count = all->points.count / 2 < TRACED ? all->points.count / 2 : TRACED;
    Pair pair;
    all->place_node = 0;
    if (open_pair(all, found, &pair)) {
        for (int k = 0; k < count; k++) /* where it is wrong */
            trace_all(all, pair.stages, all->order[2 * k], values[k]);
        const Assigned *wrong = find_wrong(all, values, count, true);
        if (!wrong)
            wrong = find_wrong(all, values, 2, false);
        if (wrong)
            all->place_stage = wrong->stage, all->place_node = wrong->node;
        all->shown = (Shown){.stage = all->place_stage, .node = all->place_node};
        if (first_wrong_compare(all, pair.stages) && found->where[0])
            look_at_condition(all, found);
        close_pair(&pair);
    }
    free(values);
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

/* Two of the right program that is nearest, with light where the submission has it: a fragment
 * shader that lights has uniforms. A shadow is all or nothing, so that two explain too much. */
static bool search_two(Derivation *all, TwoOf of)
{
    double apart[2] = {INFINITY, INFINITY};
    const GlslTree *tree = all->own[1].tree;
    LitAt lit = LIT_AT_VERTICES;
    for (int i = 1; i < tree->symbol_count && all->lab->either; i++)
        if (tree->symbols[i].storage == GLSL_UNIFORM && tree->symbols[i].place.line)
            lit = LIT_AT_POINTS;
    for (int i = 0; i < 2; i++)
        if (derive_use_right(all, ENDINGS[i], lit) && all->wrong_by > 4 * EQUAL)
            apart[i] = all->nearest_right;
    if (all->lab->budget || all->lab->shadow ||
        !derive_use_right(all, ENDINGS[apart[0] >= apart[1]], lit) || !two_find(all, of))
        return false;
    find_place(all, &all->second);
    return true;
}

/* Of a right program or of the submission. */
static bool explain_at_vertices(Derivation *all, Verdict *verdict)
{
    return (derive_use_right(all, "_apart", LIT_NEAREST) && at_vertices_explain(all, verdict)) ||
           (derive_use_right(all, "", LIT_NEAREST) &&
            (at_vertices_explain(all, verdict) || at_vertices_explain_own(all, verdict)));
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
        explain_at_vertices(all, verdict))
        return true;
    if (exact || all->best.text) {
        all->mended = exact;
        return true;
    }
    if (explain_at_vertices(all, verdict) || all->mended)
        return true;
    return two_find(all, TWO_MEND) ||
           (!blind && (search_two(all, TWO_LIKELY) || search_two(all, TWO_ANY)));
}

bool derive_mistake(Derivation *all, Verdict *verdict)
{
    if (!explain(all, verdict))
        return false;
    if (verdict->mistake_count == 0)
        change_say(all, verdict);
    else
        all->mended = false, all->shown.size = 0;
    return true;
}
