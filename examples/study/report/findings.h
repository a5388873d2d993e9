/*
 * findings: plots and tables of the rows that answer one question each.
 */
#ifndef FINDINGS_H
#define FINDINGS_H

#include "study/results/results.h"

#include <stdio.h>

/* Into the folder, as FOLDER/finding-NAME.svg and .png:
 *   interpolation  Gouraud's and Phong's error over time as divisions grow
 *   precision      the error of mediump, scene by scene
 *   guards         the time of guards
 *   viewer         the error of a viewer at infinity
 *   antialiasing   the error of all pixels over time
 *   matrices       the error of arithmetic and order, far from the origin
 * Missing rows are left out, and empty plots. False if gnuplot is missing; the message names the
 * package. */
bool findings_plot(const Results *results, const char *folder, Message *message);

/* A table: the time of composing the matrices of one object and the position of one light, in each
 * arithmetic and order, and the error of the scene far from the origin. False: no memory. */
void findings_matrices(const Results *results, bool markdown, FILE *file);

/* The numbers of these plots as Markdown tables. False: no memory. */
void findings_tables(const Results *results, FILE *file);

#endif
