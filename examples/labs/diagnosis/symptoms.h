/*
 * symptoms: describes a wrong picture in words.
 */
#ifndef SYMPTOMS_H
#define SYMPTOMS_H

#include "labs/submission/lab_pictures.h"
#include "labs/submission/verdict.h"

/* Adds the symptoms to the verdict. `moved`: the outline is wrong. */
void symptoms_describe(const LabPictures *pictures, bool moved, Verdict *verdict);

#endif
