/*
 * hard_cases_sheet: pictures of hard cases, side by side.
 */
#ifndef HARD_CASES_SHEET_H
#define HARD_CASES_SHEET_H

#include "hard_cases_list.h"

#include "image.h"
#include "reference.h"

/* How far a picture lies from the exact one, inside the objects. */
typedef struct HardError {
    double maximum; /* in steps of 1/255 */
    double wrong;   /* the share of the pixels that are more than one step off */
} HardError;

typedef struct HardResult {
    const HardCase *of;
    Image naive, stable;
    Reference exact;
    HardError naive_error, stable_error;
    double cost, noise; /* of a stable frame over a naive one, and of equal frames; 0.01 is 1% */
} HardResult;

/* "+3% (noise 2%)" */
enum { HARD_COST_SIZE = 48 };
void hard_cost_text(const HardResult *result, char text[HARD_COST_SIZE]);

/* A PNG of the results in so many columns, each as naive, stable and exact in panels of this size,
 * with what they are and how far off below. Without text where that cannot be written. */
bool hard_sheet(const HardResult *results, int count, int columns, int width, int height,
                const char *path, Message *message);

#endif
