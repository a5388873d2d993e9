/*
 * report: measurements as tables, plots and sheets of pictures.
 */
#ifndef REPORT_H
#define REPORT_H

#include "images/image_file.h"
#include "reference/reference.h"
#include "study/results/results.h"

#include <limits.h>
#include <stdio.h>

/* A table of a scene's latest rows, sorted by time, with efficient and tied settings marked, unless
 * the machine was busy. `only_efficient`: only those; all where none is marked. */
bool report_table(const Results *results, const char *scene, bool only_efficient, FILE *file,
                  Message *message);

/* The efficient rows of a scene whose pictures its plot shows, the cheapest first: both ends, and
 * others far from each other. `rows` belong to `results`. */
enum { REPORT_PINS = 5 };
typedef struct ReportPins {
    const ResultRow *rows[REPORT_PINS];
    int count;
} ReportPins;
bool report_pins(ReportPins *pins, const Results *results, const char *scene, Message *message);

/* The file of a pin's picture, which report_pair writes: FOLDER/SCENE-pin-NUMBER.png */
void report_pin_path(const char *folder, const char *scene, int pin, char path[PATH_MAX]);

/* FOLDER/SCENE.svg and .png, by gnuplot: the largest error inside objects over time on logarithmic
 * axes, a point per row, coloured by interpolation, the efficient ones joined, and those with pins
 * joined to what they are and to their pictures, as far as these files exist. Errors
 * below 0.01 are drawn at 0.01, and the axis says so. False if gnuplot is missing; the message
 * names the package. The folder must exist. */
bool report_plot(const Results *results, const char *scene, const char *title, const char *folder,
                 Message *message);

/* The same for curves, named series of points. On a logarithmic axis values up to 0 are drawn at
 * the lower end, and its label says so. */
typedef struct ReportSeries {
    const char *name;
    const double *x, *y; /* NAN: left out */
    int count;
} ReportSeries;
typedef struct ReportAxes {
    const char *title, *x, *y; /* labels with units */
    bool log_x, log_y;
    const char *foot; /* a small footer; NULL: none */
    bool doubling_x;  /* its tics are powers of two */
} ReportAxes;
bool report_curves(const ReportAxes *axes, const ReportSeries *series, int count,
                   const char *folder, const char *name, Message *message);

/* Puts a picture into a rectangle (x, y, width, height) of a larger one, both of bytes: each pixel
 * is the mean of samples in it. */
void report_panel(Image *sheet, const int place[4], const Image *picture);

/* A PNG of three labelled pictures: drawn, exact, and their difference in false colour with a scale
 * in steps of 1/255. `drawn` is a byte or float image of the reference's size. The difference is
 * the largest |drawn - exact| of the three channels: grey up to half a step (rounding), then on a
 * logarithmic scale; magenta if it is NaN. `caption` is wrapped below. Small pictures are enlarged.
 * Without a font the sheet has no text. */
bool report_sheet(const Image *drawn, const Reference *exact, const char *caption, const char *path,
                  Message *message);

/* A PNG of two small pictures side by side, drawn and difference as in report_sheet: twice
 * REPORT_PANEL pixels wide, with REPORT_GAP between them. */
enum { REPORT_PANEL = 240, REPORT_GAP = 8 };
bool report_pair(const Image *drawn, const Reference *exact, const char *path, Message *message);

#endif
