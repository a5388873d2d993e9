/*
 * exact_pixel: what a scene knows of one of its pixels, exactly.
 */
#ifndef EXACT_PIXEL_H
#define EXACT_PIXEL_H

/* A unit vector of the lighting equation: "N", "V", and of light i "L0", "R0" or "H0". */
typedef struct ExactDirection {
    char name[8];
    double vector[3]; /* of the world's axes */
    double to[2];     /* where it ends, begun at the pixel, in columns and rows of the picture */
} ExactDirection;

enum { EXACT_DIRECTIONS = 18 }; /* of more lights the first are kept */

typedef struct ExactPixel {
    float color[3]; /* as a framebuffer without rounding has it */
    char object[64];
    char *equation; /* the sum of light, term by term, in lines; NULL: no surface */
    char *terms;    /* the same as JSON; both for free() */
    ExactDirection directions[EXACT_DIRECTIONS];
    int direction_count;
} ExactPixel;

#endif
