#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

const char *const FIGURE_NAMES[FIGURE_COUNT + 1] = {"vectors", "lobe",    "incidence",
                                                    "rays",    "normals", NULL};

void figure_draw(Figure figure, const Optics *optics, int sides, Drawing *drawing)
{
    Board board = board_begin(drawing);
    switch (figure) {
    case FIGURE_VECTORS:
        figure_vectors(&board, optics);
        break;
    case FIGURE_LOBE:
        figure_lobe(&board, optics);
        break;
    case FIGURE_INCIDENCE:
        figure_incidence(&board, optics);
        break;
    case FIGURE_RAYS:
        figure_rays(&board, optics);
        break;
    case FIGURE_NORMALS:
        figure_normals(&board, optics, sides);
        break;
    case FIGURE_COUNT:
        break;
    }
}

static const char *figure_cosine(const Optics *optics)
{
    return optics->reflection == REFLECTION_PHONG ? "$R·V$" : "$N·H$";
}

void figure_power(const Optics *optics, char text[FIGURE_TEXT])
{
    snprintf(text, FIGURE_TEXT, "(%s)^{%.4g}", figure_cosine(optics), optics->shininess);
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
        board_area(board,
                   (const DrawingPoint[]){{a, origin.y}, {b, origin.y}, {b, bottom}, {a, bottom}},
                   4, optics_color(optics, middle, (Vec3){0, 1, 0}), 1);
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

void figure_captions(Board *board, DrawingBox *part, const char *const *lines, int count)
{
    const double row = 1.25 * board->em;
    for (int i = 0; i < count; i++)
        board_caption(board, (part->left + part->right) / 2,
                      part->bottom - (count - 1 - i) * row - row / 2, part->right - part->left,
                      lines[i]);
    part->bottom -= count * row + 0.3 * board->em;
}
