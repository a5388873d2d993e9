/*
 * report: what was measured, for people: tables, plots and sheets of pictures.
 */
#ifndef REPORT_H
#define REPORT_H

#include "front.h"
#include "image.h"
#include "reference.h"

#include <stdio.h>

/* An aligned table of the rows of one scene, the latest of each setting, the efficient settings
 * marked, and the tied. Sorted by time. `only_efficient`: only those. */
bool report_table(const Results *results, const char *scene, ErrorKind kind, bool only_efficient,
                  FILE *file, Message *message);

/* DIR/SCENE.svg and DIR/SCENE.png: error over time on logarithmic axes, one point for each row,
 * those of one interpolation in one colour, the efficient ones joined and, as far as there is
 * room, named. Errors below 0.01 are drawn there, and the axis says so. Drawn by gnuplot. False,
 * with one line that names the package, where that is missing. The folder is there. */
bool report_plot(const Results *results, const char *scene, const char *title, ErrorKind kind,
                 const char *folder, Message *message);

/* The same for curves: any number of named series of points. On a logarithmic axis 0 and less are
 * drawn at the lower end, and its label says so. */
typedef struct ReportSeries {
    const char *name;
    const double *x, *y; /* NAN: left out */
    int count;
} ReportSeries;
typedef struct ReportAxes {
    const char *title, *x, *y; /* labels with units */
    bool log_x, log_y;
    const char *foot; /* a line in small letters at the foot; NULL: none */
} ReportAxes;
bool report_curves(const ReportAxes *axes, const ReportSeries *series, int count,
                   const char *folder, const char *name, Message *message);

/* A PNG of three pictures side by side: drawn, exact, and their difference in false colour with a
 * scale in steps of 1/255, labelled; `drawn` is a byte or float image of the reference's size. The
 * difference is |drawn - exact|, the largest of the three channels; up to half a step, which
 * rounding makes, it is grey, then on a logarithmic scale; magenta where it is no number. `caption`
 * is written below, broken into lines. Small pictures are enlarged. Where there is no OpenImageIO
 * or no font, the sheet has no text. */
bool report_sheet(const Image *drawn, const Reference *exact, const char *caption, const char *path,
                  Message *message);

#endif
