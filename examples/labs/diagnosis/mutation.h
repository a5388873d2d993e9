/*
 * mutation: a shader with one change, of all kinds that a table has, as texts. A right one becomes
 * wrong by it, a wrong one right. No GL.
 *
 * A rule says what becomes of a node of the tree (glsl/glsl.h), in GLSL, with the node's own
 * operands and names. What does not compile is no mutant.
 */
#ifndef MUTATION_H
#define MUTATION_H

#include "glsl/glsl.h"

enum { MUTATION_TEXT = 200, MUTATION_NUMBERS = 16 };

typedef struct Mutation {
    int node;                                   /* of the tree */
    char name[MUTATION_TEXT];                   /* "not normalized: u_EyePosition - v_Position" */
    char was[MUTATION_TEXT], by[MUTATION_TEXT]; /* the node's text, and what is there instead */
    char
        mends[MUTATION_TEXT]; /* the name of the mistake in a wrong text that becomes right by it */
    const char *put;          /* all of `by`, in parentheses if it has to be */
    const char *sentence;     /* what is wrong, or "" */
    int rank;                 /* of two that are as near, the lower is named */
    int variant;              /* which name and number of its rule's */
    bool likely;              /* of mutation_likely.def, but for w */
    bool formula;             /* nothing of what was there is left */
    bool general;             /* its text has no number and no name that was tried */
    bool doubled;             /* a name that is another operand already */
    bool anew;                /* a variable's value is computed anew where it is used */
    bool odd;                 /* no right program of the chapter has it */
    bool moves;               /* more than its place changes: `put` is not all of it */
} Mutation;

/* Gets each mutant's text. False: no more. */
typedef bool MutationTake(void *context, const Mutation *mutation, const char *text);

/* Puts a mutation's text where its node is, so that mutants have both; `was`: what was there. What
 * is put has to live until it is taken back. */
void mutation_put(GlslTree *tree, int node, const char *put, GlslNode *was);
void mutation_take_back(GlslTree *tree, int node, const GlslNode *was);

/* All mutants of a valid tree, or `only` this one again, of a tree that was changed elsewhere.
 * `numbers` are tried where a number may be wrong. `tree` is as it was afterwards. */
void mutations_each(GlslTree *tree, const Mutation *only, const double *numbers, int count,
                    MutationTake *take, void *context);

/* The rank of a number that is another. */
int mutation_number_rank(void);

#endif
