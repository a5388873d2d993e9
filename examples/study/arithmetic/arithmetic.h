/*
 * arithmetic: all that is measured of a driver's arithmetic.
 */
#ifndef ARITHMETIC_H
#define ARITHMETIC_H

#include "study/arithmetic/raster.h"

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

#endif
