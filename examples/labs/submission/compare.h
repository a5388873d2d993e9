/*
 * compare: a drawn picture against the exact one, and against another drawn one. No GL.
 *
 * Errors are as in reference/picture_error.h.
 */
#ifndef COMPARE_H
#define COMPARE_H

#include "reference/picture_error.h"
#include "reference/reference.h"

/* The largest error of a correct picture. Rounding to bytes adds 0.5, 32-bit arithmetic far less;
 * two ways to write the same formula differ by at most 1, and Blinn-Phong with the fitted exponent
 * and with four times Phong's by 1.9 (see scene.c). Every visible mistake of the catalogue causes
 * at least 4. */
#define COMPARE_TOLERANCE 2.5

/* Over the pixels inside an object and over background pixels without an object next to them.
 * `mask`: the exact picture of the meshes as drawn; NULL if they are the shapes. Pixels where the
 * two have different outlines do not count, unless they are more than two pixels inside the exact
 * one. */
ErrorSum compare_exact(const Image *image, const Reference *exact, const Reference *mask);

/* The difference of two drawn pictures of one size. */
typedef struct Likeness {
    double maximum; /* of the pixels compared */
    int pixels;     /* not black in both */
    int differing;  /* by more than the tolerance */
    double squares; /* of what differs by more than the one step of rounding */
} Likeness;

/* A pixel at an edge, of a shape or of light, may be like a neighbor of the same place in the other
 * picture instead: two programs may round a vertex differently. `soft`: or between two pixels
 * within two of it, because one of them may smooth its edges, of which `squares` has none. Stops
 * once more than `max` pixels differ. */
Likeness compare_drawn(const Image *a, const Image *b, double tolerance, int max, bool soft);

#endif
