/* Light is a sum, so its terms can be seen one by one without knowing the text: what a uniform
 * switches off is left out of both programs. Then each value that the submission assigns is
 * replaced by each value of the right program: if one makes all right, the mistake is there. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* That of pictures; and the share of points that may differ, at edges of shadows. */
static const double TOLERANCE = 2.5 / 255, MAY_DIFFER = 0.03;

int wrong_part_list(const Lab *lab, Term terms[MAX_TERMS])
{
    static const int LIGHTS = POINTS_NO_FIRST | POINTS_NO_SECOND;
    static const int NOTHING = LIGHTS | POINTS_NO_AMBIENT | POINTS_NO_SPECULAR;
    int count = 0;
    /* Nothing, if it is right. */
    terms[count++] = (Term){"what is there without any light", NOTHING, -1};
    if (lab->ambient)
        terms[count++] = (Term){"the ambient term", LIGHTS, NOTHING};
    for (int specular = 0; specular <= lab->specular; specular++) {
        for (int i = 0; i < lab->lights; i++) {
            const int other = i == 0 ? POINTS_NO_SECOND : POINTS_NO_FIRST;
            const int diffuse = POINTS_NO_AMBIENT | POINTS_NO_SPECULAR | other;
            Term *term = &terms[count++];
            *term = specular ? (Term){"", POINTS_NO_AMBIENT | other, diffuse}
                             : (Term){"", diffuse, NOTHING};
            snprintf(term->name, sizeof term->name, "%s%s",
                     specular ? "the highlight" : "the diffuse term",
                     lab->lights == 1 ? ""
                     : i == 0         ? " of light 1"
                                      : " of light 2");
        }
    }
    return count;
}

static void run_without(Derivation *all, PointShader pair[2], int without, Numbers numbers)
{
    all->points.without = without;
    for (int i = 0; i < all->points.count && without >= 0; i++)
        points_run(&all->points, &pair[0], &pair[1], i, numbers[i]);
    all->points.without = 0;
}

/* A highlight that nothing switches off is in the diffuse term, too. */
static bool is_seen_alone(const Derivation *all, const Term *term)
{
    return !all->lab->specular || !(term->without & POINTS_NO_SPECULAR) || term->beside < 0 ||
           derivation_uses(all->own[0].tree, "u_SpecularColor") ||
           derivation_uses(all->own[1].tree, "u_SpecularColor");
}

PartState wrong_part_judge(Derivation *all, const Term *term)
{
    const int count = all->points.count;
    int seen = 0, wrong = 0;
    Numbers own = memory_new((size_t)(4 * count), sizeof *own), own_beside = own + count;
    Numbers right = own + 2 * count, right_beside = own + 3 * count;
    run_without(all, all->own, term->without, own);
    run_without(all, all->own, term->beside, own_beside);
    run_without(all, all->right, term->without, right);
    run_without(all, all->right, term->beside, right_beside);
    for (int i = 0; i < count; i++) {
        double apart = 0, light = 0;
        for (int c = 0; c < 3; c++) {
            const double own_light = own[i][c] - own_beside[i][c];
            const double right_light = right[i][c] - right_beside[i][c];
            /* Where all is white already, or below black, nothing shows. */
            const bool full = fmax(own[i][c], right[i][c]) > 0.995 &&
                              fmin(own_beside[i][c], right_beside[i][c]) > TOLERANCE;
            const bool dark = own_beside[i][c] <= 0 && right_beside[i][c] > TOLERANCE;
            apart = fmax(apart, full || dark ? 0 : fabs(own_light - right_light));
            light = fmax(light, full || dark ? 0 : fmax(fabs(own_light), right_light));
        }
        seen += light > TOLERANCE;
        wrong += apart > TOLERANCE;
    }
    free(own);
    return wrong > MAY_DIFFER * seen && wrong > 0
               ? is_seen_alone(all, term) ? PART_WRONG : PART_UNSEEN
           : seen > 4 ? PART_RIGHT
                      : PART_UNSEEN;
}

/* Whether the term is below 0 somewhere, which shows beside ambient light. */
static bool takes_light(Derivation *all, const Term *term)
{
    const int count = all->points.count;
    Numbers own = memory_new((size_t)(2 * count), sizeof *own), beside = own + count;
    bool takes = false;
    run_without(all, all->own, term->without & ~POINTS_NO_AMBIENT, own);
    run_without(all, all->own, term->beside & ~POINTS_NO_AMBIENT, beside);
    for (int i = 0; i < 3 * count && !takes && term->beside >= 0; i++)
        takes = own[i / 3][i % 3] < beside[i / 3][i % 3] - TOLERANCE;
    free(own);
    return takes;
}

/* "a", "a and b", "a, b and c" of the terms that are so. */
static void list_names(const Term *terms, const int *states, int count, int state, char text[256])
{
    int left = 0;
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count; i++)
        left += states[i] == state;
    for (int i = 0; i < count; i++) {
        if (states[i] != state)
            continue;
        left--;
        used += (size_t)snprintf(text + used, 256 - used, "%s%s", terms[i].name,
                                 left > 1    ? ", "
                                 : left == 1 ? " and "
                                             : "");
    }
}

/* Replacing. */

typedef struct Repair {
    const Values *right; /* at this point */
    const Values *own;
    int node;           /* of the submission, whose value is replaced */
    int symbol, offset; /* of the right program: whose value it gets, from which turn on */
    GlslStage stage;    /* that of the right program's value */
    int turn;           /* how often the node was reached */
} Repair;

static void replace(GlslRun *run, const GlslEvent *event, void *observer)
{
    Repair *repair = observer;
    if (event->node != repair->node)
        return;
    int turn = repair->turn++ + repair->offset;
    for (int i = 0; i < repair->right->count; i++) {
        if (repair->right->items[i].symbol != repair->symbol ||
            repair->right->items[i].stage != repair->stage || turn-- > 0)
            continue;
        for (int k = 0; k < event->count && k < repair->right->items[i].size; k++)
            run->registers[event->first + k] = repair->right->items[i].numbers[k];
        return;
    }
}

/* Whether the submission is right where its node's values are the right program's. */
static bool repairs(Derivation *all, const Values *rights, int own_stage, Repair *repair)
{
    bool right = true;
    for (int i = 0; i < all->points.count && right; i++) {
        const int point = all->order[i];
        double numbers[POINT_NUMBERS];
        repair->right = &rights[point];
        repair->turn = 0;
        GlslRun *run = all->own[own_stage].run;
        run->assigned = replace;
        run->observer = repair;
        all->own[0].done[point] = false;
        points_run(&all->points, &all->own[0], &all->own[1], point, numbers);
        run->assigned = NULL;
        right = points_apart(numbers, all->exact[point]) <= TOLERANCE;
        if (own_stage == GLSL_VERTEX)
            all->own[0].done[point] = false;
    }
    return right;
}

static bool is_result(const char *name)
{
    return strncmp(name, "gl_", 3) == 0;
}

/* The first value of the submission that one of the right program's can replace; -1: none. */
static int find_repair(Derivation *all, const Values *rights, const Values *own, Repair *repair)
{
    const Values *right = &rights[all->order[0]];
    for (int i = 0; i < own->count; i++) {
        const GlslTree *tree = all->own[own->items[i].stage].tree;
        if (is_result(tree->symbols[own->items[i].symbol].name) ||
            own->items[i].scalar != GLSL_FLOAT) /* another turn of a loop explains nothing */
            continue;
        for (int k = 0; k < right->count; k++) {
            const GlslTree *other = all->right[right->items[k].stage].tree;
            if (right->items[k].size != own->items[i].size ||
                is_result(other->symbols[right->items[k].symbol].name))
                continue;
            for (int offset = 0; offset < 3; offset++) {
                *repair = (Repair){.node = own->items[i].node,
                                   .symbol = right->items[k].symbol,
                                   .stage = right->items[k].stage,
                                   .offset = offset};
                if (repairs(all, rights, (int)own->items[i].stage, repair))
                    return i;
            }
        }
    }
    return -1;
}

/* Keeps the first value that is replaced, and the right one. */
static void take_repair(Derivation *all, const Values *rights, Values *own, const Repair *repair,
                        GlslStage stage)
{
    int points[SHOWN_POINTS], at = 0, turn = repair->offset;
    first_wrong_points(all, points);
    const Values *right = &rights[points[0]];
    values_trace(&all->points, &all->own[0], &all->own[1], points[0], own);
    while (at < own->count &&
           (own->items[at].node != repair->node || own->items[at].stage != stage))
        at++;
    for (int k = 0; at < own->count && k < right->count; k++)
        if (right->items[k].symbol == repair->symbol && right->items[k].stage == repair->stage &&
            turn-- == 0 && values_differ(own, at, right, k))
            first_wrong_take(all, own, at, right, k, points[0]);
}

/* The line where another value makes right what is seen `without` some parts; false: there is none.
 * One run for a point, as if all three corners were there. */
static bool find_line(Derivation *all, int without, char place[VERDICT_SENTENCE_SIZE])
{
    const int count = all->points.count;
    const bool own_at_once = all->own[0].at_once, right_at_once = all->right[0].at_once;
    Values *rights = memory_new((size_t)count + 1, sizeof *rights), *own = &rights[count];
    Repair repair;
    all->own[0].at_once = all->right[0].at_once = true;
    all->points.without = without;
    memset(all->own[0].done, 0, (size_t)count * sizeof(bool));
    for (int i = 0; i < count; i++) {
        values_trace(&all->points, &all->right[0], &all->right[1], i, &rights[i]);
        points_run(&all->points, &all->right[0], &all->right[1], i, all->exact[i]);
    }
    values_trace(&all->points, &all->own[0], &all->own[1], all->order[0], own);
    const int at = find_repair(all, rights, own, &repair);
    if (at >= 0)
        derivation_place(all, own->items[at].stage, own->items[at].node, place,
                         VERDICT_SENTENCE_SIZE);
    if (at >= 0 && without == 0)
        take_repair(all, rights, own, &repair, own->items[at].stage);
    all->own[0].at_once = own_at_once;
    all->right[0].at_once = right_at_once;
    all->points.without = 0;
    free(rights);
    return at >= 0;
}

WrongParts wrong_part_say(Derivation *all, Verdict *verdict)
{
    Term terms[MAX_TERMS];
    int states[MAX_TERMS];
    char right[256];
    WrongParts parts = {.told = false};
    if (!derive_use_right(all, "", LIT_NEAREST) || all->wrong_by <= 4 * DERIVATION_EQUAL)
        return parts;
    const int count = wrong_part_list(all->lab, terms);
    for (int i = 0; i < count; i++)
        states[i] =
            takes_light(all, &terms[i]) ? PART_WRONG : (int)wrong_part_judge(all, &terms[i]);
    parts.all_right = count > 0;
    for (int i = count; i-- > 0;) {
        parts.first = states[i] == PART_WRONG ? terms[i] : parts.first;
        parts.all_right &= states[i] == PART_RIGHT;
    }
    list_names(terms, states, count, PART_RIGHT, right);
    list_names(terms, states, count, PART_WRONG, parts.names);
    if (parts.names[0])
        verdict_add_symptom(verdict, "Wrong, each seen alone: %s.", parts.names);
    if (right[0])
        verdict_add_symptom(verdict, "Right, each seen alone: %s.", right);
    parts.told = true;
    return parts;
}

void wrong_part_describe(Derivation *all, Verdict *verdict)
{
    char place[VERDICT_SENTENCE_SIZE] = "";
    const WrongParts parts = wrong_part_say(all, verdict);
    const char *wrong = parts.names;
    if (!parts.told)
        return;
    if (find_line(all, 0, place))
        verdict_add_symptom(verdict, "With another value there all would be right: %s.", place);
    else if (wrong[0] && find_line(all, parts.first.without, place))
        verdict_add_symptom(verdict, "With another value there %s would be right: %s.",
                            parts.first.name, place);
    snprintf(verdict->message, sizeof verdict->message, "Unknown mistake%s%s%s%s",
             wrong[0]          ? " in "
             : parts.all_right ? " in how the terms are combined"
                               : "",
             wrong, place[0] ? ", " : "", place);
}
