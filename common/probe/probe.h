/*
 * probe: what a pixel of a captured frame is made of, as text: its shaders' values, line by line.
 */
#ifndef PROBE_H
#define PROBE_H

#include "probe/capture.h"

typedef struct ProbeQuestion {
    const Capture *capture;
    int column, row, height; /* of the picture, from its upper left corner */
    unsigned char drawn[4];
    const char *object; /* what is seen there in the exact picture; NULL: unknown */
    float exact[3];     /* its colour there, with `object` */
} ProbeQuestion;

/* For free(); NULL: a shader cannot be run, and why. */
char *probe_text(const ProbeQuestion *question, Message *message);

#endif
