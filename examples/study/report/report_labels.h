/*
 * report_labels: places labels of points in a plot, so that none covers another or a point.
 */
#ifndef REPORT_LABELS_H
#define REPORT_LABELS_H

#include "scene/quality.h"

/* In pixels, y upwards. */
typedef struct Place {
    double x, y;
} Place;

enum { LABEL_LINES = 3, LABEL_LINE_SIZE = 48 };

typedef struct Label {
    Place point; /* what is labelled */
    char lines[LABEL_LINES][LABEL_LINE_SIZE];
    int line_count;
    Place min, max; /* the box of the text, once it is placed */
    bool placed;    /* there was room */
    bool led;       /* far enough from its point to need a leader line */
} Label;

/* The rest of the plot. */
typedef struct LabelGround {
    Place min, max;             /* the box for labels */
    Place taken_min, taken_max; /* a box that is occupied */
    const Place *path;          /* a polyline, not to be covered */
    int path_count;
    const Place *points; /* better not covered */
    int point_count;
    double letter, line; /* the mean width of a letter, the height of a line */
} LabelGround;

/* A setting in short, in a few lines: "gouraud, divisions 24". */
void label_name(Label *label, const Quality *quality);

/* Places labels, in this order of priority. */
void labels_place(Label *labels, int count, const LabelGround *ground);

#endif
