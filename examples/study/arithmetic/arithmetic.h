/*
 * arithmetic: all that is measured of a driver's arithmetic, what it can make of a picture, and
 * both as text, JSON and a plot.
 */
#ifndef ARITHMETIC_H
#define ARITHMETIC_H

#include "scene/scene.h"
#include "study/arithmetic/raster.h"

#include <stdio.h>

/* Of one precision in one stage. */
typedef struct Arithmetic {
    Format format;
    Claim claim;
    Accuracy accuracies[FUNCTION_COUNT];
} Arithmetic;

typedef struct Arithmetics {
    char renderer[128], version[128];
    Arithmetic of[METER_STAGES][METER_PRECISIONS];
    Raster raster;
    long inputs; /* of each function, unless that is more than there are */
    double seconds;
} Arithmetics;

/* All. `inputs`: of each function; 0: 2^24, or fewer where that would take more than a minute.
 * Draws a progress bar. */
bool arithmetic_measure(const Meter *meter, long inputs, Arithmetics *found, Message *message);

/* "fragment shaders compute with 24 bits in highp, 11 in mediump, 11 in lowp; vertex shaders..." */
enum { ARITHMETIC_LINE = 160 };
void arithmetic_line(const Arithmetics *found, char line[ARITHMETIC_LINE]);

/* The largest error that measured arithmetic can make in the picture of a scene. No GL. The
 * lighting equation is computed with intervals: of every intermediate result all values that the
 * shader may have there, from its inputs and the largest measured error of each operation. An
 * optimizer that computes something more exactly, or in another order, stays within them.
 */

/* In steps of 1/255, against the exact picture of the meshes as given, inside objects: at least the
 * half step of rounding, at most 255. `height`: of the picture, in pixels. `fragment`: of the
 * precision that its fragment shader declares. The scene has passed scene_check, and its objects
 * have meshes. Shadows are left out. It is sampled at the corners of the triangles and between, at
 * 5000 points and more. */
double predict_scene(const Scene *scene, int height, const Arithmetic *vertex,
                     const Arithmetic *fragment, const Raster *raster);

/* What of that the power function alone adds to a highlight of this shininess, as bright as can be.
 */
double predict_pow(const Arithmetic *fragment, double shininess);

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
