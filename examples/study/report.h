/*
 * report: what was measured, for people: tables, plots and sheets of pictures.
 */
#ifndef REPORT_H
#define REPORT_H

#include "front.h"
#include "image.h"
#include "reference.h"

#include <stdio.h>

/* An aligned table of the rows of one scene, the efficient settings marked, ties said. Sorted by
 * time. `only_efficient`: no others. */
bool report_table(const Results *results, const char *scene, ErrorKind kind, bool only_efficient,
                  FILE *file, Message *message);

/* DIR/SCENE.svg and DIR/SCENE.png: error over time on logarithmic axes, one point for each row,
 * those of one interpolation in one colour, the efficient ones joined and named. Drawn by gnuplot.
 * False, with one line that names the package, where that is missing. */
bool report_plot(const Results *results, const char *scene, const char *title, ErrorKind kind,
                 const char *folder, Message *message);

/* The same for curves: any number of named series of points, as the README's plots need them. */
typedef struct ReportSeries {
    const char *name;
    const double *x, *y; /* NAN: left out */
    int count;
} ReportSeries;
typedef struct ReportAxes {
    const char *title, *x, *y; /* labels with units */
    bool log_x, log_y;
} ReportAxes;
bool report_curves(const ReportAxes *axes, const ReportSeries *series, int count,
                   const char *folder, const char *name, Message *message);

/* A PNG of three pictures side by side: drawn, exact, and their difference in false colour with a
 * scale in steps of 1/255, labelled; `drawn` is a byte or float image of the reference's size. The
 * difference is |drawn - exact|, the largest of the three channels. `caption`: a line below. */
bool report_sheet(const Image *drawn, const Reference *exact, const char *caption, const char *path,
                  Message *message);

#endif
