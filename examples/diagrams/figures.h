/*
 * figures: the textbook's pictures of reflection, composed from numbers (optics.h).
 */
#ifndef FIGURES_H
#define FIGURES_H

#include "diagrams/board.h"
#include "diagrams/optics.h"

typedef enum Figure {
    FIGURE_VECTORS,   /* N, L, R, V, H at a point, the highlight's lobe, and the colour */
    FIGURE_LOBE,      /* what a point sends into each direction: diffuse, specular */
    FIGURE_INCIDENCE, /* what a beam lights, straight down and at an angle */
    FIGURE_RAYS,      /* parallel and radiating ones, and N.L where they arrive */
    FIGURE_NORMALS,   /* of a curve, and of the polygon with its corners on it */
    FIGURE_COUNT,
} Figure;

/* Names in that order, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const FIGURE_NAMES[FIGURE_COUNT + 1];

enum { FIGURE_SIDES_MAX = 16 };

/* `sides` are the polygon's, 1 to FIGURE_SIDES_MAX. */
void figure_draw(Figure figure, const Optics *optics, int sides, Drawing *drawing);

void figure_vectors(Board *board, const Optics *optics);
void figure_lobe(Board *board, const Optics *optics);
void figure_incidence(Board *board, const Optics *optics);
void figure_rays(Board *board, const Optics *optics);
void figure_normals(Board *board, const Optics *optics, int sides);

/* Shared by the figures. */

/* "R.V" or "N.H" with the shininess as its power, typeset. */
enum { FIGURE_TEXT = 96 };
void figure_power(const Optics *optics, char text[FIGURE_TEXT]);

/* A surface from left to right at a height, with the colour that each point below `unit` pixels per
 * unit has; `origin` is x = 0. */
void figure_surface(Board *board, const Optics *optics, DrawingPoint origin, double left,
                    double right, double unit);

/* One of two parts of the picture: side by side if it is wide, else one above the other. */
DrawingBox figure_part(const Board *board, int number);

/* A part's caption, in at most `count` lines at its lower end, which are taken off the part. */
void figure_captions(Board *board, DrawingBox *part, const char *const *lines, int count);

#endif
