/* Two charts: what is left of a lamp's light at a distance, and what becomes of light that arrives,
 * by colour channel. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A box whose lower left corner is (0, 0), and its upper right one. */
typedef struct Chart {
    DrawingBox box;
    double right, top;
} Chart;

/* Below the captions' part, with `aside` ems of room at the right and `below` under the axis. */
static Chart make_chart(Board *board, const char *first, const char *second, double aside,
                        double below)
{
    const double em = board->em;
    DrawingBox part = {em, em, board->drawing->width - em, board->drawing->height - 0.5 * em};
    figure_captions(board, &part, first, second);
    board->area = part;
    return (Chart){.box = {part.left + 1.8 * em, part.top + 0.5 * em, part.right - aside * em,
                           part.bottom - below * em}};
}

static DrawingPoint on_chart(const Chart *chart, double x, double y)
{
    const DrawingBox box = chart->box;
    return (DrawingPoint){box.left + x / chart->right * (box.right - box.left),
                          box.bottom - y / chart->top * (box.bottom - box.top)};
}

static void draw_axes(Board *board, const Chart *chart)
{
    const double em = board->em;
    const int ticks = (int)(chart->top > 2 ? chart->top : 2 * chart->top); /* 1 among them */
    for (int i = 0; i <= ticks; i++) {
        char text[FIGURE_TEXT];
        const double y = chart->top * i / ticks;
        const DrawingPoint at = on_chart(chart, 0, y);
        snprintf(text, sizeof text, "%.4g", y);
        board_line(board, (DrawingPoint){at.x - 0.3 * em, at.y}, at, INK, 0.08);
        board_caption(board, at.x - 1.1 * em, at.y, 1.3 * em, text);
    }
    board_line(board, on_chart(chart, 0, 0), on_chart(chart, chart->right, 0), INK, 0.1);
    board_line(board, on_chart(chart, 0, 0), on_chart(chart, 0, chart->top), INK, 0.1);
}

/* Attenuation. */

/* The next of 1, 2, 5, 10, 20... */
static double round_up(double number)
{
    const double power = pow(10, floor(log10(number))), digits = number / power;
    return power * (digits <= 1 ? 1 : digits <= 2 ? 2 : digits <= 5 ? 5 : 10);
}

/* From where it is within the chart; denser at its beginning, where it may be steep. */
static void draw_curve(Board *board, const Chart *chart, const Optics *optics)
{
    enum { STEPS = 256 };
    const double first = optics_attenuated_to(optics, chart->top);
    DrawingPoint before = {0, 0};
    drawing_path(board->drawing, (DrawingStyle){.stroke = LIGHT_COLOR, .width = 0.16 * board->em});
    for (int i = 0; i <= STEPS && first < chart->right; i++) {
        const double d = first + (chart->right - first) * pow((double)i / STEPS, 3);
        const DrawingPoint at = on_chart(chart, d, optics_attenuation(optics, d));
        (i ? drawing_line : drawing_move)(board->drawing, at);
        if (i)
            board_keep_away(board, before, at);
        before = at;
    }
}

/* What a surface that faces the lamp looks like at each distance, and the distances. */
static void draw_strip(Board *board, const Chart *chart, const Optics *optics)
{
    enum { PIECES = 128, TICKS = 5 };
    const double em = board->em, y = on_chart(chart, 0, 0).y;
    for (int i = 0; i < PIECES; i++) {
        const double left = chart->right * i / PIECES;
        const double right = fmin(left + 2 * chart->right / PIECES, chart->right);
        const double share = fmin(optics_attenuation(optics, left + chart->right / PIECES / 2), 1);
        board_box(
            board,
            (DrawingBox){on_chart(chart, left, 0).x, y, on_chart(chart, right, 0).x, y + 0.8 * em},
            vec3_scale(BEAM, share), false);
    }
    for (int i = 0; i <= TICKS; i++) {
        char text[FIGURE_TEXT];
        const double d = chart->right * i / TICKS;
        snprintf(text, sizeof text, "%.6g", d);
        board_caption(board, on_chart(chart, d, 0).x, y + 1.5 * em, 5 * em, text);
    }
}

void figure_attenuation(Board *board, const Optics *optics, int number)
{
    (void)number;
    static const double MOST = 5;
    const double here = optics_attenuation(optics, optics->distance);
    const double begin = fmin(optics_attenuation(optics, 0), MOST);
    const double tenth = optics_attenuated_to(optics, begin / 10);
    const double one = optics_attenuated_to(optics, 1); /* nearer than this it is more */
    char first[2 * FIGURE_TEXT], second[FIGURE_TEXT];
    snprintf(first, sizeof first, "1 / (%.4g + %.4g $d$ + %.4g $d$^{2})", optics->constant,
             optics->linear, optics->quadratic);
    snprintf(second, sizeof second, "at $d$ = %.6g: %.3g %s the light", optics->distance, here,
             here > 1 ? "times" : "of");
    if (one > 0)
        snprintf(second + strlen(second), sizeof second - strlen(second),
                 isinf(one) ? "; amplified everywhere" : "; amplified nearer than %.3g", one);
    Chart chart = make_chart(board, first, second, 1.5, 2.2);
    chart.right = round_up(fmax(1.25 * optics->distance, isinf(tenth) ? 5 : tenth));
    chart.top = round_up(fmax(begin, 1));
    const DrawingPoint at = on_chart(&chart, optics->distance, fmin(here, chart.top));
    draw_strip(board, &chart, optics);
    draw_axes(board, &chart);
    draw_curve(board, &chart, optics);
    if (chart.top > 1)
        board_dashed(board, on_chart(&chart, 0, 1), on_chart(&chart, chart.right, 1), GREY);
    board_dashed(board, at, on_chart(&chart, optics->distance, 0), INK);
    board_dashed(board, at, (DrawingPoint){chart.box.left, at.y}, INK);
    board_dot(board, at, 0.25, R_COLOR);
    board_label(board, on_chart(&chart, chart.right, 0), (Vec3){1, 0, 0}, INK, "$d$");
}

/* Reflectivity. */

enum { DIFFUSE, SPECULAR, ABSORBED };
static const char *const NAMES[] = {"diffuse", "specular", "absorbed"};

/* A share of the light, or its swatch: hatched, as the bars are named by colours. */
static void draw_share(Board *board, DrawingBox box, int share)
{
    const double width = box.right - box.left, height = box.bottom - box.top;
    const double left = share == DIFFUSE ? box.left : box.right, way = share == DIFFUSE ? 1 : -1;
    board_box(board, box, share == ABSORBED ? PALE : (Vec3){1, 1, 1}, true);
    for (double c = 0; c < width + height && share != ABSORBED; c += 0.5 * board->em)
        board_line(board, (DrawingPoint){left + way * fmin(c, width), box.top + fmax(c - width, 0)},
                   (DrawingPoint){left + way * fmax(c - height, 0), box.top + fmin(c, height)},
                   GREY, 0.05);
}

/* One channel's bar, from the bottom. */
static void draw_bar(Board *board, const Chart *chart, int channel, const double shares[3])
{
    static const char *const CHANNELS[] = {"red", "green", "blue"};
    double from = 0;
    for (int i = 0; i < 3; i++) {
        char number[NUMBER_SIZE];
        const DrawingPoint a = on_chart(chart, channel + 0.2, from);
        const DrawingPoint b = on_chart(chart, channel + 0.8, from + shares[i]);
        from += shares[i];
        if (shares[i] > 0)
            draw_share(board, (DrawingBox){a.x, b.y, b.x, a.y}, i);
        if (a.y - b.y > 1.05 * board->em)
            board_caption(board, (a.x + b.x) / 2, (a.y + b.y) / 2, b.x - a.x,
                          board_number(shares[i], number));
    }
    const DrawingPoint foot = on_chart(chart, channel + 0.5, 0);
    board_caption(board, foot.x, foot.y + 0.9 * board->em, 5 * board->em, CHANNELS[channel]);
}

void figure_reflectivity(Board *board, const Optics *optics, int number)
{
    (void)number;
    const Vec3 diffuse = optics->material->diffuse, specular = optics->material->specular;
    const Vec3 both = vec3_add(diffuse, specular);
    const bool real = fmax(fmax(both.x, both.y), both.z) <= 1;
    const double shares[3][3] = {{diffuse.x, specular.x, fmax(1 - both.x, 0)},
                                 {diffuse.y, specular.y, fmax(1 - both.y, 0)},
                                 {diffuse.z, specular.z, fmax(1 - both.z, 0)}};
    Chart chart = make_chart(board, "what becomes of the light of each channel",
                             real ? "what is not reflected is absorbed"
                                  : "above 1: no real surface reflects more than it gets",
                             7.5, 1.6);
    const double em = board->em, x = chart.box.right + em, y = chart.box.top + em;
    chart.right = 3;
    chart.top = real ? 1 : fmax(both.x, fmax(both.y, both.z)) <= 1.5 ? 1.5 : 2;
    board_dashed(board, on_chart(&chart, 0, 1), on_chart(&chart, chart.right, 1), INK);
    for (int i = 0; i < 3; i++) {
        draw_bar(board, &chart, i, shares[i]);
        draw_share(board,
                   board_swatch(board, (DrawingPoint){x, y + 1.5 * i * em}, PALE, NAMES[2 - i]),
                   2 - i);
    }
    draw_axes(board, &chart);
    drawing_text(board->drawing, (DrawingPoint){x, y + 5.5 * em}, em, INK, "the colours:");
    board_swatch(board, (DrawingPoint){x, y + 7 * em}, specular, NAMES[1]);
    board_swatch(board, (DrawingPoint){x, y + 8.5 * em}, diffuse, NAMES[0]);
}
