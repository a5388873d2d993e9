/* The normals of a curve at the corners of a polygon, and those of the polygon's sides. */
#include "diagrams/figures.h"

#include <math.h>

static const double THICKNESS = 0.9; /* of the band of colour, in ems */
static const double SPAN = 72;       /* the curve's ends, in degrees from its top */
static const double NORMAL = 0.32;   /* a normal's length, of the radius */

/* A side of the polygon, seen edge-on, and the colour along it. */
typedef struct Side {
    DrawingPoint outer[2], inner[2];
    Vec3 normals[2], colors[2];
} Side;

static DrawingPoint between(const DrawingPoint ends[2], double at)
{
    return (DrawingPoint){ends[0].x + at * (ends[1].x - ends[0].x),
                          ends[0].y + at * (ends[1].y - ends[0].y)};
}

static void draw_side(Board *board, const Side *side)
{
    enum { PIECES = 16 };
    for (int i = 0; i < PIECES; i++) {
        /* Each reaches below the next, so that no gap shows. */
        const double a = (double)i / PIECES, b = fmin((i + 2.0) / PIECES, 1);
        const double middle = (i + 0.5) / PIECES;
        const Vec3 color =
            vec3_add(vec3_scale(side->colors[0], 1 - middle), vec3_scale(side->colors[1], middle));
        board_area(board,
                   (const DrawingPoint[]){between(side->outer, a), between(side->outer, b),
                                          between(side->inner, b), between(side->inner, a)},
                   4, color, 1);
    }
    board_line(board, side->outer[0], side->outer[1], EDGE_COLOR, 0.2);
}

void figure_normals(Board *board, const Optics *optics, int number)
{
    const bool flat = number;
    const char *const captions[] = {flat ? "normals of the polygon: flat shading"
                                         : "normals of the curve: smooth shading",
                                    flat ? "two normals at each corner, one of each side"
                                         : "one normal at each corner, shared by the sides"};
    const int sides = optics->sides;
    const double em = board->em, sine = optics_right(SPAN).x, cosine = optics_right(SPAN).y;
    Optics parallel = *optics;
    parallel.radiating = false;
    DrawingBox part = figure_part(board, flat);
    figure_captions(board, &part, captions[0], captions[1]);
    const double width = part.right - part.left, height = part.bottom - part.top;
    const double radius = fmin((width - 1.5 * em) / (2 * (1 + NORMAL) * sine),
                               (height - 1.8 * em) / (1 + NORMAL - cosine));
    const DrawingPoint center = {(part.left + part.right) / 2,
                                 part.bottom - 0.9 * em + radius * cosine -
                                     (height - 1.8 * em - radius * (1 + NORMAL - cosine)) / 2};
    board->area = part;
    for (int i = 0; i < sides; i++) {
        Side side;
        const double step = 2 * SPAN / sides, middle = -SPAN + (i + 0.5) * step;
        for (int j = 0; j < 2; j++) {
            const Vec3 outward = optics_right(-SPAN + (i + j) * step);
            side.outer[j] = board_at(center, outward, radius);
            /* Along the corner's bisector, as deep below each side. */
            side.inner[j] =
                board_at(side.outer[j], outward, -THICKNESS * em / optics_right(step / 2).y);
            side.normals[j] = flat ? optics_right(middle) : outward;
            side.colors[j] = optics_color(&parallel, (Vec3){0, 0, 0}, side.normals[j]);
        }
        draw_side(board, &side);
        for (int j = 0; j < 2; j++)
            if (flat || j == 0 || i == sides - 1)
                board_arrow(board, side.outer[j],
                            board_at(side.outer[j], side.normals[j], NORMAL * radius), INK, 0.1);
    }
    board_arc(board, (Arc){center, radius, -SPAN, SPAN}, R_COLOR, 0.07, flat ? 0.25 : 0);
    for (int i = 0; i <= sides; i++)
        board_dot(board, board_at(center, optics_right(-SPAN + i * 2 * SPAN / sides), radius), 0.17,
                  EDGE_COLOR);
    const DrawingPoint corner = {part.left + 1.5 * em, part.top + 1.3 * em};
    board_rays(board, corner, vec3_scale(optics_left(optics->light), -1));
    board_label(board, (DrawingPoint){corner.x + 1.1 * em, corner.y}, (Vec3){1, 0, 0}, LIGHT_COLOR,
                "light");
}
