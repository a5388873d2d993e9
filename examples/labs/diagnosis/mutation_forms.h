/*
 * mutation_forms: texts that stand for a node and that no pattern of mutation_rules.def makes.
 */
#ifndef MUTATION_FORMS_H
#define MUTATION_FORMS_H

#include "glsl/glsl.h"

typedef struct Form {
    const char *text;         /* instead of the node's; of a statement that is moved: where it is */
    const char *name, *other; /* what the rule's @ and # are */
    const char *whole;        /* all of the text, NULL: what is around the node stays as it is */
    const char *was;          /* what the text replaces, NULL: the node's */
} Form;
typedef void FormTake(void *context, const Form *form);

/* Each of a kind. The tree is as it was afterwards. */
typedef void FormsEach(GlslTree *tree, int node, FormTake *take, void *context);

/* With leaves of two operands exchanged. */
FormsEach forms_exchanges;

/* A sum or product with a pair of parentheses more, or less: `name` is what is in it. */
FormsEach forms_brackets, forms_unbrackets;

/* A factor (`name`) of a product with a sum, for all but one of its terms (`other`). */
FormsEach forms_spreads;

/* The condition of a loop, or its beginning, one more or less. */
FormsEach forms_turns, forms_begins;

/* A local variable, computed anew with another element (`name`, was `other`) of the uniforms. */
FormsEach forms_lights;

/* What is computed with one light, with the other one (`name`). */
FormsEach forms_twins;

/* A statement before, behind or in a loop or an `if` near it, or before a statement near it. */
FormsEach forms_moves;

/* Of the condition of an `else if`: as an `if` of its own. */
FormsEach forms_else_ifs;

/* 1, for what a variable begins with that is the exponent of a power. */
FormsEach forms_exponents;

/* What is assigned to a variable (`name`), added to it, whose first value is 0 then. */
FormsEach forms_summed;

/* Of a variable (`name`) that hides another, to which its first value is assigned instead. */
FormsEach forms_declared;

/* A parameter (`name`) that is assigned, for the caller, too. */
FormsEach forms_inout;

/* A sum of quotients of one number: that number divided by the sum. */
FormsEach forms_reciprocals;

/* A power, only where the cosine (`name`) of two local vectors is above 0. */
FormsEach forms_facing;

/* The node that it is a child of; 0: none. */
int forms_parent(const GlslTree *tree, int node);

/* A variable, an element or a component. */
bool forms_is_name(const GlslNode *node);

#endif
