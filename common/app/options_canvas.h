/*
 * options_canvas: the canvas that a command line asks for.
 */
#ifndef OPTIONS_CANVAS_H
#define OPTIONS_CANVAS_H

#include "app/options.h"

/* With float colours if the format of `output` stores them. With --verbose describes it on standard
 * error. */
bool options_open_canvas(Canvas *canvas, const Options *options, const char *output,
                         Message *message);

#endif
