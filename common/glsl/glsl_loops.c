/*
 * How much a text runs, at most. As appendix A restricts them, a loop's first value, bound and step
 * are constants, so that counting needs no values of the program: a loop turns as often as its head
 * says, each turn runs what is in its body once, and a call what is in the function. Branches count
 * as taken, and `break` as not reached: what is counted is the most that can happen. A function is
 * counted once, however often it is called.
 */
#include "glsl/glsl.h"

#include "base/memory.h"

#include <stdlib.h>

typedef struct Count {
    const GlslTree *tree;
    GlslWork *functions; /* of each symbol; its size is 0: not yet known */
    double counted;      /* turns, one by one */
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

static void add(GlslWork *sum, const GlslWork *part, double times)
{
    sum->size += part->size;
    sum->turns += times * part->turns;
    sum->steps += times * part->steps;
}

/* Of a node that runs once, in loops that turn `around` times. */
static GlslWork count_in(Count *count, int node, double around)
{
    const GlslTree *tree = count->tree;
    const GlslNode *own = &tree->nodes[node];
    GlslWork work = {.size = 1, .steps = 1};
    double times = 1;
    if (own->kind == GLSL_CALL && tree->symbols[own->symbol].node) {
        GlslWork *called = &count->functions[own->symbol];
        if (called->size == 0)
            *called = count_in(count, tree->symbols[own->symbol].node, 1);
        add(&work, called, 1);
    }
    if (own->kind == GLSL_FOR) {
        times = count->counted < 100.0 * GLSL_TURNS_MAX ? turns(tree, node) : GLSL_TURNS_MAX;
        count->counted += times;
        work.turns = times;
        if (around * times > count->most) {
            count->most = around * times;
            count->worst = node;
        }
    }
    for (int i = own->first; i; i = tree->nodes[i].next) {
        const GlslWork part = count_in(count, i, around * times);
        add(&work, &part, times);
    }
    return work;
}

GlslWork glsl_count_work(const GlslTree *tree)
{
    Count count = {.tree = tree,
                   .functions = memory_new((size_t)tree->symbol_count, sizeof *count.functions)};
    GlslWork work = count_in(&count, tree->symbols[tree->main].node, 1);
    work.place = tree->nodes[count.worst ? count.worst : tree->symbols[tree->main].node].place;
    free(count.functions);
    return work;
}
