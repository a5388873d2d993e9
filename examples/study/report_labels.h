/*
 * report_labels: where the names of points go in a plot, so that none covers another or a point.
 */
#ifndef REPORT_LABELS_H
#define REPORT_LABELS_H

#include "setting.h"

/* In pixels, y upwards. */
typedef struct Place {
    double x, y;
} Place;

enum { LABEL_LINES = 3, LABEL_LINE_SIZE = 48 };

typedef struct Label {
    Place point; /* what is named */
    char lines[LABEL_LINES][LABEL_LINE_SIZE];
    int line_count;
    Place least, most; /* the box of the text, once it is placed */
    bool placed;       /* there was room */
    bool led;          /* far enough away to need a line to its point */
} Label;

/* What there is in the plot besides. */
typedef struct LabelGround {
    Place least, most;             /* the box within which labels may be */
    Place taken_least, taken_most; /* and one that is not free */
    const Place *path;             /* joined by a line, and not to be covered */
    int path_count;
    const Place *points; /* better not covered */
    int point_count;
    double letter, line; /* the mean width of a letter, the height of a line */
} LabelGround;

/* The text of a setting in short, over few lines: "gouraud, divisions 24". */
void label_name(Label *label, const Setting *setting);

/* Finds places for labels, the first ones first. */
void labels_place(Label *labels, int count, const LabelGround *ground);

#endif
