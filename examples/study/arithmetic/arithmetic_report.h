/*
 * arithmetic_report: measured arithmetic as text, JSON and a plot.
 */
#ifndef ARITHMETIC_REPORT_H
#define ARITHMETIC_REPORT_H

#include "study/arithmetic/arithmetic.h"

#include <stdio.h>

/* What the largest errors in pictures can be, by class of scene. */
enum { FORECAST_SCENES = 8, FORECAST_SHININESSES = 3 };
typedef struct Forecast {
    int height;                          /* of the pictures, in pixels */
    const char *scenes[FORECAST_SCENES]; /* what it is */
    double steps[FORECAST_SCENES][2];    /* in highp and in mediump; in steps of 1/255 */
    double shininess[FORECAST_SHININESSES], power[FORECAST_SHININESSES][2]; /* of pow alone */
} Forecast;
bool forecast_make(const Arithmetics *found, int height, Forecast *forecast, Message *message);

/* Tables of some fifty lines, or of Markdown. */
void arithmetic_text(const Arithmetics *found, const Forecast *forecast, bool markdown, FILE *file);

/* One object. */
void arithmetic_json(const Arithmetics *found, const Forecast *forecast, FILE *file);

/* FOLDER/precision.svg and .png: the largest error of some functions by the size of what they get.
 * False if gnuplot is missing. */
bool arithmetic_plot(const Arithmetics *found, const char *folder, Message *message);

#endif
