/*
 * verdict_text: a verdict as JSON without a library, as verdict_json.h writes it with one.
 */
#ifndef VERDICT_TEXT_H
#define VERDICT_TEXT_H

#include "labs/submission/verdict.h"

/* The members that a page needs; "text" is what `check` prints. */
void verdict_put(FILE *file, const Verdict *verdict, const Lab *lab);

#endif
