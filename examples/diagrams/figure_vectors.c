/* N, L, R, V and H, the lobe, and their values. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROWS = 7 };

/* The values beside or below the figure. */
typedef struct Table {
    char rows[ROWS][FIGURE_TEXT];
    int swatch; /* the row that begins with the colour */
    Vec3 color;
    double width; /* of a row */
} Table;

static const Vec3 UP = {0, 1, 0}, ORIGIN = {0, 0, 0};

static void value_row(char row[FIGURE_TEXT], const char *name, double value)
{
    char number[NUMBER_SIZE];
    board_number(value, number);
    snprintf(row, FIGURE_TEXT, "%.40s = %s%s", name, number, value < 0 ? ", counts as 0" : "");
}

static Table make_table(const Board *board, const Optics *optics, const OpticsVectors *at)
{
    static const char *const REFLECTIONS[] = {"Blinn-Phong", "Phong"};
    char power[FIGURE_TEXT], number[NUMBER_SIZE];
    Table table = {.swatch = ROWS - 1, .color = optics_color(optics, ORIGIN, UP)};
    figure_power(optics, power);
    snprintf(table.rows[0], FIGURE_TEXT, "%s, shininess %.4g", REFLECTIONS[optics->reflection],
             optics->shininess);
    value_row(table.rows[1], "$N·L$", at->n_dot_l);
    value_row(table.rows[2], "$R·V$", at->r_dot_v);
    if (color_is_black(at->h))
        snprintf(table.rows[3], FIGURE_TEXT, "no $H$: $L$ = −$V$");
    else
        value_row(table.rows[3], "$N·H$", at->n_dot_h);
    snprintf(table.rows[4], FIGURE_TEXT, "%.40s = %s", power, board_number(at->highlight, number));
    if (at->n_dot_l <= 0)
        snprintf(table.rows[4], FIGURE_TEXT,
                 at->n_dot_l < 0 ? "the light is behind:" : "the light grazes:");
    snprintf(table.rows[5], FIGURE_TEXT,
             at->n_dot_l > 0 ? "the colour of the point:" : "ambient light alone");
    snprintf(table.rows[6], FIGURE_TEXT, "%.2f  %.2f  %.2f", table.color.x, table.color.y,
             table.color.z);
    for (int i = 0; i < ROWS; i++) {
        const double indent = i == table.swatch ? BOARD_SWATCH * board->em : 0;
        const DrawingBox box = drawing_text_box(board->drawing, board->em, table.rows[i]);
        table.width = fmax(table.width, indent + box.right);
    }
    return table;
}

static void draw_row(Board *board, const Table *table, int row, double x, double y)
{
    if (row == table->swatch)
        board_swatch(board, (DrawingPoint){x, y}, table->color, table->rows[row]);
    else
        drawing_text(board->drawing, (DrawingPoint){x, y}, board->em, INK, table->rows[row]);
}

/* Draws the table at the right of a wide picture, below another, and takes its place off the area.
 */
static void draw_table(Board *board, const Table *table)
{
    const double em = board->em, row = 1.5 * em;
    const double width = board->drawing->width, height = board->drawing->height;
    if (width > 1.4 * height) {
        const double left = width - table->width - em;
        for (int i = 0; i < ROWS; i++)
            draw_row(board, table, i, left, height / 2 + row * (i - 0.5 * (ROWS - 1)) + 0.3 * em);
        board->area.right = left - em;
        /* In the middle of a very wide picture. */
        board->area.left =
            fmax(board->area.left, fmin(width - board->area.right, board->area.right - 2 * height));
        return;
    }
    const int columns = 2, rows = (ROWS + columns - 1) / columns;
    const double left = fmax(em, (width - columns * table->width - 2 * em) / 2);
    const double top = height - rows * row;
    for (int i = 0; i < ROWS; i++)
        draw_row(board, table, i, left + i / rows * (table->width + 2 * em),
                 top + row * (i % rows) + 0.7 * em);
    board->area.bottom = top - 0.6 * em;
}

static void draw_lobe(Board *board, const Optics *optics, Frame2 frame, const OpticsVectors *at)
{
    enum { STEPS = 360 };
    DrawingPoint before = frame.origin;
    if (at->n_dot_l <= 0)
        return;
    drawing_path(board->drawing, (DrawingStyle){.fill = SPECULAR_FILL,
                                                .fill_alpha = 0.3,
                                                .stroke = R_COLOR,
                                                .width = 0.06 * board->em});
    drawing_move(board->drawing, frame.origin);
    for (int i = 0; i <= STEPS; i++) {
        const double eye = -90 + 180.0 * i / STEPS;
        const DrawingPoint to =
            board_at(frame.origin, optics_right(eye), frame.unit * optics_lobe(optics, eye));
        drawing_line(board->drawing, to);
        board_keep_away(board, before, to);
        before = to;
    }
    drawing_close_path(board->drawing);
}

typedef struct Named {
    const char *name;
    Vec3 direction, color;
} Named;

/* One label at the tip of vectors that coincide: "N = L". */
static void label_tips(Board *board, Frame2 frame, const Named *vectors, int count)
{
    bool done[8] = {false};
    for (int i = 0; i < count; i++) {
        char text[DRAWING_TEXT_SIZE] = "$";
        Vec3 color = vectors[i].color;
        if (done[i] || color_is_black(vectors[i].direction))
            continue;
        strcat(text, vectors[i].name);
        for (int j = i + 1; j < count; j++) {
            const Vec3 apart = vec3_subtract(vectors[j].direction, vectors[i].direction);
            if (vec3_length(apart) > 1e-3)
                continue;
            done[j] = true;
            strcat(strcat(text, " = "), vectors[j].name);
            color = INK;
        }
        board_label(board, board_at(frame.origin, vectors[i].direction, frame.unit),
                    vectors[i].direction, color, strcat(text, "$"));
    }
}

void figure_vectors(Board *board, const Optics *optics, int number)
{
    (void)number;
    const OpticsVectors at = optics_vectors(optics, ORIGIN, UP);
    const Vec3 lamp = optics_light_place(optics), eye = optics_eye_place(optics);
    const Table table = make_table(board, optics, &at);
    const Named vectors[] = {{"N", at.n, INK},
                             {"L", at.l, LIGHT_COLOR},
                             {"R", at.r, R_COLOR},
                             {"V", at.v, V_COLOR},
                             {"H", at.h, H_COLOR}};
    draw_table(board, &table);
    /* The largest that fits the area. */
    static const double SIDE = 1.15;
    const Vec3 ends[] = {at.n, at.l, at.r, at.v, at.h, lamp, eye};
    DrawingBox units = {-SIDE, 0, SIDE, 0};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        figure_cover(&units, ends[i]);
    DrawingBox area = board->area;
    area.bottom -= 0.1 * board->em;
    const Frame2 frame = figure_fit(area, 1.6 * board->em, units);
    const DrawingPoint lamp_at = board_at(frame.origin, lamp, frame.unit);
    const DrawingPoint eye_at = board_at(frame.origin, eye, frame.unit);
    figure_surface(board, optics, frame.origin, frame.origin.x - 1.15 * frame.unit,
                   frame.origin.x + 1.15 * frame.unit, frame.unit);
    draw_lobe(board, optics, frame, &at);
    board_arc(board, (Arc){frame.origin, frame.unit, -90, 90}, PALE, 0.05, 0.25);
    if (optics->radiating)
        board_lamp(board, lamp_at);
    else
        board_rays(board, lamp_at, vec3_scale(at.l, -1));
    board_eye(board, eye_at, frame.origin);
    for (int i = (int)(sizeof vectors / sizeof vectors[0]) - 1; i >= 0; i--)
        board_arrow(board, frame.origin, board_at(frame.origin, vectors[i].direction, frame.unit),
                    vectors[i].color, 0.13);
    board_dot(board, frame.origin, 0.22, INK);
    if (at.n_dot_l > 0)
        board_dot(board, board_at(frame.origin, at.v, frame.unit * at.highlight), 0.2, R_COLOR);
    label_tips(board, frame, vectors, sizeof vectors / sizeof vectors[0]);
    if (at.n_dot_l <= 0)
        return;
    figure_angle(board, frame, (Vec3[]){at.l, UP}, 0.42, "$θ$", LIGHT_COLOR);
    figure_angle(board, frame, (Vec3[]){UP, at.r}, 0.42, "$θ$", LIGHT_COLOR);
    if (optics->reflection == REFLECTION_PHONG)
        figure_angle(board, frame, (Vec3[]){at.r, at.v}, 0.7, "$φ$", R_COLOR);
    else if (!color_is_black(at.h))
        figure_angle(board, frame, (Vec3[]){UP, at.h}, 0.7, "$ψ$", H_COLOR);
}
