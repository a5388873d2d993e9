/* A wrong program is changed as right ones are, by the same rules, until it computes what a right
 * program computes: then the change is where the mistake is, in the submission's own words, however
 * it is written. What is found is true by itself, so that of several the likeliest rule is enough.
 */
#include "labs/diagnosis/derivation.h"

#include "labs/diagnosis/diagnose.h"

#include "base/memory.h"
#include "base/text.h"
#include "core/matrix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double mend_apart(Derivation *all, PointShader *const pair[2], double most)
{
    double worst[MAX_RIGHTS] = {0}, least = 0;
    for (int i = 0; i < all->points.count && least <= most; i++) {
        const int point = all->order[i];
        double numbers[POINT_NUMBERS];
        points_run(&all->points, pair[0], pair[1], point, numbers);
        least = INFINITY;
        for (int k = 0; k < all->right_count; k++) {
            worst[k] = fmax(worst[k], points_apart(numbers, all->rights[k][point]));
            least = fmin(least, worst[k]);
        }
    }
    return least;
}

bool mend_passes(Derivation *all, const char *const texts[2])
{
    enum { MOST_DRAWN = 60 };
    char names[2][64], *whole[2];
    bool right = false, moved = false;
    Shader shader = {0};
    Message message;
    if (!all->canvas)
        return true;
    if (++all->drawn > MOST_DRAWN)
        return false;
    ShaderText files[3] = {{NULL, NULL}};
    for (int i = 0; i < 2; i++) {
        snprintf(names[i], sizeof names[i], "%s.%s", all->lab->file, i == 0 ? "vert" : "frag");
        whole[i] = right_declare(texts[i] ? all->undeclared[i] : "",
                                 texts[i] ? texts[i] : all->sources[i].text);
        files[i] = (ShaderText){names[i], strchr(whole[i], '\n') + 1}; /* has its own version */
    }
    const ShaderLoader loader = {.texts = files, .only_texts = true, .precision = "highp"};
    if (shader_open(&shader, &loader, all->lab->file, &message)) {
        const Painter painter = {.lab = all->lab, .program = shader.program};
        right = lab_pictures_is_right(all->pictures, &painter, all->canvas, &right, &message) &&
                right && /* a lab of one's own may move vertices */
                (all->lab->solution_count ||
                 outline_check(all->pictures, &painter, all->canvas, &moved, &message)) &&
                !moved;
        shader_close(&shader);
    }
    free(whole[0]);
    free(whole[1]);
    return right;
}

bool mend_holds(const GlslTree *tree, int node, int wanted)
{
    bool found = node == wanted;
    for (int i = tree->nodes[node].first; i && !found; i = tree->nodes[i].next)
        found = mend_holds(tree, i, wanted);
    return found;
}

bool mend_is_given(const Derivation *all, const Mutation *mutation)
{
    bool given = false;
    for (int i = 0; i < all->given_count[all->stage]; i++)
        given |= mend_holds(all->own[all->stage].tree, all->given[all->stage][i], mutation->node);
    return given;
}

/* Whether a statement stands there twice. */
static bool is_repeated(const GlslTree *tree, int node)
{
    char own[512], other[512];
    bool found = false;
    glsl_expression_text(tree, tree->nodes[node].first, own, sizeof own);
    for (int i = 1; i < tree->node_count && !found; i++) {
        if (i == node || tree->nodes[i].kind != GLSL_EXPRESSION)
            continue;
        glsl_expression_text(tree, tree->nodes[i].first, other, sizeof other);
        found = strcmp(own, other) == 0;
    }
    return found;
}

bool mend_is_odd(const Derivation *all, const Mutation *mutation)
{
    const bool maps = !all->lab->shadow && strncmp(mutation->mends, "not mapped to", 13) == 0;
    return (mutation->odd || maps) && !all->lab->solution_count;
}

/* Of a shadow anything of two values may become right by chance: a computation is no variable, a
 * mean no condition, and one of many samples may be left out. */
static bool loses(const Derivation *all, const Mutation *mutation)
{
    const char *by = mutation->by;
    const GlslTree *tree = all->own[all->stage].tree;
    return mend_is_odd(all, mutation) ||
           (all->lab->shadow && ((strchr(mutation->was, '(') && !strpbrk(by, "(.") &&
                                  (by[0] || !is_repeated(tree, mutation->node))) ||
                                 strstr(by, " > 0.0)")));
}

/* Whether it halves or doubles what has length 1, so that its length is not what is wrong. */
static bool scales_direction(Derivation *all, const Mutation *mutation)
{
    PointShader shader, *pair[2] = {&all->own[0], &all->own[1]};
    GlslTree *tree = all->own[all->stage].tree;
    char put[MUTATION_TEXT + 16];
    GlslNode was;
    const char *by = mutation->by;
    const bool scales = (strncmp(by, "0.5 * ", 6) == 0 || strncmp(by, "2.0 * ", 6) == 0) &&
                        strncmp(by + 6 + (by[6] == '('), mutation->was, strlen(mutation->was)) == 0;
    if (!scales || tree->nodes[mutation->node].type != GLSL_VEC3)
        return false;
    snprintf(put, sizeof put, "normalize(%s)", mutation->was);
    mutation_put(tree, mutation->node, put, &was);
    char *text = glsl_print(tree, tree->root);
    mutation_take_back(tree, mutation->node, &was);
    bool same = mend_open(all, text, true, &shader);
    if (same) {
        pair[all->stage] = &shader;
        same = derive_is_same(all, pair);
        point_shader_close(&shader);
    }
    free(text);
    return same;
}

/* Values that are vectors with no component above 0, as no light is. */
static int count_negative(const Values *values)
{
    int count = 0;
    for (int i = 0; i < values->count; i++) {
        const double *n = values->items[i].numbers;
        count += values->items[i].size >= 3 && fmax(n[0], fmax(n[1], n[2])) <= 0 &&
                 n[0] + n[1] + n[2] < 0;
    }
    return count;
}

bool mend_takes_light(Derivation *all, PointShader *const mended[2])
{
    Values *own = memory_new(2, sizeof *own), *other = own + 1;
    bool takes = true;
    for (int k = 0; k < TRACED && 2 * k < all->points.count && takes; k++) {
        values_trace(&all->points, &all->own[0], &all->own[1], all->order[2 * k], own);
        values_trace(&all->points, mended[0], mended[1], all->order[2 * k], other);
        takes = count_negative(other) > count_negative(own);
    }
    free(own);
    return takes;
}

/* As mend_holds, or in a function that is called there. */
static bool reaches(const GlslTree *tree, int node, int wanted)
{
    const GlslNode *at = &tree->nodes[node];
    bool found = node == wanted ||
                 (at->kind == GLSL_CALL && reaches(tree, tree->symbols[at->symbol].node, wanted));
    for (int i = at->first; i && !found; i = tree->nodes[i].next)
        found = reaches(tree, i, wanted);
    return found;
}

/* Whether one of the values has the direction of this vector. */
static bool has_direction(const Values *values, const Values *of, int number)
{
    const double *n = of->items[number].numbers;
    const Vec3 a = {n[0], n[1], n[2]};
    bool found = false;
    for (int i = 0; i < values->count && !found && of->items[number].size == 3; i++) {
        const double *m = values->items[i].numbers;
        const Vec3 b = {m[0], m[1], m[2]};
        const double lengths = sqrt(vec3_dot(a, a) * vec3_dot(b, b));
        found = values->items[i].size == 3 && lengths > 0 && vec3_dot(a, b) >= (1 - 1e-8) * lengths;
    }
    return found;
}

/* Whether the mended submission assigns the value to the same variable, if at another time. */
static bool remains(const Derivation *all, const Values *own, int number,
                    PointShader *const mended[2], const Values *other)
{
    const int stage = (int)own->items[number].stage;
    const char *name = all->own[stage].tree->symbols[own->items[number].symbol].name;
    bool found = false;
    for (int i = 0; i < other->count && !found; i++)
        found = (int)other->items[i].stage == stage &&
                other->items[i].part == own->items[number].part &&
                !values_differ(own, number, other, i) &&
                strcmp(mended[stage]->tree->symbols[other->items[i].symbol].name, name) == 0;
    return found;
}

/* Whether one of two values is taken, either of which may be right elsewhere. */
static bool is_choice(const Derivation *all, const Assigned *own)
{
    const GlslTree *tree = all->own[own->stage].tree;
    return own->scalar == GLSL_BOOL ||
           tree->nodes[values_given(tree, own->node)].kind == GLSL_CONDITIONAL;
}

static bool is_direction(const Assigned *value)
{
    const double *n = value->numbers;
    return value->size == 3 && fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-5;
}

/* What a change does to the submission's values. */
typedef struct Effect {
    bool leads;  /* the first wrong one becomes another */
    bool spoils; /* a right one before does */
    bool turns;  /* one of those is a direction; a sum may be right by chance */
} Effect;

static Effect effect_of(Derivation *all, PointShader *const mended[2])
{
    Values *own = memory_new(3, sizeof *own), *other = own + 1, *right = own + 2;
    struct {
        bool right, stays, aims, still_aims; /* at all points; aims: only its length may be wrong */
        bool unit;
    } kept[MAX_VALUES];
    Effect effect = {false, false, false};
    const bool in_eye = values_in_eye(mended); /* else what is in eye space is not right */
    PointShader *const rights[2] = {&all->right[0], &all->right[1]};
    int before = 0;
    memset(kept, true, sizeof kept);
    for (int k = 0; k < TRACED && 2 * k < all->points.count; k++) {
        const int point = all->order[2 * k];
        values_trace(&all->points, &all->own[0], &all->own[1], point, own);
        values_trace(&all->points, mended[0], mended[1], point, other);
        values_trace_right(&all->points, rights, point, in_eye, right);
        for (int i = 0; i < own->count; i++) {
            const bool stays = remains(all, own, i, mended, other);
            if (!stays && own->items[i].node == all->place_node &&
                own->items[i].stage == all->place_stage) { /* each time it is assigned */
                effect.leads = true;
                break;
            }
            kept[i].right &= values_have(right, own, i) && !is_choice(all, &own->items[i]);
            kept[i].stays &= stays;
            kept[i].unit &= is_direction(&own->items[i]);
            kept[i].aims &= has_direction(right, own, i);
            kept[i].still_aims &= stays || has_direction(other, own, i);
            before = i >= before ? i + 1 : before;
        }
    }
    for (int i = 0; i < before; i++) {
        const bool spoiled = kept[i].right && !kept[i].stays;
        effect.spoils |= spoiled || (kept[i].aims && !kept[i].still_aims);
        effect.turns |= spoiled && kept[i].unit;
    }
    free(own);
    return effect;
}

/* Whether it is where the first value is that is wrong, if that is known, or upstream, or decides
 * whether that is computed, and changes nothing that is right. */
static bool is_there(Derivation *all, const Found *found, PointShader *const mended[2])
{
    const GlslTree *tree = all->own[found->stage].tree;
    const int place = all->place_node, node = found->mutation.node;
    const int first = tree->nodes[node].kind == GLSL_EXPRESSION ? tree->nodes[node].first : 0;
    bool there = place > 0 && found->stage == all->place_stage &&
                 (first == place || reaches(tree, place, node));
    for (int i = 1; i < tree->node_count && place > 0 && !there; i++)
        there = found->stage == all->place_stage && tree->nodes[i].kind == GLSL_IF &&
                mend_holds(tree, i, place) && reaches(tree, tree->nodes[i].first, node);
    if (tree->nodes[first].kind == GLSL_BUILT_IN) /* it is not used */
        return true;
    if (place == 0)
        return false;
    const Effect effect = effect_of(all, mended);
    return there ? !effect.turns : effect.leads && !effect.spoils;
}

/* What a change leaves out; NULL: nothing. */
static const char *left_out(const Mutation *mutation)
{
    static const char MANY[] = " too many: ";
    const char *at = strstr(mutation->mends, MANY);
    return at ? at + strlen(MANY) : NULL;
}

/* Whether a leaves out what b puts in once more, or divides by: two of a sign are as none. */
static bool undoes(const Mutation *a, const Mutation *b)
{
    const char *out = left_out(a);
    return out && strstr(b->by, out) && !strstr(b->was, out);
}

/* Lab 11: whether a leaves out a variable of whose value b mends a part. */
static bool hides(const Derivation *all, const Found *a, const Found *b)
{
    const GlslTree *tree = all->own[b->stage].tree;
    const char *out = all->lab->shadow ? left_out(&a->mutation) : NULL;
    bool found = false;
    for (int i = 1; i < tree->node_count && out && !found; i++)
        found = tree->nodes[i].kind == GLSL_VARIABLE_NODE &&
                strcmp(tree->symbols[tree->nodes[i].symbol].name, out) == 0 &&
                mend_holds(tree, i, b->mutation.node);
    return found;
}

/* Whether a change needs a uniform that the submission does not declare. */
static bool needs_undeclared(const Derivation *all, const char *by)
{
    const char *declared = all->undeclared[all->stage];
    bool any = false;
    for (const char *at = strstr(declared, " u_"); at && !any; at = strstr(at + 1, " u_")) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at + 1, "[;"), at + 1);
        any = text_count_word(by, name) > 0;
    }
    return any;
}

/* Whether what is declared again is the variable outside. */
static bool unites(const Found *found)
{
    return strncmp(found->mutation.mends, "declared anew,", 14) == 0;
}

/* Counts the statements that end before a node's value is there, as they run: a function where it
 * is called. Functions that call others twice, and so on, are more than can be counted. */
static bool count_before(const GlslTree *tree, int node, int wanted, int *count)
{
    enum { MOST_COUNTED = 10000 };
    const GlslNode *at = &tree->nodes[node];
    bool found = *count >= MOST_COUNTED;
    for (int i = at->first; i && !found; i = tree->nodes[i].next)
        found = count_before(tree, i, wanted, count);
    if (at->kind == GLSL_CALL && !found)
        found = count_before(tree, tree->symbols[at->symbol].node, wanted, count);
    *count += !found && (at->kind == GLSL_EXPRESSION || at->kind == GLSL_VARIABLE_NODE ||
                         at->kind == GLSL_RETURN || at->kind == GLSL_IF);
    return found || node == wanted;
}

static int order_of(const Derivation *all, const Found *found)
{
    const GlslTree *tree = all->own[found->stage].tree;
    int count = 0;
    const bool runs =
        count_before(tree, tree->symbols[tree->main].node, found->mutation.node, &count);
    return runs ? count : 0;
}

/* The one that runs first, the smaller one; it is counted where nothing else decides. */
static int compare_places(const Derivation *all, const Found *a, const Found *b)
{
    const int order = order_of(all, a) - order_of(all, b);
    return order ? order : (int)strlen(a->mutation.was) - (int)strlen(b->mutation.was);
}

/* Below 0: a is the better change: right to the last digit, and not by a formula instead of all;
 * not of a variable computed anew; what leaves out; with what is declared; of one variable that is
 * two; without an operand twice; where the first wrong value is; of the likelier rule; the earlier
 * one; the smaller one. */
static int compare(const Derivation *all, const Found *a, const Found *b)
{
    const bool exact = a->apart <= DERIVATION_EQUAL && !a->mutation.formula;
    const bool other_exact = b->apart <= DERIVATION_EQUAL && !b->mutation.formula;
    return exact != other_exact                   ? (int)other_exact - (int)exact
           : a->mutation.anew != b->mutation.anew ? (int)a->mutation.anew - (int)b->mutation.anew
           : undoes(&a->mutation, &b->mutation)   ? -1
           : undoes(&b->mutation, &a->mutation)   ? 1
           : hides(all, b, a)                     ? -1
           : hides(all, a, b)                     ? 1
           : a->needs_undeclared != b->needs_undeclared
               ? (int)a->needs_undeclared - (int)b->needs_undeclared
           : unites(a) != unites(b) ? (int)unites(b) - (int)unites(a)
           : a->mutation.doubled != b->mutation.doubled
               ? (int)a->mutation.doubled - (int)b->mutation.doubled
           : a->there != b->there                 ? (int)b->there - (int)a->there
           : a->mutation.rank != b->mutation.rank ? a->mutation.rank - b->mutation.rank
           : a->stage != b->stage                 ? (int)a->stage - (int)b->stage
                                                  : compare_places(all, a, b);
}

bool mend_open(const Derivation *all, const char *text, bool own, PointShader *shader)
{
    char *whole = own ? right_declare(all->undeclared[all->stage], text) : NULL;
    const bool opened = point_shader_open(shader, whole ? whole : text, all->stage);
    shader->at_once = !own && all->stage == GLSL_VERTEX && all->right[0].at_once;
    free(whole);
    return opened;
}

bool mend_try(Derivation *all, const Mutation *mutation, const char *text)
{
    PointShader shader, *pair[2] = {&all->own[0], &all->own[1]};
    Found found = {.mutation = *mutation,
                   .stage = all->stage,
                   .there = true, /* at best */
                   .needs_undeclared = needs_undeclared(all, mutation->by)};
    if (mend_is_given(all, mutation) || loses(all, mutation) ||
        (all->mended && compare(all, &found, &all->mending) >= 0))
        return false;
    if (!mend_open(all, text, true, &shader))
        return false;
    pair[all->stage] = &shader;
    found.apart = mend_apart(all, pair, all->tolerance);
    const char *texts[2] = {NULL};
    texts[all->stage] = text;
    if (found.apart <= all->tolerance)
        found.there =
            (mutation->moves && strstr(mutation->by, "loop")) || is_there(all, &found, pair);
    const bool better = found.apart <= all->tolerance &&
                        (!all->mended || compare(all, &found, &all->mending) < 0) &&
                        !scales_direction(all, mutation) && !mend_takes_light(all, pair) &&
                        mend_passes(all, texts);
    if (better) {
        free(all->mending.text);
        all->mending = found;
        all->mending.text = memory_text(text);
        all->mended = true;
    }
    point_shader_close(&shader);
    return better;
}

static bool try_change(void *context, const Mutation *mutation, const char *text)
{
    mend_try(context, mutation, text);
    return true;
}

bool mend_find(Derivation *all)
{
    for (int stage = GLSL_VERTEX; stage <= GLSL_FRAGMENT; stage++) {
        all->stage = (GlslStage)stage;
        all->undeclared[stage] =
            right_undeclared(&all->points, all->own[stage].tree, all->own[1 - stage].tree);
        mutations_each(all->own[stage].tree, NULL, all->right_numbers, all->right_number_count,
                       try_change, all);
    }
    fit_find(all);
    return all->mended && all->mending.apart <= DERIVATION_EQUAL;
}
