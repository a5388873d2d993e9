/* The submission runs beside what it becomes by the change that makes it right, or else a right
 * program beside one that is changed until it draws what the submission does. The first variable
 * that has another value is where the mistake shows first. */
#include "labs/diagnosis/derivation.h"
#include "labs/diagnosis/mutation_forms.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_APART = 32 };

static void put_numbers(const double *numbers, int count, char text[80])
{
    for (int i = 0, used = 0; i < count; i++)
        used += snprintf(text + used, 80 - (size_t)used, "%s%.4g", i ? ", " : "", numbers[i]);
}

static const PointSetting *setting_of(const Derivation *all, int point)
{
    return &all->points.settings[all->points.items[point].setting];
}

/* Where the point is in its picture, if its scene is the same for every seed; else it is the worst.
 */
static void put_place(const Derivation *all, int point, char text[100])
{
    const PointSetting *setting = setting_of(all, point);
    double place[3];
    points_place(&all->points, point, place);
    snprintf(text, 100, "where it is worst");
    if (setting->scene)
        snprintf(text, 100, "in scene %s (known), column %d, row %d from the top", setting->scene,
                 (int)(setting->width * (place[0] + 1) / 2),
                 (int)(setting->height * (1 - place[1]) / 2));
}

int first_wrong_points(const Derivation *all, int list[SHOWN_POINTS])
{
    double most = 4 * DERIVATION_EQUAL;
    int count = 1;
    list[0] = -1;
    for (int i = 0; i < all->points.count; i++) {
        const int point = all->order[i];
        const double apart = points_apart(all->wanted[point], all->exact[point]);
        if (!setting_of(all, point)->scene || apart <= 4 * DERIVATION_EQUAL)
            continue;
        list[0] = apart > most ? point : list[0];
        most = apart > most ? apart : most;
        if (count < SHOWN_POINTS - 1)
            list[count++] = point;
    }
    count = list[0] < 0 ? 0 : count;
    list[count++] = all->order[0];
    return count;
}

void first_wrong_take(Derivation *all, const Values *own, int number, const Values *right,
                      int other, int point)
{
    const GlslStage stage = own->items[number].stage;
    const int size = own->items[number].size, right_size = right->items[other].size;
    all->shown = (Shown){.point = point,
                         .stage = stage,
                         .node = own->items[number].node,
                         .size = size < right_size ? size : right_size};
    const GlslTree *tree = all->own[stage].tree;
    const GlslSymbol *symbol = &tree->symbols[own->items[number].symbol];
    const int part = own->items[number].part, field = tree->types[symbol->type].field + part - 1;
    if (part && tree->types[symbol->type].fields)
        snprintf(all->shown.name, sizeof all->shown.name, "%s.%s", symbol->name,
                 tree->fields[field].name);
    else
        snprintf(all->shown.name, sizeof all->shown.name, part ? "%s[%d]" : "%s", symbol->name,
                 part - 1);
    memcpy(all->shown.is, own->items[number].numbers, sizeof all->shown.is);
    memcpy(all->shown.should, right->items[other].numbers, sizeof all->shown.should);
}

/* What two programs assign on their way at a point, the wrong one and the right one. */
enum { WRONG, RIGHT };
typedef struct Ways {
    PointShader *pairs[2][2];
    Values of[2];
    short common[MAX_VALUES + 1][MAX_VALUES + 1];
} Ways;

/* Two values of a variable that differ; `lost`: only the right program assigns another there. */
typedef struct Apart {
    int at[2];
    bool lost;
} Apart;

static bool is_same_variable(const Ways *ways, int side, int number, int other_side, int other)
{
    const Values *a = &ways->of[side], *b = &ways->of[other_side];
    const GlslStage stage = a->items[number].stage;
    return stage == b->items[other].stage && a->items[number].part == b->items[other].part &&
           strcmp(ways->pairs[side][stage]->tree->symbols[a->items[number].symbol].name,
                  ways->pairs[other_side][stage]->tree->symbols[b->items[other].symbol].name) == 0;
}

/* From each pair of values on: how many of both can be assigned to the same variables, in order. */
static void fill_common(Ways *ways)
{
    for (int i = ways->of[WRONG].count; i >= 0; i--) {
        for (int k = ways->of[RIGHT].count; k >= 0; k--) {
            const bool inside = i < ways->of[WRONG].count && k < ways->of[RIGHT].count;
            const short *next = inside ? &ways->common[i + 1][k] : NULL;
            ways->common[i][k] = !inside                                      ? 0
                                 : is_same_variable(ways, WRONG, i, RIGHT, k) ? (short)(next[1] + 1)
                                 : next[0] > ways->common[i][k + 1]           ? next[0]
                                                                    : ways->common[i][k + 1];
        }
    }
}

/* The last value of a side before `end` that is one of the other's variable; -1: none. */
static int value_before(const Ways *ways, int side, int end, int other_side, int other)
{
    do
        end--;
    while (end >= 0 && !is_same_variable(ways, side, end, other_side, other));
    return end;
}

/* Where one side alone assigns, unless it declares or counts, the value that the other has. Where
 * the wrong one assigns what is there already, it is as if it did not. */
static bool pair_up(const Ways *ways, int side, bool both, Apart *apart)
{
    const int number = apart->at[side], stage = (int)ways->of[side].items[number].stage;
    const GlslNode *nodes = ways->pairs[side][stage]->tree->nodes;
    int *other = &apart->at[!side];
    if (both) {
        const int before = value_before(ways, WRONG, apart->at[WRONG], WRONG, apart->at[WRONG]);
        apart->lost = before >= 0 &&
                      values_equal(&ways->of[WRONG], before, &ways->of[WRONG], apart->at[WRONG]);
        return true;
    }
    apart->lost = side == RIGHT;
    *other = value_before(ways, !side, *other, side, number);
    return *other >= 0 && ways->of[side].items[number].scalar != GLSL_INT &&
           nodes[ways->of[side].items[number].node].kind != GLSL_VARIABLE_NODE;
}

/* In order. */
static int list_apart(const Ways *ways, Apart list[MAX_APART])
{
    const int counts[2] = {ways->of[WRONG].count, ways->of[RIGHT].count};
    int i = 0, k = 0, count = 0;
    while ((i < counts[WRONG] || k < counts[RIGHT]) && count < MAX_APART) {
        const bool inside = i < counts[WRONG] && k < counts[RIGHT];
        const bool both = inside && is_same_variable(ways, WRONG, i, RIGHT, k);
        const bool right =
            inside ? both || ways->common[i][k + 1] >= ways->common[i + 1][k] : k < counts[RIGHT];
        Apart *apart = &list[count];
        *apart = (Apart){.at = {i, k}};
        count +=
            pair_up(ways, right, both, apart) &&
            values_differ(&ways->of[WRONG], apart->at[WRONG], &ways->of[RIGHT], apart->at[RIGHT]);
        i += both || !right;
        k += right;
    }
    return count;
}

static void trace(const Derivation *all, int point, Ways *ways)
{
    for (int i = 0; i < 2; i++)
        values_trace(&all->points, ways->pairs[i][0], ways->pairs[i][1], point, &ways->of[i]);
    fill_common(ways);
}

static bool is_place(const Derivation *all, const Values *own, int number)
{
    return own->items[number].node == all->place_node &&
           own->items[number].stage == all->place_stage;
}

/* The submission's value that is the wrong one: where its first wrong value is or, if the right
 * program alone goes on, the last that is the same, unless it is 0, as many are; -1: none. */
static int find_own(const Derivation *all, const Values *own, const Ways *ways, const Apart *apart)
{
    bool any = false;
    int found = -1;
    for (int c = 0; c < ways->of[WRONG].items[apart->at[WRONG]].size; c++)
        any |= apart->lost && ways->of[WRONG].items[apart->at[WRONG]].numbers[c] != 0;
    for (int i = 0; i < own->count; i++) {
        if (!values_equal(own, i, &ways->of[WRONG], apart->at[WRONG]))
            continue;
        if (is_place(all, own, i))
            return i;
        found = any ? i : found;
    }
    return found;
}

/* Keeps a value that is assigned at the place, or else the first; of a mutant (`own`) the
 * submission's. True: that is at the place or, of a mutant, the right program alone goes on. */
static bool choose(Derivation *all, Ways *ways, Values *own)
{
    Apart list[MAX_APART];
    int points[SHOWN_POINTS];
    const int count = first_wrong_points(all, points);
    bool there = false, lost = false;
    all->shown.size = 0;
    for (int i = 0; i < count && !there; i++) {
        trace(all, points[i], ways);
        if (own)
            values_trace(&all->points, &all->own[0], &all->own[1], points[i], own);
        const int apart = list_apart(ways, list);
        for (int k = 0; k < apart && !there; k++) {
            const int number = own ? find_own(all, own, ways, &list[k]) : list[k].at[WRONG];
            there = number >= 0 && (own || is_place(all, &ways->of[WRONG], number));
            lost = list[k].lost;
            if (there || (number >= 0 && !all->shown.size))
                first_wrong_take(all, own ? own : &ways->of[WRONG], number, &ways->of[RIGHT],
                                 list[k].at[RIGHT], points[i]);
        }
    }
    return there && (!own || lost);
}

bool first_wrong_compare(Derivation *all, PointShader *const mutant[2])
{
    Ways *ways = memory_new(1, sizeof *ways);
    Values *own = memory_new(1, sizeof *own);
    for (int i = 0; i < 2; i++) {
        ways->pairs[WRONG][i] = mutant[i];
        ways->pairs[RIGHT][i] = &all->right[i];
    }
    const bool lost = choose(all, ways, own);
    free(ways);
    free(own);
    return lost;
}

/* Makes the place the statement or condition that a change is in, unless that begins in another
 * line. */
static void put_place_of(Derivation *all, const Found *found)
{
    const GlslTree *tree = all->own[found->stage].tree;
    const GlslNode *nodes = tree->nodes;
    const int changed = found->mutation.node;
    int node = nodes[changed].kind == GLSL_EXPRESSION ? nodes[changed].first : changed;
    for (int above = node;
         above && (nodes[above].kind <= GLSL_CONSTRUCT || nodes[above].kind == GLSL_VARIABLE_NODE);
         above = forms_parent(tree, above))
        node = above;
    all->place_node = nodes[node].place.line == nodes[changed].place.line ? node : changed;
    all->place_stage = found->stage;
}

/* Two changes of one stage are both in the second's text. */
static void compare_mended(Derivation *all, FirstWrong *first)
{
    const Found *changes[2] = {&all->mending, all->mended_twice ? &all->second : NULL};
    PointShader opened[2] = {{.setting = -1}, {.setting = -1}};
    Ways *ways = memory_new(1, sizeof *ways);
    const char *text = NULL;
    for (int i = 0; i < 2; i++)
        ways->pairs[RIGHT][i] = ways->pairs[WRONG][i] = &all->own[i];
    for (int i = 0; i < 2 && changes[i]; i++) {
        all->stage = changes[i]->stage;
        if (mend_open(all, changes[i]->text, true, &opened[i]))
            ways->pairs[RIGHT][all->stage] = &opened[i];
        text = changes[i]->text;
    }
    put_place_of(all, changes[0]);
    if (!choose(all, ways, NULL) && !changes[1])
        all->shown.node = all->place_node, all->shown.stage = all->place_stage;
    /* A colour is seen anyway; and where two shaders change, no single one is right. */
    if (all->shown.size && strncmp(all->shown.name, "gl_", 3) != 0 &&
        !(changes[1] && changes[0]->stage != changes[1]->stage)) {
        *first = (FirstWrong){.stage = (int)all->stage,
                              .right = right_declare(all->undeclared[all->stage], text)};
        snprintf(first->name, sizeof first->name, "%s", all->shown.name);
    }
    point_shader_close(&opened[0]);
    point_shader_close(&opened[1]);
    free(ways);
}

void first_wrong_find(Derivation *all, Verdict *verdict, FirstWrong *first)
{
    const Shown *shown = &all->shown;
    char place[VERDICT_SENTENCE_SIZE], where[100], is[80], should[80];
    if (all->mended || all->mended_twice)
        compare_mended(all, first);
    if (!shown->size)
        return;
    put_place(all, shown->point, where);
    put_numbers(shown->is, shown->size, is);
    put_numbers(shown->should, shown->size, should);
    derivation_place(all, shown->stage, shown->node, place, sizeof place);
    verdict_add_symptom(verdict, "Wrong first, %s: %s is %s; right is %s. See %s.", where,
                        shown->name, is, should, place);
}
