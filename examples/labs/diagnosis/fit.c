/* A number of the submission, or a factor that a value lacks, is fitted: the secant method finds
 * with which number the farthest point is right. What is right there by chance is not at the
 * others, so that one point to solve for is enough. */
#include "labs/diagnosis/derivation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 12, WORST_POINTS = 3, MANY_RULES = 1000, MOST_DIGITS = 2 };

typedef struct Fit {
    Derivation *all;
    int node;
    const char *form, *was; /* what is put there: of %s the node's text, then of %s the number */
    int point, channel;
    bool usual; /* 0 and 1 */
} Fit;

/* 0.25, and 4.0. */
static void print_number(double number, int digits, char text[32])
{
    snprintf(text, 32, "%.*g", digits, number);
    if (!strpbrk(text, ".e"))
        strcat(text, ".0");
}

/* The stage's text with a number there; for free(). */
static char *text_with(const Fit *fit, const char *number, char by[MUTATION_TEXT])
{
    GlslTree *tree = fit->all->own[fit->all->stage].tree;
    GlslNode was;
    char put[MUTATION_TEXT + 4];
    if (fit->form)
        snprintf(by, MUTATION_TEXT, fit->form, fit->was, number);
    else
        snprintf(by, MUTATION_TEXT, "%.31s", number);
    snprintf(put, sizeof put, number[0] == '-' || fit->form ? "(%s)" : "%s", by);
    mutation_put(tree, fit->node, put, &was);
    char *text = glsl_print(tree, tree->root);
    mutation_take_back(tree, fit->node, &was);
    return text;
}

/* How far the point is from right, with a sign; NaN: it cannot be run. */
static double miss(const Fit *fit, double number)
{
    Derivation *all = fit->all;
    PointShader shader, *pair[2] = {&all->own[0], &all->own[1]};
    char digits[32], by[MUTATION_TEXT];
    double numbers[POINT_NUMBERS], missed = NAN;
    print_number(number, 17, digits);
    char *text = text_with(fit, digits, by);
    if (mend_open(all, text, true, &shader)) {
        pair[all->stage] = &shader;
        points_run(&all->points, pair[0], pair[1], fit->point, numbers);
        missed = numbers[fit->channel] - fit->all->exact[fit->point][fit->channel];
        point_shader_close(&shader);
    }
    free(text);
    return missed;
}

/* The number with which the point is right; NaN: there is none near. */
static double solve(const Fit *fit, double number)
{
    double before = number, other = 1.1 * number + 0.01, missed_before = miss(fit, before);
    for (int i = 0; i < STEPS; i++) {
        const double missed = miss(fit, other), slope = (missed - missed_before) / (other - before);
        if (fabs(missed) <= 1e-9)
            return other;
        if (slope == 0 || !isfinite(slope))
            break;
        before = other;
        missed_before = missed;
        other -= missed / slope;
    }
    return NAN;
}

/* Tries it as the change: the shortest number with which all is right. */
static void take(const Fit *fit, double number)
{
    Derivation *all = fit->all;
    Mutation mutation = {.node = fit->node, .sentence = ""};
    snprintf(mutation.was, sizeof mutation.was, "%.*s", MUTATION_TEXT - 1, fit->was);
    for (int digits = 1, taken = 0; digits <= 6 && !taken; digits++) {
        char short_number[32];
        print_number(number, digits, short_number);
        /* Less likely: a factor, or a number of many digits; 0 or 1. */
        mutation.rank =
            mutation_number_rank() + (fit->form || digits > MOST_DIGITS ? MANY_RULES : fit->usual);
        char *text = text_with(fit, short_number, mutation.by);
        snprintf(mutation.mends, sizeof mutation.mends,
                 fit->form ? "factor missing: %.0s%s" : "%.40s for %s", fit->was, short_number);
        taken = mend_try(all, &mutation, text);
        free(text);
    }
}

/* The channel that is farthest from right at the point. */
static int worst_channel(const Fit *fit)
{
    int worst = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(fit->all->wanted[fit->point][i] - fit->all->exact[fit->point][i]) >
            fabs(fit->all->wanted[fit->point][worst] - fit->all->exact[fit->point][worst]))
            worst = i;
    return worst;
}

static void try_node(Derivation *all, int node, bool literal)
{
    const GlslTree *tree = all->own[all->stage].tree;
    char was[MUTATION_TEXT];
    glsl_expression_text(tree, node, was, sizeof was);
    Fit fit = {all, node, literal ? NULL : "%s * %s", was, 0, 0, false};
    const double begin = literal ? tree->values[tree->nodes[node].value] : 1;
    fit.usual = begin == 0 || begin == 1;
    char grouped[MUTATION_TEXT + 2];
    snprintf(grouped, sizeof grouped, "(%s)", was);
    fit.was = literal ? was : grouped;
    /* Every second one of the order is wrong; a point may not depend on the number. */
    for (int i = 0; i < WORST_POINTS && 2 * i < all->points.count; i++) {
        fit.point = all->order[2 * i];
        fit.channel = worst_channel(&fit);
        const double number = solve(&fit, begin);
        if (isfinite(number) && fabs(number) > 1e-6 && fabs(number) < 1e6) {
            take(&fit, number);
            return;
        }
    }
}

/* Numbers, or the values that are assigned or returned. */
static void walk(Derivation *all, int node, bool literals)
{
    const GlslTree *tree = all->own[all->stage].tree;
    const GlslNode at = tree->nodes[node];
    if (literals && at.kind == GLSL_LITERAL && at.type == GLSL_FLOAT)
        try_node(all, node, true);
    for (int i = at.first; i; i = tree->nodes[i].next) {
        const GlslNode child = tree->nodes[i];
        const bool assigned = at.kind == GLSL_VARIABLE_NODE || at.kind == GLSL_RETURN ||
                              (at.kind == GLSL_ASSIGN && i != at.first);
        if (!literals && !all->mended && assigned && child.kind != GLSL_LITERAL &&
            (child.type == GLSL_FLOAT || child.type == GLSL_VEC3))
            try_node(all, i, false);
        walk(all, i, literals);
    }
}

void fit_find(Derivation *all)
{
    const bool numbers = !all->mended || all->mending.mutation.rank > mutation_number_rank();
    for (int i = numbers ? 0 : 4; i < 4 && (i < 2 || !all->mended); i++) {
        all->stage = i % 2 ? GLSL_VERTEX : GLSL_FRAGMENT;
        walk(all, all->own[all->stage].tree->root, i < 2);
    }
}
