/*
 * figures: the textbook's pictures of reflection, composed from numbers (optics.h).
 */
#ifndef FIGURES_H
#define FIGURES_H

#include "diagrams/board.h"
#include "diagrams/optics.h"

/* Each with the number of its parts, which are drawn one after the other. */
#define FIGURES(X)                                                                                 \
    X(VECTORS, vectors, 1)     /* N, L, R, V, H at a point, the highlight's lobe, the colour */    \
    X(LOBE, lobe, 2)           /* what a point sends into each direction: diffuse, specular */     \
    X(INCIDENCE, incidence, 2) /* what a beam lights, straight down and at an angle */             \
    X(RAYS, rays, 2)           /* parallel and radiating ones, and N.L where they arrive */        \
    X(NORMALS, normals, 2)     /* of a curve, and of the polygon with its corners on it */         \
    X(MIRROR, mirror, 1)       /* which of three eyes sees a ray */                                \
    X(WINDING, winding, 2)     /* both orders of a polygon's corners, both unit normals */         \
    X(SPACES, spaces, 2)       /* the same scene in world and in eye coordinates */                \
    X(AMBIENT, ambient, 2)     /* light from all directions, alone and with another */             \
    X(ATTENUATION, attenuation, 1)   /* what is left of a lamp's light at a distance */            \
    X(REFLECTIVITY, reflectivity, 1) /* what becomes of the light of each colour channel */

#define X(NAME, name, parts) FIGURE_##NAME,
typedef enum Figure { FIGURES(X) FIGURE_COUNT } Figure;
#undef X

/* Names in that order, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const FIGURE_NAMES[FIGURE_COUNT + 1];

void figure_draw(Figure figure, const Optics *optics, Drawing *drawing);

/* One part of each, from 0 on. */
#define X(NAME, name, parts) void figure_##name(Board *board, const Optics *optics, int number);
FIGURES(X)
#undef X

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

/* The pixels of (0, 0), and of a unit. */
typedef struct Frame2 {
    DrawingPoint origin;
    double unit;
} Frame2;

/* The largest in which a box of units, whose y is up, fits a part with a margin in pixels. */
Frame2 figure_fit(DrawingBox part, double margin, DrawingBox units);
void figure_cover(DrawingBox *units, Vec3 point); /* enlarges the box to have a point */
DrawingPoint figure_at(Frame2 frame, Vec3 point);

/* The arc between two vectors, with its name; none where they nearly lie on one line. */
void figure_angle(Board *board, Frame2 frame, const Vec3 sides[2], double radius, const char *name,
                  Vec3 color);

/* Two lines at a part's lower end, which are taken off the part. */
void figure_captions(Board *board, DrawingBox *part, const char *first, const char *second);

#endif
