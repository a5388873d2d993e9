/* Diffuse reflection, the same in every direction, and specular reflection, a cone about R. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

static const Vec3 UP = {0, 1, 0}, ORIGIN = {0, 0, 0};

typedef struct Half {
    bool specular;
    DrawingPoint origin;
    double unit;
} Half;

static double radius_at(const Optics *optics, const OpticsVectors *at, bool specular, double eye)
{
    return specular ? optics_lobe(optics, eye) : fmax(at->n_dot_l, 0);
}

/* The outline, and rays to it. */
static void draw_fan(Board *board, const Optics *optics, const OpticsVectors *at, Half half)
{
    enum { STEPS = 360, RAYS = 25 };
    const double shortest = 0.9 * board->em;
    const Vec3 color = half.specular ? R_COLOR : LIGHT_COLOR;
    if (at->n_dot_l <= 0)
        return;
    drawing_path(board->drawing,
                 (DrawingStyle){.fill = half.specular ? SPECULAR_FILL : DIFFUSE_FILL,
                                .fill_alpha = 0.3,
                                .stroke = color,
                                .width = 0.05 * board->em});
    drawing_move(board->drawing, half.origin);
    for (int i = 0; i <= STEPS; i++) {
        const double eye = -90 + 180.0 * i / STEPS;
        drawing_line(board->drawing,
                     board_at(half.origin, optics_right(eye),
                              half.unit * radius_at(optics, at, half.specular, eye)));
    }
    drawing_close_path(board->drawing);
    for (int i = 1; i < RAYS - 1; i++) {
        const double eye = -90 + 180.0 * i / (RAYS - 1);
        const double length = half.unit * radius_at(optics, at, half.specular, eye);
        if (length > shortest)
            board_arrow(board, half.origin, board_at(half.origin, optics_right(eye), length), color,
                        0.06);
    }
}

static void draw_cone(Board *board, const Optics *optics, const OpticsVectors *at, Half half)
{
    const double half_angle = optics_half_angle(optics);
    for (int side = -1; side <= 1 && half_angle < 90; side += 2) {
        const double eye = optics->light + side * half_angle;
        if (fabs(eye) <= 90)
            board_dashed(board, half.origin, board_at(half.origin, optics_right(eye), half.unit),
                         GREY);
    }
    board_arrow(board, half.origin, board_at(half.origin, at->r, half.unit), R_COLOR, 0.12);
    board_label(board, board_at(half.origin, at->r, half.unit), at->r, R_COLOR, "$R$");
}

static void write_captions(Board *board, const Optics *optics, const OpticsVectors *at,
                           bool specular, DrawingBox *part)
{
    char power[FIGURE_TEXT], first[2 * FIGURE_TEXT], second[FIGURE_TEXT], number[NUMBER_SIZE];
    const double degrees = optics_half_angle(optics);
    figure_power(optics, power);
    if (at->n_dot_l <= 0) {
        snprintf(first, sizeof first, "%s", specular ? "specular: none" : "diffuse: none");
        snprintf(second, sizeof second, "$N·L$ = %s, the light is behind",
                 board_number(at->n_dot_l, number));
    } else if (specular) {
        snprintf(first, sizeof first, "specular: %s = %s towards $V$", power,
                 board_number(at->highlight, number));
        snprintf(second, sizeof second, "half as much %.1f° from $R$", degrees);
        if (degrees > 90)
            snprintf(second, sizeof second, "at least half as much everywhere");
    } else {
        snprintf(first, sizeof first, "diffuse: $N·L$ = %s", board_number(at->n_dot_l, number));
        snprintf(second, sizeof second, "the same in every direction");
    }
    figure_captions(board, part, first, second);
}

void figure_lobe(Board *board, const Optics *optics, int number)
{
    const bool specular = number;
    const OpticsVectors at = optics_vectors(optics, ORIGIN, UP);
    const double em = board->em;
    DrawingBox part = figure_part(board, specular);
    write_captions(board, optics, &at, specular, &part);
    const double top = 1.5 * em, below = 1.2 * em, depth = fmax(0, -at.l.y);
    const double width = part.right - part.left, height = part.bottom - part.top;
    const double unit = fmin(width / 2 - 1.4 * em, (height - top - below) / (1 + depth));
    const Half half = {specular,
                       {(part.left + part.right) / 2,
                        part.top + top + unit + (height - top - below - (1 + depth) * unit) / 2},
                       unit};
    const double side = fmin(1.2 * unit + em, width / 2);
    board->area = part;
    figure_surface(board, optics, half.origin, half.origin.x - side, half.origin.x + side, unit);
    draw_fan(board, optics, &at, half);
    board_arrow(board, board_at(half.origin, at.l, unit), half.origin, LIGHT_COLOR, 0.18);
    board_arrow(board, half.origin, board_at(half.origin, at.v, unit), V_COLOR, 0.12);
    board_label(board, board_at(half.origin, at.v, unit), at.v, V_COLOR, "$V$");
    board_label(board, board_at(half.origin, at.l, unit), at.l, LIGHT_COLOR, "light");
    if (specular && at.n_dot_l > 0)
        draw_cone(board, optics, &at, half);
}
