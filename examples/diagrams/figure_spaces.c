/* An object, a lamp and an eye from above, in world and in eye coordinates. Points are (x, -z): z
 * is drawn down. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

static const Vec3 UP = {0, 1, 0}, ORIGIN = {0, 0, 0};
/* The middle of the object in the world, half its side, how far away lamp and eye are, and the
 * axes' length. */
static const Vec3 OBJECT = {1.7, 0, -0.6};
static const double HALF = 0.4, LAMP = 1.6, EYE = 1.9, AXIS = 0.6;

enum { CORNERS = 4, MIDDLE = CORNERS, LAMP_AT, EYE_AT, X_AT, Z_AT, POINTS }; /* 0: what is lit */

/* A point of a space from above; the axes are those of the space. */
static void make_points(const Optics *optics, bool of_eye, Vec3 points[POINTS])
{
    const Vec3 l = optics_left(optics->light), v = optics_right(optics->eye);
    const Vec3 world[EYE_AT + 1] = {
        {-HALF, 0, HALF},         {HALF, 0, HALF}, {HALF, 0, -HALF},
        {-HALF, 0, -HALF},        ORIGIN,          {LAMP * l.x, 0, LAMP * l.y},
        {EYE * v.x, 0, EYE * v.y}};
    const Mat4 space_from_world =
        of_eye ? mat4_look_at(vec3_add(OBJECT, world[EYE_AT]), OBJECT, UP) : mat4_identity();
    for (int i = 0; i <= EYE_AT; i++) {
        const Vec3 at = mat4_transform_point(space_from_world, vec3_add(OBJECT, world[i]));
        points[i] = (Vec3){at.x, -at.z, 0};
    }
    points[X_AT] = (Vec3){AXIS, 0, 0};
    points[Z_AT] = (Vec3){0, -AXIS, 0};
}

/* Those that are zero but for rounding are "0". */
static void coordinates(char text[FIGURE_TEXT], const char *name, Vec3 above)
{
    char x[NUMBER_SIZE] = "0", z[NUMBER_SIZE] = "0";
    if (fabs(above.x) > 1e-9)
        board_number(above.x, x);
    if (fabs(above.y) > 1e-9)
        board_number(-above.y, z);
    snprintf(text, FIGURE_TEXT, "%s(%s, 0, %s)", name, x, z);
}

static void draw_vector(Board *board, Frame2 frame, const Vec3 ends[2], Vec3 color,
                        const char *name)
{
    board_arrow(board, figure_at(frame, ends[0]), figure_at(frame, ends[1]), color,
                color.x == INK.x ? 0.07 : 0.13);
    board_label(board, figure_at(frame, ends[1]), vec3_subtract(ends[1], ends[0]), color, name);
}

void figure_spaces(Board *board, const Optics *optics, int of_eye)
{
    char v_text[FIGURE_TEXT], eye_text[FIGURE_TEXT];
    Vec3 points[POINTS];
    DrawingPoint at[POINTS];
    make_points(optics, of_eye, points);
    const Vec3 point = points[0], eye = points[EYE_AT];
    const Vec3 v = vec3_unit(vec3_subtract(eye, point));
    const Vec3 l = vec3_unit(vec3_subtract(points[LAMP_AT], point));
    DrawingBox part = figure_part(board, of_eye), units = {0, 0, 0, 0};
    coordinates(v_text, of_eye ? "eye coordinates: $V$ = " : "world coordinates: $V$ = ", v);
    coordinates(eye_text, "", eye);
    figure_captions(board, &part, v_text,
                    of_eye ? "vec3 V = normalize(-v_Position);"
                           : "vec3 V = normalize(u_EyePosition - v_Position);");
    for (int i = 0; i < POINTS; i++)
        figure_cover(&units, points[i]);
    board->area = part;
    const Frame2 frame = figure_fit(part, 1.3 * board->em, units);
    for (int i = 0; i < POINTS; i++)
        at[i] = figure_at(frame, points[i]);
    board_dashed(board, at[EYE_AT], at[MIDDLE], GREY);
    board_area(board, at, CORNERS, PALE, 1);
    for (int i = 0; i < CORNERS; i++)
        board_line(board, at[i], at[(i + 1) % CORNERS], INK, 0.07);
    board_lamp(board, at[LAMP_AT]);
    board_eye(board, at[EYE_AT], at[MIDDLE]);
    draw_vector(board, frame, (const Vec3[]){ORIGIN, points[X_AT]}, INK, "$x$");
    draw_vector(board, frame, (const Vec3[]){ORIGIN, points[Z_AT]}, INK, "$z$");
    draw_vector(board, frame, (const Vec3[]){point, vec3_add(point, l)}, LIGHT_COLOR, "$L$");
    draw_vector(board, frame, (const Vec3[]){point, vec3_add(point, v)}, V_COLOR, "$V$");
    board_dot(board, at[0], 0.2, INK);
    /* On the side with more room. */
    const double side = at[EYE_AT].x > (part.left + part.right) / 2 ? -1 : 1;
    board_label(board, (DrawingPoint){at[EYE_AT].x + 1.2 * side * board->em, at[EYE_AT].y},
                (Vec3){side, 0, 0}, V_COLOR, eye_text);
    if (of_eye)
        board_label(board, board_at(at[EYE_AT], UP, (EYE - HALF) / 2 * frame.unit), (Vec3){1, 0, 0},
                    GREY, "looks along −$z$");
}
