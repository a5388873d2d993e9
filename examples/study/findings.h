/*
 * findings: what the rows say about one question each: plots, and the times of composing matrices.
 */
#ifndef FINDINGS_H
#define FINDINGS_H

#include "results.h"

#include <stdio.h>

/* Into the folder, as FOLDER/finding-NAME.svg and .png:
 *   interpolation  Gouraud's and Phong's error over time as divisions grow
 *   precision      the error of mediump, scene by scene
 *   guards         the time of guards
 *   viewer         the error of a viewer at infinity
 *   antialiasing   the error of all pixels over time
 *   matrices       the error of arithmetic and order, far from the origin
 * Rows that are missing are left out, and a plot that would be empty. False, with one line that
 * names the package, where gnuplot is missing. */
bool findings_plot(const Results *results, const char *folder, Message *message);

/* What composing the matrices of one object and the place of one light takes in each arithmetic and
 * order, in nanoseconds, and the error of the scene that is far from the origin: a table. */
void findings_matrices(const Results *results, FILE *file);

#endif
