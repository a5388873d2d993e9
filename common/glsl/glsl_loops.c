/*
 * How often a text's loops turn. As appendix A restricts them, a loop's first value, bound and step
 * are constants, so that counting needs no values of the program: a loop turns as often as its head
 * says, each turn runs the loops in its body once, and a call those of the function. Branches count
 * as taken, and `break` as not reached: what is counted is the most that can happen.
 */
#include "glsl/glsl.h"

#include "base/memory.h"

#include <stdlib.h>

typedef struct Count {
    const GlslTree *tree;
    double *functions; /* of each symbol; below 0: not yet known */
    double counted;    /* turns, one by one */
    double most;
    int worst; /* the loop that turns most often, with those around it */
} Count;

/* Whether a loop goes on with this value of its index. */
static bool goes_on(int op, double value, double bound)
{
    switch (op) {
    case GLSL_LESS:
        return value < bound;
    case GLSL_GREATER:
        return value > bound;
    case GLSL_LESS_EQUAL:
        return value <= bound;
    case GLSL_GREATER_EQUAL:
        return value >= bound;
    case GLSL_EQUAL:
        return value == bound;
    default:
        return value != bound;
    }
}

static double constant(const GlslTree *tree, int node)
{
    return tree->values[tree->nodes[node].value];
}

/* Counted as it turns: a float's sum may round so that it never ends. */
static double turns(const GlslTree *tree, int node)
{
    const int variable = tree->nodes[tree->nodes[node].first].first;
    const GlslNode *condition = &tree->nodes[glsl_child(tree, node, 1)];
    const GlslNode *step = &tree->nodes[glsl_child(tree, node, 2)];
    const double bound = constant(tree, glsl_child(tree, glsl_child(tree, node, 1), 1));
    const bool down = step->op == GLSL_SUBTRACT || step->op == GLSL_PRE_DECREMENT ||
                      step->op == GLSL_POST_DECREMENT;
    const double size = step->kind == GLSL_UNARY
                            ? 1
                            : constant(tree, glsl_child(tree, glsl_child(tree, node, 2), 1));
    float value = (float)constant(tree, tree->nodes[variable].first);
    int count = 0;
    while (count < GLSL_TURNS_MAX && goes_on(condition->op, (double)value, bound)) {
        value = (float)((double)value + (down ? -size : size));
        count++;
    }
    return count;
}

/* The turns of all loops in a node that runs `times` times. */
static double count_in(Count *count, int node, double times)
{
    const GlslTree *tree = count->tree;
    const GlslNode *own = &tree->nodes[node];
    double sum = 0;
    if (own->kind == GLSL_CALL && tree->symbols[own->symbol].node) {
        double *called = &count->functions[own->symbol];
        if (*called < 0)
            *called = count_in(count, tree->symbols[own->symbol].node, 1);
        sum += times * *called;
    }
    if (own->kind == GLSL_FOR) {
        const double own_turns =
            count->counted < 100.0 * GLSL_TURNS_MAX ? turns(tree, node) : GLSL_TURNS_MAX;
        count->counted += own_turns;
        times *= own_turns;
        sum += times;
        if (times > count->most) {
            count->most = times;
            count->worst = node;
        }
    }
    for (int i = own->first; i; i = tree->nodes[i].next)
        sum += count_in(count, i, times);
    return sum;
}

double glsl_count_turns(const GlslTree *tree, GlslPlace *place)
{
    Count count = {.tree = tree,
                   .functions = memory_new((size_t)tree->symbol_count, sizeof *count.functions)};
    for (int i = 0; i < tree->symbol_count; i++)
        count.functions[i] = -1;
    const double sum = count_in(&count, tree->symbols[tree->main].node, 1);
    *place = tree->nodes[count.worst].place;
    free(count.functions);
    return sum;
}
