/*
 * origin: the assignment of a fragment's shader in which the error of its colour is born.
 */
#ifndef ORIGIN_H
#define ORIGIN_H

#include "probe/raster.h"

/* A channel as a framebuffer keeps it, in steps of 1/255; and how far two colours are apart. */
double origin_step(double channel);
double origin_apart(const double a[4], const double b[4]);

/* Whether a driver may make any colour of the last pixel's run: it is no number, of a variable
 * without a value, or of a loop that does not end. */
bool origin_undefined(const Raster *raster, const GlslRun *run, const double color[4]);

/* The event from which on most of the colour's error is there, of so many; -1: it is there before
 * the first. `exact` is the exact colour. */
int origin_find(Raster *raster, const RasterPixel *pixel, int events, const double exact[4]);

#endif
