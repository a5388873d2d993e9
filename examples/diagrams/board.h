/*
 * board: what figures are drawn with: arrows, areas, symbols, and labels that keep out of each
 * other's way.
 */
#ifndef BOARD_H
#define BOARD_H

#include "images/drawing.h"

/* On paper and on a projector these differ from each other and from white by lightness too. */
extern const Vec3 INK, GREY, PALE, LIGHT_COLOR, R_COLOR, V_COLOR, H_COLOR, EDGE_COLOR;
extern const Vec3 BEAM, DIFFUSE_FILL, SPECULAR_FILL; /* of areas */

enum { BOARD_SEGMENTS = 1024 };

typedef struct Board {
    Drawing *drawing;
    double em;       /* the size of text in pixels, which everything else follows */
    DrawingBox area; /* where labels may be */
    /* What labels keep away from; what does not fit is not kept away from. */
    DrawingPoint segments[BOARD_SEGMENTS][2];
    int segment_count;
} Board;

Board board_begin(Drawing *drawing);

/* A point at a distance along a unit vector, whose y is up. */
DrawingPoint board_at(DrawingPoint from, Vec3 direction, double distance);

/* Widths are shares of an em. Lines and arrows keep labels away; a dashed one is thin. */
void board_line(Board *board, DrawingPoint a, DrawingPoint b, Vec3 color, double width);
void board_dashed(Board *board, DrawingPoint a, DrawingPoint b, Vec3 color);
void board_arrow(Board *board, DrawingPoint from, DrawingPoint to, Vec3 color, double width);

/* An arrow's head alone; its line ends four fifths of the way back from the tip. */
void board_arrow_head(Board *board, DrawingPoint tail, DrawingPoint tip, Vec3 color);

/* A filled polygon without an outline. */
void board_area(Board *board, const DrawingPoint *points, int count, Vec3 color, double alpha);

/* Part of a circle between two angles, in degrees to the right of up. */
typedef struct Arc {
    DrawingPoint center;
    double radius, from, to;
} Arc;
void board_arc(Board *board, Arc arc, Vec3 color, double width, double dash);

void board_dot(Board *board, DrawingPoint at, double radius, Vec3 color);

/* A lamp, an eye that looks at a point, and parallel rays along a direction about a point: each
 * within 1.3 em. */
void board_lamp(Board *board, DrawingPoint at);
void board_eye(Board *board, DrawingPoint at, DrawingPoint looks_at);
void board_rays(Board *board, DrawingPoint at, Vec3 direction);

/* A label near a point, preferably in a direction from it (any length, y up; zero: up): where it
 * covers no other label and, if possible, no line. A label that ends up away from its point is
 * connected to it. */
void board_label(Board *board, DrawingPoint anchor, Vec3 direction, Vec3 color, const char *text);

/* Labels keep away from this segment too. */
void board_keep_away(Board *board, DrawingPoint a, DrawingPoint b);

/* A line of text centered on a column, its middle on a row, in a width that it is shrunk to. */
void board_caption(Board *board, double x, double y, double width, const char *text);

/* A colour and a text to its right, whose baseline begins BOARD_SWATCH ems right of `at`.
 * Returns the colour's box. */
#define BOARD_SWATCH 2.3
DrawingBox board_swatch(Board *board, DrawingPoint at, Vec3 color, const char *text);

void board_box(Board *board, DrawingBox box, Vec3 color, bool framed);

/* A number with two decimals and a true minus sign, never a negative zero. */
enum { NUMBER_SIZE = 32 };
const char *board_number(double number, char text[NUMBER_SIZE]);

#endif
