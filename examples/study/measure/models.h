/*
 * models: Phong's and Blinn-Phong's reflection, each against its own exact picture, and the
 * difference of the two. Blinn-Phong is another model, not an error of Phong's.
 */
#ifndef MODELS_H
#define MODELS_H

#include "study/measure/survey.h"

#include <stdio.h>

/* The largest distances from Phong's exact picture, over all exponents, in steps of 1/255. */
typedef struct ModelsApart {
    double same[2], fitted[2]; /* least and most; of the same and of the fitted exponent */
} ModelsApart;

/* Measures both on the study's shiny sphere for some exponents, Blinn-Phong also with the exponent
 * fitted to Phong's. Prints a table and writes FOLDER/models.csv. */
bool models_report(Survey *survey, const char *folder, bool markdown, FILE *file,
                   ModelsApart *apart, Message *message);

#endif
