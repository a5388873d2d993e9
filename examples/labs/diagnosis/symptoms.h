/*
 * symptoms: describes a wrong picture in words.
 */
#ifndef SYMPTOMS_H
#define SYMPTOMS_H

#include "labs/submission/shots.h"
#include "labs/submission/verdict.h"

/* Adds the symptoms to the verdict. `moved`: the outline is wrong. */
void symptoms_describe(const Shots *shots, bool moved, Verdict *verdict);

#endif
