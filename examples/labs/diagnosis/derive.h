/*
 * derive: names a mistake from its shaders and a right program alone, by a change (mutation.h):
 * that which makes the submission right, or that which makes a right program compute the same.
 */
#ifndef DERIVE_H
#define DERIVE_H

#include "labs/diagnosis/derivation.h"

/* Adds the mistake, less sure if others compute the same and are as near to the submission's text.
 * False: none is found. */
bool derive_mistake(Derivation *all, Verdict *verdict);

/* Runs the lab's right program of this ending; false: it has none. `order` begins where the
 * submission is farthest from it, and `wrong_by` says how far. */
bool derive_use_right(Derivation *all, const char *ending, LitAt lit);

#endif
