#include "diagrams/board.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const Vec3 INK = {0.13, 0.13, 0.15}, GREY = {0.55, 0.55, 0.58}, PALE = {0.8, 0.8, 0.82};
const Vec3 LIGHT_COLOR = {0.80, 0.47, 0}, R_COLOR = {0.74, 0.16, 0.13};
const Vec3 V_COLOR = {0.08, 0.35, 0.65}, H_COLOR = {0.13, 0.45, 0.18};
const Vec3 EDGE_COLOR = {0.16, 0.25, 0.55};
const Vec3 BEAM = {1, 0.86, 0.42}, DIFFUSE_FILL = {1, 0.82, 0.35};
const Vec3 SPECULAR_FILL = {0.93, 0.45, 0.35};

static const double RADIANS = 3.14159265358979323846 / 180;

Board board_begin(Drawing *drawing)
{
    /* The figures need this many ems. */
    const double em = fmin(drawing->width / 27, drawing->height / 21);
    const double margin = em / 4;
    return (Board){.drawing = drawing,
                   .em = em,
                   .area = {margin, margin, drawing->width - margin, drawing->height - margin}};
}

DrawingPoint board_at(DrawingPoint from, Vec3 direction, double distance)
{
    return (DrawingPoint){from.x + distance * direction.x, from.y - distance * direction.y};
}

/* Shapes. */

void board_keep_away(Board *board, DrawingPoint a, DrawingPoint b)
{
    if (board->segment_count == BOARD_SEGMENTS)
        return;
    board->segments[board->segment_count][0] = a;
    board->segments[board->segment_count++][1] = b;
}

static void add_line(Board *board, DrawingPoint a, DrawingPoint b, DrawingStyle style)
{
    drawing_path(board->drawing, style);
    drawing_move(board->drawing, a);
    drawing_line(board->drawing, b);
    board_keep_away(board, a, b);
}

void board_line(Board *board, DrawingPoint a, DrawingPoint b, Vec3 color, double width)
{
    add_line(board, a, b, (DrawingStyle){.stroke = color, .width = width * board->em});
}

void board_dashed(Board *board, DrawingPoint a, DrawingPoint b, Vec3 color)
{
    add_line(board, a, b,
             (DrawingStyle){.stroke = color, .width = 0.06 * board->em, .dash = 0.3 * board->em});
}

void board_area(Board *board, const DrawingPoint *points, int count, Vec3 color, double alpha)
{
    drawing_path(board->drawing, (DrawingStyle){.fill = color, .fill_alpha = alpha});
    for (int i = 0; i < count; i++)
        (i ? drawing_line : drawing_move)(board->drawing, points[i]);
    drawing_close_path(board->drawing);
}

void board_arrow_head(Board *board, DrawingPoint tail, DrawingPoint tip, Vec3 color)
{
    static const double HALF = 0.36;
    const double dx = tip.x - tail.x, dy = tip.y - tail.y;
    const DrawingPoint neck = {tip.x - 0.8 * dx, tip.y - 0.8 * dy};
    board_area(board,
               (const DrawingPoint[]){tip,
                                      {tail.x - HALF * dy, tail.y + HALF * dx},
                                      neck,
                                      {tail.x + HALF * dy, tail.y - HALF * dx}},
               4, color, 1);
    board_keep_away(board, neck, tip);
}

void board_arrow(Board *board, DrawingPoint from, DrawingPoint to, Vec3 color, double width)
{
    const double dx = to.x - from.x, dy = to.y - from.y, length = hypot(dx, dy);
    const double head = fmin((0.45 + 2.6 * width) * board->em, 0.6 * length);
    if (!(length > 0))
        return;
    const double ux = head * dx / length, uy = head * dy / length;
    board_line(board, from, (DrawingPoint){to.x - 0.8 * ux, to.y - 0.8 * uy}, color, width);
    board_arrow_head(board, (DrawingPoint){to.x - ux, to.y - uy}, to, color);
}

static DrawingPoint on_circle(DrawingPoint center, double radius, double degrees)
{
    return (DrawingPoint){center.x + radius * sin(RADIANS * degrees),
                          center.y - radius * cos(RADIANS * degrees)};
}

void board_arc(Board *board, Arc arc, Vec3 color, double width, double dash)
{
    const int steps = 1 + (int)(fabs(arc.to - arc.from) / 3);
    DrawingPoint before = arc.center;
    drawing_path(
        board->drawing,
        (DrawingStyle){.stroke = color, .width = width * board->em, .dash = dash * board->em});
    for (int i = 0; i <= steps; i++) {
        const DrawingPoint at =
            on_circle(arc.center, arc.radius, arc.from + (arc.to - arc.from) * i / steps);
        (i ? drawing_line : drawing_move)(board->drawing, at);
        if (i && dash == 0)
            board_keep_away(board, before, at);
        before = at;
    }
}

/* Four curves, whose controls are at this share of the radius. */
static void add_circle(Board *board, DrawingPoint at, double radius, DrawingStyle style)
{
    static const double CONTROL = 0.5522847498;
    static const double X[] = {1, 0, -1, 0}, Y[] = {0, 1, 0, -1};
    drawing_path(board->drawing, style);
    drawing_move(board->drawing, (DrawingPoint){at.x + radius, at.y});
    for (int i = 0; i < 4; i++) {
        const int j = (i + 1) % 4;
        const double ax = X[i] + CONTROL * X[j], ay = Y[i] + CONTROL * Y[j];
        const double bx = X[j] + CONTROL * X[i], by = Y[j] + CONTROL * Y[i];
        drawing_curve(board->drawing, (DrawingPoint){at.x + radius * ax, at.y + radius * ay},
                      (DrawingPoint){at.x + radius * bx, at.y + radius * by},
                      (DrawingPoint){at.x + radius * X[j], at.y + radius * Y[j]});
    }
    drawing_close_path(board->drawing);
}

void board_dot(Board *board, DrawingPoint at, double radius, Vec3 color)
{
    add_circle(board, at, radius * board->em, (DrawingStyle){.fill = color, .fill_alpha = 1});
}

/* Symbols. */

static void keep_box(Board *board, DrawingPoint at, double half)
{
    board_keep_away(board, (DrawingPoint){at.x - half, at.y}, (DrawingPoint){at.x + half, at.y});
    board_keep_away(board, (DrawingPoint){at.x, at.y - half}, (DrawingPoint){at.x, at.y + half});
    board_keep_away(board, (DrawingPoint){at.x - half, at.y - half},
                    (DrawingPoint){at.x + half, at.y + half});
    board_keep_away(board, (DrawingPoint){at.x - half, at.y + half},
                    (DrawingPoint){at.x + half, at.y - half});
}

void board_lamp(Board *board, DrawingPoint at)
{
    const double em = board->em;
    add_circle(
        board, at, 0.42 * em,
        (DrawingStyle){
            .fill = {1, 0.82, 0.25}, .fill_alpha = 1, .stroke = LIGHT_COLOR, .width = 0.09 * em});
    for (int i = 0; i < 8; i++)
        board_line(board, on_circle(at, 0.62 * em, 45 * i), on_circle(at, 0.9 * em, 45 * i),
                   LIGHT_COLOR, 0.09);
    keep_box(board, at, em);
}

void board_rays(Board *board, DrawingPoint at, Vec3 direction)
{
    const double em = board->em;
    const Vec3 across = {-direction.y, direction.x, 0};
    for (int i = -1; i <= 1; i++) {
        const DrawingPoint middle = board_at(at, across, 0.5 * i * em);
        board_arrow(board, board_at(middle, direction, -0.85 * em),
                    board_at(middle, direction, 0.85 * em), LIGHT_COLOR, 0.08);
    }
    keep_box(board, at, em);
}

void board_eye(Board *board, DrawingPoint at, DrawingPoint looks_at)
{
    const double em = 1.3 * board->em, length = hypot(looks_at.x - at.x, looks_at.y - at.y);
    const Vec3 ahead = {(looks_at.x - at.x) / length, -(looks_at.y - at.y) / length, 0};
    const Vec3 up = {-ahead.y, ahead.x, 0};
    const DrawingPoint front = board_at(at, ahead, 0.45 * em),
                       back = board_at(at, ahead, -0.7 * em);
    const DrawingStyle lids = {.stroke = V_COLOR, .width = 0.1 * em};
    drawing_path(board->drawing, (DrawingStyle){.fill = {1, 1, 1}, .fill_alpha = 1});
    drawing_move(board->drawing, back);
    drawing_line(board->drawing, board_at(front, up, 0.55 * em));
    drawing_line(board->drawing, board_at(front, up, -0.55 * em));
    /* The lids meet behind; the ball lies between them. */
    for (int side = -1; side <= 1; side += 2) {
        drawing_path(board->drawing, lids);
        drawing_move(board->drawing, back);
        drawing_curve(board->drawing,
                      board_at(board_at(back, ahead, 0.4 * em), up, 0.2 * side * em),
                      board_at(board_at(front, ahead, -0.4 * em), up, 0.55 * side * em),
                      board_at(front, up, 0.62 * side * em));
    }
    drawing_path(board->drawing, lids);
    drawing_move(board->drawing, board_at(board_at(front, ahead, -0.18 * em), up, 0.48 * em));
    drawing_curve(board->drawing, board_at(board_at(front, ahead, 0.18 * em), up, 0.25 * em),
                  board_at(board_at(front, ahead, 0.18 * em), up, -0.25 * em),
                  board_at(board_at(front, ahead, -0.18 * em), up, -0.48 * em));
    board_dot(board, board_at(front, ahead, -0.08 * em), 0.26, V_COLOR);
    keep_box(board, at, em);
}

/* Labels. */

static bool apart(DrawingBox a, DrawingBox b, double gap)
{
    return a.right + gap <= b.left || b.right + gap <= a.left || a.bottom + gap <= b.top ||
           b.bottom + gap <= a.top;
}

static bool inside(DrawingBox box, DrawingBox area)
{
    return box.left >= area.left && box.right <= area.right && box.top >= area.top &&
           box.bottom <= area.bottom;
}

/* Whether a segment meets a box: clipped by its four sides, something is left. (Liang and Barsky,
 * 1984) */
static bool meets(const DrawingPoint segment[2], DrawingBox box, double gap)
{
    const double dx = segment[1].x - segment[0].x, dy = segment[1].y - segment[0].y;
    const double step[] = {-dx, dx, -dy, dy};
    const double room[] = {segment[0].x - box.left + gap, box.right + gap - segment[0].x,
                           segment[0].y - box.top + gap, box.bottom + gap - segment[0].y};
    double first = 0, last = 1;
    for (int i = 0; i < 4; i++) {
        if (step[i] == 0 && room[i] < 0)
            return false;
        if (step[i] < 0)
            first = fmax(first, room[i] / step[i]);
        else if (step[i] > 0)
            last = fmin(last, room[i] / step[i]);
    }
    return first <= last;
}

static bool is_free(const Board *board, DrawingBox box, bool of_lines)
{
    const Drawing *drawing = board->drawing;
    if (!inside(box, board->area))
        return false;
    for (int i = 0; i < drawing->label_count; i++)
        if (!apart(box, drawing->labels[i].box, 0.35 * board->em))
            return false;
    for (int i = 0; i < board->segment_count && of_lines; i++)
        if (meets(board->segments[i], box, 0.2 * board->em))
            return false;
    return true;
}

static DrawingBox box_about(DrawingPoint center, double width, double height)
{
    return (DrawingBox){center.x - width / 2, center.y - height / 2, center.x + width / 2,
                        center.y + height / 2};
}

/* Where a label of this size goes, about its anchor. */
typedef struct Place {
    DrawingPoint anchor, center;
    double width, height, distance;
} Place;

/* Searches rings about the anchor from the preferred direction on. */
static bool find_place(const Board *board, Place *place, double preferred, bool of_lines)
{
    enum { ANGLES = 24 };
    const double em = board->em;
    const double far = hypot(board->drawing->width, board->drawing->height);
    for (double gap = 0.3 * em; gap < far; gap += 0.4 * em)
        for (int i = 0; i < ANGLES; i++) {
            const double turn = 360.0 / ANGLES * ((i + 1) / 2) * (i % 2 ? 1 : -1);
            const double angle = RADIANS * (preferred + turn);
            const double x = sin(angle), y = -cos(angle);
            const double reach = gap + fabs(x) * place->width / 2 + fabs(y) * place->height / 2;
            place->center =
                (DrawingPoint){place->anchor.x + reach * x, place->anchor.y + reach * y};
            place->distance = gap;
            if (is_free(board, box_about(place->center, place->width, place->height), of_lines))
                return true;
        }
    return false;
}

void board_label(Board *board, DrawingPoint anchor, Vec3 direction, Vec3 color, const char *text)
{
    const double em = board->em;
    const DrawingBox ink = drawing_text_box(board->drawing, em, text);
    Place place = {.anchor = anchor, .width = ink.right - ink.left, .height = ink.bottom - ink.top};
    const double preferred = atan2(direction.x, direction.y) / RADIANS;
    /* The tests see to it that a place is always found. */
    if (!find_place(board, &place, preferred, true))
        find_place(board, &place, preferred, false);
    const DrawingBox box = box_about(place.center, place.width, place.height);
    if (place.distance > 1.4 * em) {
        const DrawingPoint near = {fmin(fmax(anchor.x, box.left), box.right),
                                   fmin(fmax(anchor.y, box.top), box.bottom)};
        board_line(board, near, anchor, GREY, 0.04);
    }
    drawing_text(board->drawing, (DrawingPoint){box.left - ink.left, box.top - ink.top}, em, color,
                 text);
}

void board_caption(Board *board, double x, double y, double width, const char *text)
{
    const double usual = drawing_text_box(board->drawing, board->em, text).right;
    const double size = board->em * fmin(1, width / usual);
    const DrawingBox ink = drawing_text_box(board->drawing, size, text);
    drawing_text(board->drawing,
                 (DrawingPoint){x - (ink.left + ink.right) / 2, y + 0.33 * board->em}, size, INK,
                 text);
}

void board_box(Board *board, DrawingBox box, Vec3 color, bool framed)
{
    const DrawingPoint corners[] = {
        {box.left, box.top}, {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}};
    board_area(board, corners, 4, color, 1);
    for (int i = 0; i < 4 && framed; i++)
        board_line(board, corners[i], corners[(i + 1) % 4], INK, 0.05);
}

DrawingBox board_swatch(Board *board, DrawingPoint at, Vec3 color, const char *text)
{
    const double em = board->em;
    const DrawingBox box = {at.x, at.y - 0.8 * em, at.x + 1.9 * em, at.y + 0.2 * em};
    board_box(board, box, color, true);
    drawing_text(board->drawing, (DrawingPoint){at.x + BOARD_SWATCH * em, at.y}, em, INK, text);
    return box;
}

const char *board_number(double number, char text[NUMBER_SIZE])
{
    char plain[NUMBER_SIZE - 4];
    snprintf(plain, sizeof plain, "%.2f", fabs(number));
    const bool negative = number < 0 && strcmp(plain, "0.00") != 0;
    snprintf(text, NUMBER_SIZE, "%s%s", negative ? "\xE2\x88\x92" : "", plain);
    return text;
}
