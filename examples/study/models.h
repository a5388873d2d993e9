/*
 * models: Phong's and Blinn-Phong's reflection, each against its own exact picture, and how far the
 * two lie apart: another model is no error.
 */
#ifndef MODELS_H
#define MODELS_H

#include "survey.h"

#include <stdio.h>

/* Measures both on the study's shiny sphere with some shininesses, Blinn-Phong also with the one
 * that is fitted to Phong's. Prints a table, and writes FOLDER/models.csv. */
bool models_report(Survey *survey, const char *folder, FILE *file, Message *message);

#endif
