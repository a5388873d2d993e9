/*
 * hard_sheet: pictures of hard cases, side by side.
 */
#ifndef HARD_SHEET_H
#define HARD_SHEET_H

#include "images/image_file.h"
#include "reference/reference.h"
#include "study/cases/hard_case.h"

/* The error of a picture inside the objects. */
typedef struct HardError {
    double maximum; /* in steps of 1/255 */
    double wrong;   /* the fraction of pixels off by more than one step */
} HardError;

typedef struct HardResult {
    const HardCase *of;
    Image naive, stable;
    Reference exact;
    HardError naive_error, stable_error;
    size_t naive_worst; /* the pixel with the largest error */
    char *verdict;      /* of a probe there; NULL: not asked for */
    double cost, noise; /* fractions: of a stable frame over a naive one, and A/A */
} HardResult;

/* "+3% (noise 2%)"; without numbers where the noise exceeds the difference, or
 * a quarter. */
enum { HARD_COST_SIZE = 48 };
void hard_cost_text(const HardResult *result, char text[HARD_COST_SIZE]);

/* A PNG of the results in this number of columns, each as plain, stable and exact in panels of this
 * size, with its name above and errors at the right. Without a font it has no text. */
typedef struct HardSheet {
    const HardResult *results;
    int count, columns, width, height;
} HardSheet;
bool hard_sheet(const HardSheet *sheet, const char *path, Message *message);

#endif
