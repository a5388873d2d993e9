/* What a beam lights, and parallel and radiating rays. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

static const Vec3 UP = {0, 1, 0}, ORIGIN = {0, 0, 0};

/* Room below the surface for light that comes from there, in ems. */
static double depth_for(double n_dot_l)
{
    return n_dot_l < 0 ? 4 : 0;
}

/* A line between two ends with a name beside it. */
static void dimension(Board *board, DrawingPoint a, DrawingPoint b, Vec3 side, const char *text)
{
    const double length = hypot(b.x - a.x, b.y - a.y), tick = 0.3 * board->em;
    const Vec3 across = {(b.y - a.y) / length, (b.x - a.x) / length, 0};
    board_line(board, a, b, INK, 0.06);
    board_line(board, board_at(a, across, -tick), board_at(a, across, tick), INK, 0.06);
    board_line(board, board_at(b, across, -tick), board_at(b, across, tick), INK, 0.06);
    board_label(board, (DrawingPoint){(a.x + b.x) / 2, (a.y + b.y) / 2}, side, INK, text);
}

/* A beam of a width from the direction L onto the surface about a point. */
typedef struct Beam {
    DrawingPoint at;
    Vec3 l;
    double width, length;
    double lit; /* half the width of what it lights, as far as the picture goes */
} Beam;

/* Perpendicular to a beam, to the right. */
static Vec3 beam_across(Vec3 l)
{
    return l.y < 0 ? (Vec3){-l.y, l.x, 0} : (Vec3){l.y, -l.x, 0};
}

static void draw_beam(Board *board, Beam beam)
{
    const Vec3 across = beam_across(beam.l);
    const DrawingPoint far = board_at(beam.at, beam.l, beam.length);
    const DrawingPoint corners[] = {{beam.at.x - beam.lit, beam.at.y},
                                    {beam.at.x + beam.lit, beam.at.y},
                                    board_at(far, across, beam.width / 2),
                                    board_at(far, across, -beam.width / 2)};
    board_area(board, corners, 4, BEAM, 0.55);
    for (int i = 0; i < 4; i++) { /* the normal is in the middle */
        static const double SHARES[] = {-0.85, -0.45, 0.45, 0.85};
        const double share = SHARES[i];
        const DrawingPoint foot = {beam.at.x + share * beam.lit, beam.at.y};
        board_arrow(board, board_at(far, across, share * beam.width / 2), foot, LIGHT_COLOR, 0.08);
    }
}

/* How long a beam can be before a corner leaves the part. */
static double beam_length(const Beam *beam, DrawingBox part)
{
    const double x = fabs(beam->l.x), y = beam->l.y;
    const double half = beam->width / 2;
    const double aside = fmin(part.right - beam->at.x, beam->at.x - part.left) - half * fabs(y);
    const double up = (y > 0 ? beam->at.y - part.top : part.bottom - beam->at.y) - half * x;
    const double by_side = x > 1e-9 ? aside / x : INFINITY;
    const double by_height = fabs(y) > 1e-9 ? up / fabs(y) : INFINITY;
    return fmax(fmin(by_side, by_height), 0);
}

static void incidence_captions(Board *board, DrawingBox *part, double n_dot_l)
{
    char first[FIGURE_TEXT], number[NUMBER_SIZE];
    const char *second = "spread over $w$: as bright as can be";
    board_number(n_dot_l, number);
    snprintf(first, sizeof first, "$N·L$ = %s", number);
    if (n_dot_l <= 0)
        second = "no light: it comes from behind";
    else if (n_dot_l < 1)
        second = "the same light, spread over $w$ / ($N·L$)";
    figure_captions(board, part, first, second);
}

static const double STRIP = 0.8; /* the surface's, in em */

/* The width of what the beam lights. */
static void draw_footprint(Board *board, const Beam *beam, double n_dot_l)
{
    char text[FIGURE_TEXT];
    const double y = beam->at.y + (STRIP + 0.55) * board->em;
    const double footprint = optics_footprint(n_dot_l);
    snprintf(text, sizeof text, "%.*f $w$", footprint < 100 ? 2 : 0, footprint);
    dimension(board, (DrawingPoint){beam->at.x - beam->lit, y},
              (DrawingPoint){beam->at.x + beam->lit, y}, (Vec3){0, -1, 0},
              n_dot_l < 1 ? text : "$w$");
}

/* The beam's own width. */
static void draw_width(Board *board, const Beam *beam, double angle)
{
    const Vec3 across = beam_across(beam->l);
    const double clear = (0.5 * board->em + beam->width / 2 * fabs(across.y)) / beam->l.y;
    const DrawingPoint near =
        board_at(beam->at, beam->l, fmin(fmax(0.8 * beam->length, clear), beam->length));
    dimension(board, board_at(near, across, -beam->width / 2),
              board_at(near, across, beam->width / 2), angle > 0 ? across : vec3_scale(across, -1),
              "$w$");
}

void figure_incidence(Board *board, const Optics *optics, int number)
{
    static const double ROOM = 2.9;
    const double em = board->em, angle = number ? optics->light : 0;
    Material matte; /* what the eye's place does not change */
    Optics turned = optics_matte(optics, &matte);
    turned.light = angle;
    turned.radiating = false;
    const OpticsVectors at = optics_vectors(&turned, ORIGIN, UP);
    DrawingBox part = figure_part(board, number);
    incidence_captions(board, &part, at.n_dot_l);
    const double width = part.right - part.left;
    const double depth = fmax(depth_for(at.n_dot_l) + STRIP, ROOM) * em;
    const Vec3 asked = optics_left(optics->light);
    const double beam_width =
        asked.y > 0 ? fmax(fmin(fmin(4 * em, 0.3 * width), 0.7 * width * asked.y), 0.6 * em)
                    : 3 * em;
    Beam beam = {.at = {(part.left + part.right) / 2, part.bottom - depth},
                 .l = at.l,
                 .width = beam_width,
                 .lit = fmin(beam_width * optics_footprint(at.n_dot_l) / 2, 0.46 * width)};
    if (at.n_dot_l <= 0) /* what it would light from behind */
        beam.lit = fmin(beam_width * optics_footprint(-at.n_dot_l) / 2, 0.46 * width);
    DrawingBox room = part; /* L is written at the beam's end */
    room.top += 1.4 * em;
    room.bottom -= 1.4 * em;
    beam.length = beam_length(&beam, room);
    board->area = part;
    board_box(board, (DrawingBox){part.left, beam.at.y, part.right, beam.at.y + STRIP * em}, PALE,
              false);
    board_line(board, (DrawingPoint){part.left, beam.at.y}, (DrawingPoint){part.right, beam.at.y},
               INK, 0.12);
    if (at.n_dot_l > 0)
        figure_surface(board, &turned, beam.at, beam.at.x - beam.lit, beam.at.x + beam.lit, 1);
    draw_beam(board, beam);
    const double n_length = fmin(4.5 * em, 0.75 * (beam.at.y - part.top));
    const DrawingPoint n_tip = board_at(beam.at, UP, n_length);
    board_arrow(board, beam.at, n_tip, INK, 0.12);
    if (at.n_dot_l > 0) {
        draw_footprint(board, &beam, at.n_dot_l);
        board->area.bottom = beam.at.y;
    }
    if (fabs(angle) > 8 && at.n_dot_l > 0) {
        board_arc(board, (Arc){beam.at, 0.5 * n_length, -angle, 0}, INK, 0.06, 0);
        board_label(board, board_at(beam.at, optics_left(angle / 2), 0.5 * n_length),
                    optics_left(angle / 2), INK, "$θ$");
    }
    const DrawingPoint far = board_at(beam.at, beam.l, beam.length);
    if (at.n_dot_l > 0 && at.n_dot_l < 1)
        draw_width(board, &beam, angle);
    board_label(board, n_tip, UP, INK, "$N$");
    board_label(board, far, at.l, LIGHT_COLOR, "light");
}

/* Rays. */

static void draw_point(Board *board, DrawingPoint foot, DrawingPoint from, double n_length,
                       double n_dot_l, double number_y)
{
    char number[NUMBER_SIZE];
    board_arrow(board, foot, board_at(foot, UP, n_length), INK, 0.09);
    board_arrow(board, from, foot, LIGHT_COLOR, 0.1);
    board_number(n_dot_l, number);
    board_caption(board, foot.x, number_y - 0.33 * board->em, 3 * board->em, number);
}

/* The points that are shown, from left to right about their middle, how long rays are, and the
 * pixels of a unit. */
typedef struct Strip {
    DrawingPoint middle, lamp;
    double half, reach, unit;
    bool lamp_shown;
} Strip;

/* `rise` is the room for a ray above the surface, or below; `side` that on each side of `middle`. A
 * lamp that is too far away for the picture is as far as the rays' directions say. */
static Strip make_strip(const Board *board, const Optics *optics, DrawingPoint middle, double rise,
                        double side)
{
    static const double NARROWEST = 3.4; /* half of a strip under a lamp that is shown, in ems */
    const Vec3 l = optics_left(optics->light);
    const double up = rise / fmax(fabs(l.y), 1e-9), across = side / fmax(fabs(l.x), 1e-9);
    Strip strip = {.middle = middle, .half = side, .reach = fmin(up, 0.6 * across)};
    if (optics->radiating) {
        const double near = fmin(side, fmin(up, across) / (2 * optics->distance));
        strip.lamp_shown = near >= NARROWEST * board->em;
        strip.half = strip.lamp_shown ? near : side;
    }
    if (!strip.lamp_shown) { /* rays that come from the side begin there */
        const double shift = fmin(strip.reach * fabs(l.x), 0.6 * side) / 2;
        strip.half -= shift;
        strip.middle.x += l.x < 0 ? shift : -shift;
    }
    strip.unit = 2 * strip.half * optics->distance / OPTICS_LIGHT_DISTANCE;
    strip.lamp = board_at(strip.middle, l, OPTICS_LIGHT_DISTANCE * strip.unit);
    return strip;
}

/* Where a ray begins that arrives along -L at a point `x` pixels right of the middle. */
static DrawingPoint ray_begin(const Strip *strip, double x, Vec3 l, double rise, DrawingBox part)
{
    const DrawingPoint foot = {strip->middle.x + x, strip->middle.y};
    const double aside = l.x < 0 ? foot.x - part.left : part.right - foot.x;
    if (strip->lamp_shown)
        return strip->lamp;
    return board_at(foot, l, fmin(strip->reach, fmin(rise / fabs(l.y), aside / fabs(l.x))));
}

void figure_rays(Board *board, const Optics *optics, int number)
{
    const double em = board->em;
    Material matte; /* there is no eye */
    Optics shown = optics_matte(optics, &matte);
    shown.radiating = number;
    const double cosine = optics_left(optics->light).y;
    DrawingBox part = figure_part(board, number);
    char text[FIGURE_TEXT] = "parallel: $L$ is the same everywhere";
    const bool lit = optics_left(shown.light).y > 0;
    if (shown.radiating)
        snprintf(text, sizeof text, "a lamp at %.6g widths: $L$ turns by %.3g°", shown.distance,
                 optics_spread(&shown));
    figure_captions(board, &part, text,
                    lit ? "$N·L$ is written below each point" : "$N·L$ ≤ 0 counts as 0: no light");
    const double width = part.right - part.left;
    const double depth = (2.4 + depth_for(cosine)) * em;
    const double above = part.bottom - depth - part.top - 1.3 * em;
    const double rise = cosine < 0 ? depth_for(cosine) * em + 0.6 * em : above;
    const DrawingPoint origin = {(part.left + part.right) / 2, part.bottom - depth};
    const double side = 0.5 * width - 1.2 * em;
    const Strip strip = make_strip(board, &shown, origin, rise, side);
    const int points = (int)fmin(fmax(floor(2 * strip.half / (2.4 * em)), 3), 7) | 1;
    const double normal = fmin(2.4 * em, above - 1.2 * em);
    /* On the side where the light is not. */
    const double number_y = cosine > 0 ? origin.y + 2 * em : origin.y - normal - 0.5 * em;
    DrawingPoint last = origin, begin = origin;
    board->area = part;
    figure_surface(board, &shown, strip.middle, part.left, part.right, strip.unit);
    for (int i = 0; i < points; i++) {
        const double x = strip.half * (2.0 * i / (points - 1) - 1);
        const OpticsVectors at = optics_vectors(&shown, (Vec3){x / strip.unit, 0, 0}, UP);
        last = (DrawingPoint){strip.middle.x + x, origin.y};
        begin = ray_begin(&strip, x, at.l, rise, part);
        draw_point(board, last, begin, normal, at.n_dot_l, number_y);
    }
    if (strip.lamp_shown)
        board_lamp(board, strip.lamp);
    const Vec3 back = {begin.x - last.x, last.y - begin.y, 0};
    board_label(board, board_at(last, UP, normal), UP, INK, "$N$");
    board_label(board, board_at(last, back, strip.lamp_shown ? 0.5 : 0.75),
                vec3_add(vec3_unit(back), (Vec3){1, 0, 0}), LIGHT_COLOR, "light");
}
