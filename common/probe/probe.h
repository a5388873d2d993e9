/*
 * probe: what a pixel of a captured frame is made of: its shaders' values, line by line.
 */
#ifndef PROBE_H
#define PROBE_H

#include "probe/exact_pixel.h"
#include "probe/place.h"
#include "probe/raster.h"

#include <stdio.h>

typedef struct ProbeQuestion {
    const Capture *capture;
    const GlslArithmetic *driver; /* as which device it is computed */
    int column, row, height;      /* of the picture, from its upper left corner */
    unsigned char drawn[4];
    const ExactPixel *exact; /* NULL: unknown */
} ProbeQuestion;

/* What a run of the fragment's shader assigned, and the colour. */
typedef struct ProbeTrail {
    GlslEvent *events;
    double *values;
    int count;
    double color[4];
} ProbeTrail;

typedef struct Probe {
    ProbeQuestion question;
    Raster *raster;
    RasterPixel pixel;
    ProbeTrail driver, exact; /* none of the background */
    const GlslRun *run;       /* of the fragment's shader, whose inputs are the driver's */
    char *remarks;            /* what is undefined or cannot be known, in lines */
    /* The verdict, in steps of 1/255: the driver's colour against the exact picture; what of that
     * is the formula's, and what is rounding. Without an exact picture, against what the program's
     * own equation gives at the pixel: the formula's is then what interpolating changes. */
    bool judged;
    bool undefined;  /* the colour, so that the driver may draw any */
    bool otherwise;  /* another colour is drawn than is computed */
    double as_drawn; /* how far that is off */
    double picture[4];
    double whole, formula, rounding;
    int birth;        /* the event in which the rounding is born; -1: before the first */
    int magnifier;    /* the event that magnifies it most; -1: none does so twice */
    double magnified; /* so many times */
} Probe;

/* False: a shader cannot be run, and why. */
bool probe_open(Probe *probe, const ProbeQuestion *question, Message *message);
void probe_close(Probe *probe); /* a zeroed one is fine */

/* What the program's own equation gives at the pixel itself, exactly. False: the background, or
 * that is unknown. */
bool probe_exact(const ProbeQuestion *question, double color[4], int *draw);

/* Says which samplers have no texture that can be read: the driver does not tell of all. False:
 * what is computed is not the picture's. */
bool probe_samplers(FILE *file, const CaptureDraw *draw);

/* For free(). */
char *probe_text(const Probe *probe);
char *probe_verdict(const Probe *probe); /* its end: the remarks and the verdict */
char *probe_json(const Probe *probe);

#endif
