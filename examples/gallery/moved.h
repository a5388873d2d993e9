/*
 * moved: which pixels that changed between two pictures can have by rounding alone.
 */
#ifndef MOVED_H
#define MOVED_H

#include "base/image.h"
#include "probe/cause.h"
#include "study/arithmetic/proof.h"

typedef enum MovedKind {
    MOVED_NOT,
    MOVED_ROUNDING,
    MOVED_EDGE,
    MOVED_WRONG,
    MOVED_UNKNOWN, /* no shader draws it */
    MOVED_KINDS
} MovedKind;

typedef struct MovedQuestion {
    const Proof *proof;        /* of what draws it now */
    const Image *before, *now; /* of bytes and of the same size */
    int scale;                 /* pixels of the framebuffer to one of the picture, each way */
    bool samples;              /* a pixel of either is made of several */
    const char *const *asked;  /* see cause_find */
} MovedQuestion;

typedef struct Moved {
    int counts[MOVED_KINDS];
    double most; /* the largest change, in steps */
    char *kinds; /* of each pixel, a MovedKind; for free() */
    Cause cause; /* of those that are wrong */
} Moved;

/* A pixel is by rounding, if both its colours are within what is proved for the surface that it
 * shows; at an edge, if they are between those of the surfaces that meet there, or a line or point
 * is drawn there. False: that cannot be said, and why. */
bool moved_judge(Moved *moved, const MovedQuestion *question, Message *message);

#endif
