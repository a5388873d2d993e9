/*
 * mutation: a right shader with one mistake, of all kinds that a table has, as texts. No GL.
 *
 * A rule says what becomes of a node of the tree (glsl/glsl.h), in GLSL, with the node's own
 * operands and names. What does not compile is no mutant.
 */
#ifndef MUTATION_H
#define MUTATION_H

#include "glsl/glsl.h"

enum { MUTATION_TEXT = 160, MUTATION_NUMBERS = 16 };

typedef struct Mutation {
    int node;                                   /* of the right tree */
    char name[MUTATION_TEXT];                   /* "not normalized: u_EyePosition - v_Position" */
    char was[MUTATION_TEXT], by[MUTATION_TEXT]; /* the node's text, and what is there instead */
    const char *sentence;                       /* what is wrong, or "" */
    int rank;                                   /* of two that are as near, the lower is named */
} Mutation;

/* Gets each mutant's text. False: no more. */
typedef bool MutationTake(void *context, const Mutation *mutation, const char *text);

/* All mutants of a valid tree. `numbers` are tried where a number may be wrong. `tree` is as it was
 * afterwards, with one symbol more. */
void mutations_each(GlslTree *tree, const double *numbers, int count, MutationTake *take,
                    void *context);

#endif
