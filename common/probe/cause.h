/*
 * cause: where in a frame's shaders to look for what changed its picture.
 */
#ifndef CAUSE_H
#define CAUSE_H

#include "probe/capture.h"
#include "probe/place.h"

/* A pixel of the framebuffer, row 0 at its bottom, and by how much its colour has changed. */
typedef struct CausePixel {
    int column, row;
    double change[3];
} CausePixel;

/* An assignment that was executed. */
typedef struct Cause {
    char name[CAPTURE_NAME]; /* of the variable; "": none, as what is seen is the background */
    char place[PLACE_TEXT + 8], line[PLACE_TEXT]; /* "LightedCube.vert:15"; what is there */
    int stage, turn, turns;                       /* turn: of a loop, from 0 on, of so many */
    double alike; /* how its share of the colours looks like the change, 0 to 1 */
} Cause;

/* The first of those whose share looks most like the change; `asked`, which ends with NULL: only of
 * these places; NULL: of all. False: a shader cannot be run, and why. */
bool cause_find(const Capture *capture, const CausePixel *pixels, int count,
                const char *const *asked, Cause *found, Message *message);

#endif
