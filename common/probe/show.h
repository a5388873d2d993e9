/*
 * show: any value of a captured frame's shaders over the whole picture, as the driver computes it;
 * how far that is from the exact colour, and which value or line causes it.
 */
#ifndef SHOW_H
#define SHOW_H

#include "base/image.h"
#include "glsl/glsl_run.h"
#include "probe/capture.h"
#include "probe/place.h"

#include <stdio.h>

/* A pixel: `count` numbers, 0 if nothing has the value there; with SHOW_BLAME, a place. */
typedef struct ShowPixel {
    signed char count;
    union {
        float values[4];
        struct {
            int draw;
            GlslPlace place; /* of its fragment shader; line 0: the vertex shader, -1: nothing to
                                blame, -2: undefined */
        };
    };
} ShowPixel;

/* The value's own numbers; the colour; of its error in steps of 1/255 red, green and blue; places.
 */
typedef enum ShowKind { SHOW_VALUE, SHOW_COLOR, SHOW_ERROR, SHOW_BLAME } ShowKind;

extern const double SHOW_LEAST; /* the least error that is shown and blamed, in steps of 1/255 */

typedef struct Show {
    const Capture *capture; /* has to live as long */
    ShowKind kind;
    const char *what;
    int width, height;
    int color_bits;    /* as the driver has it (GlslArithmetic) */
    ShowPixel *pixels; /* row 0 is the picture's top */
    bool stopped;      /* a loop does not end */
    bool unknown; /* why it failed: no shader has the value; the message lists those there are */
} Show;

/* `what` is a variable's name, with a component as in "N.x"; "error", the driver's colour less the
 * exact one of the same text; "error:NAME", what of that the assignments of a variable of the
 * fragment shader cause, or a varying; "blame", the line in which most of it is born; NULL, the
 * picture as the driver computes it, which must not blend or use a stencil. What all assignments
 * cause, and the vertex shader, adds up to error. */
bool show_open(Show *show, const Capture *capture, const GlslArithmetic *driver, const char *what,
               const int size[2], Message *message);
/* The names of a stage's variables, one a line. False: a shader cannot be run, and why. */
bool show_names(const Capture *capture, const GlslArithmetic *driver, int stage, FILE *file,
                Message *message);

void show_close(Show *show); /* a zeroed one is fine */

/* Into a picture of bytes of the same size; writes what the colours mean, in lines. */
void show_paint(const Show *show, Image *picture, FILE *legend);

#endif
