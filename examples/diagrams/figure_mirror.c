/* A mirror: which of three eyes sees one ray. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

static const char *sign(double angle)
{
    return angle < 0 ? "−" : "";
}

/* An eye at an angle, its way to the origin, and the angle. */
static void draw_eye(Board *board, Frame2 frame, double angle, bool sees)
{
    char text[FIGURE_TEXT];
    const Vec3 towards = optics_right(angle);
    const DrawingPoint at = figure_at(frame, towards);
    const DrawingPoint before = board_at(at, towards, -0.9 * board->em);
    if (sees)
        board_arrow(board, frame.origin, before, R_COLOR, 0.13);
    else
        board_dashed(board, frame.origin, before, GREY);
    board_eye(board, at, frame.origin);
    snprintf(text, sizeof text, "%s%.4g°%s", sign(angle), fabs(angle), sees ? ": light" : ": none");
    board_label(board, board_at(at, towards, 0.5 * board->em), towards, sees ? R_COLOR : GREY,
                text);
}

void figure_mirror(Board *board, const Optics *optics, int number)
{
    char text[FIGURE_TEXT] = "the light is behind: no eye sees it";
    const double mirrored = optics->light, apart = fabs(optics->eye - mirrored);
    const Vec3 l = optics_left(mirrored), n_tip = {0, 0.7, 0};
    Optics parallel = *optics;
    DrawingBox part = board->area, units = {-1, 1, 1, 0};
    (void)number;
    parallel.radiating = false;
    if (l.y > 0)
        snprintf(text, sizeof text, "only the eye at %s%.4g° is where $R$ goes, and sees the light",
                 sign(mirrored), fabs(mirrored));
    figure_captions(board, &part, "a mirror sends a ray into one direction, $R$, at an equal angle",
                    text);
    board->area = part;
    part.top += 1.3 * board->em; /* for the label of an eye at the top */
    figure_cover(&units, l);
    const Frame2 frame = figure_fit(part, 1.6 * board->em, units);
    figure_surface(board, &parallel, frame.origin, frame.origin.x - frame.unit,
                   frame.origin.x + frame.unit, frame.unit);
    board_arrow(board, figure_at(frame, l), frame.origin, LIGHT_COLOR, 0.2);
    board_dashed(board, frame.origin, figure_at(frame, n_tip), INK);
    if (l.y > 0)
        draw_eye(board, frame, mirrored, true);
    /* Two more, as far from R on each side, where they do not cover it. */
    const bool clear =
        frame.unit * vec3_length(vec3_subtract(optics_right(apart), optics_right(0))) >
        1.9 * board->em;
    for (int side = -1; side <= 1 && clear; side += 2)
        if (fabs(mirrored + side * apart) <= 90)
            draw_eye(board, frame, mirrored + side * apart, false);
    board_label(board, figure_at(frame, n_tip), (Vec3){0, 1, 0}, INK, "$N$");
    /* Beside the ray, as an eye may be where it begins. */
    board_label(board, figure_at(frame, vec3_scale(l, 0.8)), (Vec3){-l.y, l.x, 0}, LIGHT_COLOR,
                "light");
    if (l.y > 0) {
        figure_angle(board, frame, (Vec3[]){l, n_tip}, 0.3, "$θ$", LIGHT_COLOR);
        figure_angle(board, frame, (Vec3[]){n_tip, optics_right(mirrored)}, 0.3, "$θ$",
                     LIGHT_COLOR);
    }
}
