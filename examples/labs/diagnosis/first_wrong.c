/* The submission and what it becomes by the change that makes it right run at the point where it is
 * most wrong. The first assignment whose value is another is where the mistake shows first. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_numbers(const double *numbers, int count, char text[80])
{
    for (int i = 0, used = 0; i < count; i++)
        used += snprintf(text + used, 80 - (size_t)used, "%s%.4g", i ? ", " : "", numbers[i]);
}

static char *change(Derivation *all, const Mutation *mending)
{
    GlslNode was;
    GlslTree *tree = all->own[all->stage].tree;
    char put[MUTATION_TEXT + 3];
    snprintf(put, sizeof put, mending->by[0] ? "(%s)" : "", mending->by);
    mutation_put(tree, mending->node, put, &was);
    char *body = glsl_print(tree, tree->root);
    mutation_take_back(tree, mending->node, &was);
    char *text = right_declare(all->undeclared[all->stage], body);
    free(body);
    return text;
}

void first_wrong_find(Derivation *all, Verdict *verdict, FirstWrong *first)
{
    PointShader mended, *pair[2] = {&all->own[0], &all->own[1]};
    Values *own = memory_new(2, sizeof *own), *right = own + 1;
    bool other = false;
    all->stage = all->mending.stage;
    char *text = change(all, &all->mending.mutation);
    if (!all->mended_twice && point_shader_open(&mended, text, all->stage)) {
        pair[all->stage] = &mended;
        values_trace(&all->points, &all->own[0], &all->own[1], all->order[0], own);
        values_trace(&all->points, pair[0], pair[1], all->order[0], right);
        point_shader_close(&mended);
    }
    for (int i = 0; i < own->count && i < right->count && !other; i++) {
        const double *numbers = own->items[i].numbers, *wanted = right->items[i].numbers;
        const GlslStage stage = own->items[i].stage;
        const char *name = all->own[stage].tree->symbols[own->items[i].symbol].name;
        const int size = own->items[i].size;
        char place[VERDICT_SENTENCE_SIZE], is[80], should[80];
        for (int k = 0; k < size; k++)
            other |= fabs(numbers[k] - wanted[k]) > 1e-4 * fmax(1, fabs(wanted[k]));
        if (!other || strncmp(name, "gl_", 3) == 0)
            continue;
        put_numbers(numbers, size, is);
        put_numbers(wanted, size, should);
        derivation_place(all, stage, own->items[i].node, place, sizeof place);
        verdict_add_symptom(verdict,
                            "Wrong first, where it is worst: %s is %s; right is %s. See %s.", name,
                            is, should, place);
        *first = (FirstWrong){.stage = (int)all->mending.stage, .right = text};
        snprintf(first->name, sizeof first->name, "%s", name);
    }
    if (!first->right)
        free(text);
    free(own);
}
