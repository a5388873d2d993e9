/*
 * drawing_list: what a drawing holds: paths, each with its style and steps, and where its texts
 * are.
 */
#ifndef DRAWING_LIST_H
#define DRAWING_LIST_H

#include "base/image.h"
#include "base/plugin.h"
#include "core/matrix.h"
#include "images/font.h"

#include <stdio.h>

typedef struct DrawingPoint {
    double x, y;
} DrawingPoint;

/* With the number of points that each takes: 1, 1, 3 (two controls of a Bezier curve and its end),
 * 0. */
typedef enum DrawingStep { DRAWING_MOVE, DRAWING_LINE, DRAWING_CURVE, DRAWING_CLOSE } DrawingStep;

/* How a path is drawn: filled, then stroked with round ends and joints. */
typedef struct DrawingStyle {
    Vec3 fill, stroke;
    double fill_alpha; /* 0: not filled */
    double width;      /* of the stroke; 0: none */
    double dash;       /* the length of dashes and of the gaps between them; 0: a whole line */
} DrawingStyle;

typedef struct DrawingPath {
    DrawingStyle style;
    int first_step, step_count, first_point;
} DrawingPath;

typedef struct DrawingBox {
    double left, top, right, bottom;
} DrawingBox;

enum { DRAWING_TEXT_SIZE = 64 };

/* A text and where its ink lies. */
typedef struct DrawingLabel {
    DrawingBox box;
    char text[DRAWING_TEXT_SIZE];
} DrawingLabel;

typedef struct Drawing {
    double width, height;
    Font upright, italic;
    DrawingStep *steps;
    DrawingPoint *points;
    DrawingPath *paths;
    DrawingLabel *labels;
    int step_count, point_count, path_count, label_count;
    int step_room, point_room, path_room, label_room;
} Drawing;

/* The plugin that links cairo (drawing_cairo.c), as drawing.c calls it. */

/* The variable `drawing_plugin`. Functions return NULL, or why they failed. */
typedef struct DrawingPlugin {
    PluginVersion *version;
    const char *(*paint)(const Drawing *drawing, Image *image, bool transparent);
    const char *(*encode)(const Drawing *drawing, const char *format, bool transparent, FILE *to);
} DrawingPlugin;

#endif
