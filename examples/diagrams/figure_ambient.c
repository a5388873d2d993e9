/* Ambient light on a round body, alone and with a light: it comes from all directions alike. */
#include "diagrams/figures.h"

#include <stdio.h>

static const Vec3 ORIGIN = {0, 0, 0};

void figure_ambient(Board *board, const Optics *asked, int lit)
{
    enum { RAYS = 16, PIECES = 180 };
    static const double INNER = 0.3, OUTER = 0.45, BEGIN = 0.78;
    char number[3][NUMBER_SIZE], text[2 * FIGURE_TEXT];
    Material matte;
    Optics optics = optics_matte(asked, &matte);
    optics.radiating = false;
    const double em = board->em, away = 180 - optics.light; /* its normal gets no other light */
    const Vec3 l = optics_left(optics.light),
               dark = optics_color(&optics, ORIGIN, optics_right(away));
    DrawingBox part = figure_part(board, lit);
    snprintf(text, sizeof text, "the same everywhere: %s  %s  %s", board_number(dark.x, number[0]),
             board_number(dark.y, number[1]), board_number(dark.z, number[2]));
    figure_captions(board, &part,
                    lit ? "and a light: ambient light alone"
                        : "ambient light, from all directions alike",
                    lit ? "reaches the side away from it" : text);
    const Frame2 frame = figure_fit(part, 0.2 * em, (DrawingBox){-1, 1, 1, -1});
    board->area = part;
    for (int i = 0; i < PIECES; i++) {
        const double from = 360.0 * i / PIECES, to = from + 720.0 / PIECES; /* below the next */
        const Vec3 a = optics_right(from), b = optics_right(to);
        board_area(board,
                   (const DrawingPoint[]){figure_at(frame, vec3_scale(a, INNER)),
                                          figure_at(frame, vec3_scale(a, OUTER)),
                                          figure_at(frame, vec3_scale(b, OUTER)),
                                          figure_at(frame, vec3_scale(b, INNER))},
                   4, lit ? optics_color(&optics, ORIGIN, vec3_unit(vec3_add(a, b))) : dark, 1);
    }
    board_arc(board, (Arc){frame.origin, OUTER * frame.unit, 0, 360}, INK, 0.08, 0);
    for (int i = 0; i < RAYS; i++) {
        const Vec3 out = optics_right(360.0 / RAYS * (i + 0.5));
        board_arrow(board, figure_at(frame, vec3_scale(out, BEGIN)),
                    board_at(frame.origin, out, OUTER * frame.unit + 0.1 * em), GREY, 0.08);
    }
    const DrawingPoint at = board_at(frame.origin, l, frame.unit - em);
    if (lit)
        board_rays(board, at, vec3_scale(l, -1));
    if (lit)
        board_label(board, at, l, LIGHT_COLOR, "light");
}
