/*
 * symptoms: what a wrong picture looks like, in words.
 */
#ifndef SYMPTOMS_H
#define SYMPTOMS_H

#include "shots.h"
#include "verdict.h"

/* Adds to the verdict what is to be seen. `moved`: the outline is not the right one. */
void symptoms_describe(const Shots *shots, bool moved, Verdict *verdict);

#endif
