#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

#define X(NAME, name, parts) #name,
const char *const FIGURE_NAMES[FIGURE_COUNT + 1] = {FIGURES(X) NULL};
#undef X

void figure_draw(Figure figure, const Optics *optics, Drawing *drawing)
{
#define X(NAME, name, parts) {figure_##name, parts},
    static const struct {
        void (*draw)(Board *, const Optics *, int);
        int parts;
    } ROWS[] = {FIGURES(X)};
#undef X
    Board board = board_begin(drawing);
    for (int i = 0; i < ROWS[figure].parts; i++)
        ROWS[figure].draw(&board, optics, i);
}

void figure_power(const Optics *optics, char text[FIGURE_TEXT])
{
    snprintf(text, FIGURE_TEXT, "(%s)^{%.4g}",
             optics->reflection == REFLECTION_PHONG ? "$R·V$" : "$N·H$", optics->shininess);
}

void figure_surface(Board *board, const Optics *optics, DrawingPoint origin, double left,
                    double right, double unit)
{
    static const double THICKNESS = 0.8, OVERLAP = 1;
    const int pieces = optics->radiating ? 64 : 1; /* parallel rays light all of it alike */
    const double bottom = origin.y + THICKNESS * board->em;
    for (int i = 0; i < pieces; i++) {
        const double a = left + (right - left) * i / pieces;
        const double b = fmin(left + (right - left) * (i + 1) / pieces + OVERLAP, right);
        const Vec3 middle = {((a + b) / 2 - origin.x) / unit, 0, 0};
        board_box(board, (DrawingBox){a, origin.y, b, bottom},
                  optics_color(optics, middle, (Vec3){0, 1, 0}), false);
    }
    board_line(board, (DrawingPoint){left, origin.y}, (DrawingPoint){right, origin.y}, INK, 0.12);
    board_keep_away(board, (DrawingPoint){left, bottom}, (DrawingPoint){right, bottom});
}

DrawingBox figure_part(const Board *board, int number)
{
    const double width = board->drawing->width, height = board->drawing->height;
    const double gap = 0.6 * board->em;
    DrawingBox part = {gap, gap, width - gap, height - gap};
    if (width > 1.3 * height) {
        part.left = number ? width / 2 + gap : part.left;
        part.right = number ? part.right : width / 2 - gap;
    } else {
        part.top = number ? height / 2 + gap : part.top;
        part.bottom = number ? part.bottom : height / 2 - gap;
    }
    return part;
}

Frame2 figure_fit(DrawingBox part, double margin, DrawingBox units)
{
    const double width = units.right - units.left, height = units.top - units.bottom;
    const double unit = fmin((part.right - part.left - 2 * margin) / width,
                             (part.bottom - part.top - 2 * margin) / height);
    return (Frame2){{(part.left + part.right) / 2 - unit * (units.left + units.right) / 2,
                     (part.top + part.bottom) / 2 + unit * (units.top + units.bottom) / 2},
                    unit};
}

void figure_cover(DrawingBox *units, Vec3 point)
{
    *units = (DrawingBox){fmin(units->left, point.x), fmax(units->top, point.y),
                          fmax(units->right, point.x), fmin(units->bottom, point.y)};
}

DrawingPoint figure_at(Frame2 frame, Vec3 point)
{
    return board_at(frame.origin, point, frame.unit);
}

/* An angle of a vector from the normal, to the right. */
static double degrees_of(Vec3 direction)
{
    return atan2(direction.x, direction.y) * 180 / 3.14159265358979323846;
}

void figure_angle(Board *board, Frame2 frame, const Vec3 sides[2], double radius, const char *name,
                  Vec3 color)
{
    const double from = degrees_of(sides[0]), to = degrees_of(sides[1]);
    if (fabs(to - from) < 6 || fabs(to - from) > 174)
        return;
    board_arc(board, (Arc){frame.origin, radius * frame.unit, from, to}, color, 0.06, 0);
    const Vec3 middle = optics_right((from + to) / 2);
    board_label(board, board_at(frame.origin, middle, radius * frame.unit), middle, color, name);
}

void figure_captions(Board *board, DrawingBox *part, const char *first, const char *second)
{
    const double em = board->em, x = (part->left + part->right) / 2;
    const double width = part->right - part->left;
    board_caption(board, x, part->bottom - 1.875 * em, width, first);
    board_caption(board, x, part->bottom - 0.625 * em, width, second);
    part->bottom -= 2.8 * em;
}
