/* A polygon whose corners are numbered counter-clockwise and clockwise, and its two unit normals: N
 * = (p2 - p1) x (p3 - p2) / |...|, and what it points to is in front. The eye turns about the
 * vertical by its angle, and looks down a little. */
#include "diagrams/figures.h"

#include <math.h>
#include <stdio.h>

static const double DOWN = 30, NORMAL = 1.8; /* in degrees; the normals' length */
static const Vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};

/* A polygon with its corners at a distance of 1, in eye coordinates. */
typedef struct Polygon {
    Frame2 frame;
    Mat4 eye_from_object;
    int corners, order; /* 1: counter-clockwise about z; -1: clockwise */
} Polygon;

static Vec3 corner(const Polygon *polygon, double number)
{
    const double degrees = 135 + polygon->order * 360 * number / polygon->corners;
    return mat4_transform_direction(mat4_product(polygon->eye_from_object, mat4_rotate(degrees, Z)),
                                    X);
}

static void draw_normal(Board *board, Frame2 frame, Vec3 n, Vec3 color, const char *name)
{
    const DrawingPoint tip = board_at(frame.origin, n, NORMAL * frame.unit);
    board_arrow(board, frame.origin, tip, color, 0.13);
    board_label(board, tip, n, color, name);
}

static void draw_polygon(Board *board, const Polygon *polygon, Vec3 color)
{
    enum { STEPS = 100, HEAD = 5 };
    DrawingPoint corners[OPTICS_SIDES_MAX];
    for (int i = 0; i < polygon->corners; i++)
        corners[i] = figure_at(polygon->frame, corner(polygon, i));
    board_area(board, corners, polygon->corners, color, 0.75);
    for (int i = 0; i < polygon->corners; i++) {
        char number[FIGURE_TEXT];
        board_arrow(board, corners[i], corners[(i + 1) % polygon->corners], EDGE_COLOR, 0.12);
        snprintf(number, sizeof number, "%d", i + 1);
        board_label(board, corners[i], corner(polygon, i), EDGE_COLOR, number);
    }
    /* How the fingers of the right hand bend. */
    DrawingPoint arc[STEPS + 1];
    for (int i = 0; i <= STEPS; i++) {
        const Vec3 at = corner(polygon, 0.8 * polygon->corners * i / STEPS);
        arc[i] = figure_at(polygon->frame, vec3_scale(at, 0.4));
        if (i > 0 && i <= STEPS - HEAD + 1) /* into the head, a fifth of it */
            board_line(board, arc[i - 1], arc[i], R_COLOR, 0.08);
    }
    board_arrow_head(board, arc[STEPS - HEAD], arc[STEPS], R_COLOR);
}

void figure_winding(Board *board, const Optics *optics, int number)
{
    const int order = number ? -1 : 1;
    char seen[FIGURE_TEXT], cosine[NUMBER_SIZE];
    Polygon polygon = {.eye_from_object =
                           mat4_product(mat4_rotate(DOWN, X), mat4_rotate(-optics->eye, Y)),
                       .corners = (int)fmax(optics->sides, 3),
                       .order = order};
    const Vec3 p1 = corner(&polygon, 0), p2 = corner(&polygon, 1), p3 = corner(&polygon, 2);
    const Vec3 n = vec3_unit(vec3_cross(vec3_subtract(p2, p1), vec3_subtract(p3, p2)));
    const Vec3 back = vec3_scale(n, -1);
    DrawingBox part = figure_part(board, number), units = {-1, 1, 1, -1};
    const char *const side = fabs(n.z) < 0.005 ? "edge-on: neither side"
                             : n.z > 0         ? "counter-clockwise: the front"
                                               : "clockwise: we see the back";
    /* V is z in eye coordinates */
    snprintf(seen, sizeof seen, "%s, $N·V$ = %s", side, board_number(n.z, cosine));
    figure_captions(board, &part,
                    order > 0 ? "right hand: fingers 1, 2, 3, thumb $N$"
                              : "corners in the opposite order: $N$ turns round",
                    seen);
    figure_cover(&units, vec3_scale(n, NORMAL));
    figure_cover(&units, vec3_scale(back, NORMAL));
    board->area = part;
    polygon.frame = figure_fit(part, 1.4 * board->em, units);
    /* The normal behind the polygon, which shines through; the polygon; the one before it. */
    for (int before = 0; before <= 1; before++) {
        if ((n.z >= 0) == before)
            draw_normal(board, polygon.frame, n, INK, "$N$");
        else
            draw_normal(board, polygon.frame, back, GREY, "−$N$");
        if (!before)
            draw_polygon(board, &polygon, n.z > 0 ? DIFFUSE_FILL : PALE);
    }
}
