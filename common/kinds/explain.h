/*
 * explain: the effects that the views of a scene need, and what their programs cost.
 */
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "app/renderer.h"
#include "lighting/lighting.h"

#include <stdio.h>

/* Writes the effects at the request's time, by view and object. */
void explain_effects(Renderer *renderer, const DrawRequest *request, FILE *file);

/* --explain: the same on standard output, with each program's operations; without --verbose a
 * screenful, the first object in full and of the others what differs. Compiles the programs, so
 * that the loader prints them if it was asked to. */
bool explain_programs(Renderer *renderer, const DrawRequest *request, Message *message);

/* Of a plan of many objects prints how many have the same effects; returns, to be freed, which are
 * the first of theirs. */
enum { EXPLAIN_FEW = 24 };
bool *explain_groups(const LightingPlan *plan);

#endif
