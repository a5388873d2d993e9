/* The figures of Vectors: what they draw against closed forms, and that nothing in them overlaps or
 * is cut. */
#include "diagrams/figures.h"
#include "diagrams/usual_optics.h"
#include "images/path_box.h"
#include "support/testing.h"

/* Of numbers read from pixels: a drawing's coordinates are rounded nowhere. */
#define PIXELS 1e-9

/* A drawing of a figure, and the straight lines in it of a colour and a width in ems. */
typedef struct Lines {
    Drawing drawing;
    DrawingPoint ends[256][2];
    int count;
} Lines;

static void find_lines(Lines *lines, Vec3 color, double width)
{
    const Drawing *drawing = &lines->drawing;
    const double em = fmin(drawing->width / 27, drawing->height / 21);
    lines->count = 0;
    for (int i = 0; i < drawing->path_count && lines->count < 256; i++) {
        const DrawingPath *path = &drawing->paths[i];
        if (path->step_count == 2 && drawing->steps[path->first_step + 1] == DRAWING_LINE &&
            memcmp(&path->style.stroke, &color, sizeof color) == 0 &&
            fabs(path->style.width - width * em) < PIXELS)
            memcpy(lines->ends[lines->count++], &drawing->points[path->first_point],
                   sizeof lines->ends[0]);
    }
}

static Lines lines_of(Figure figure, const Optics *optics, Vec3 color, double width)
{
    Lines lines = {.count = 0};
    SUCCEEDS(drawing_begin(&lines.drawing, 800, 450, message));
    figure_draw(figure, optics, &lines.drawing);
    find_lines(&lines, color, width);
    return lines;
}

static void lines_end(Lines *lines)
{
    drawing_end(&lines->drawing);
}

/* A line's angle to the right of up, in degrees. */
static double angle_of(const Lines *lines, int i)
{
    const DrawingPoint *ends = lines->ends[i];
    assert_true(i < lines->count);
    return atan2(ends[1].x - ends[0].x, ends[0].y - ends[1].y) * 180 / PI;
}

static double length_of(const Lines *lines, int i)
{
    const DrawingPoint *ends = lines->ends[i];
    return hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y);
}

static void assert_angle(double a, double b)
{
    if (!(fabs(remainder(a - b, 360)) < PIXELS))
        fail_msg("%.12g degrees are not %.12g", a, b);
}

/* The box of the last label with a text, which is there. */
static DrawingBox assert_text(const Lines *lines, const char *text)
{
    for (int i = lines->drawing.label_count - 1; i >= 0; i--)
        if (strstr(lines->drawing.labels[i].text, text))
            return lines->drawing.labels[i].box;
    fail_msg("no text %s", text);
    return (DrawingBox){0, 0, 0, 0};
}

TEST(rays_of_a_far_lamp_are_essentially_parallel)
{
    static const double DISTANCES[] = {0.5, 0.75, 2, 11740, 1e6};
    for (int i = 0; i < 5; i++) {
        Optics optics = usual(0, 0, 10, REFLECTION_PHONG);
        optics.distance = DISTANCES[i];
        const double most = 2 * atan(0.5 / DISTANCES[i]) * 180 / PI; /* above the middle */
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_RAYS, &optics, LIGHT_COLOR, 0.1);
        double spread = 0;
        assert_near(optics_spread(&optics), most);
        for (int a = 0; a < lines.count; a++)
            for (int b = 0; b < a; b++)
                spread =
                    fmax(spread, fabs(remainder(angle_of(&lines, a) - angle_of(&lines, b), 360)));
        assert_angle(spread, most);
        assert_angle(angle_of(&lines, 0), 180); /* of the parallel ones */
        assert_text(&lines, formatted("turns by %.3g°", most));
    }
}

TEST(only_the_eye_at_the_mirror_angle_sees_the_ray)
{
    const Optics optics = usual(35, 5, 10, REFLECTION_PHONG);
    CLOSED(lines_end) Lines lines = lines_of(FIGURE_MIRROR, &optics, R_COLOR, 0.13);
    assert_int_equal(lines.count, 1);
    assert_angle(angle_of(&lines, 0), 35);
    find_lines(&lines, LIGHT_COLOR, 0.2);
    assert_int_equal(lines.count, 1);
    assert_angle(angle_of(&lines, 0), 180 - 35);
    find_lines(&lines, GREY, 0.06); /* eyes that see nothing */
    assert_int_equal(lines.count, 2);
    assert_angle(angle_of(&lines, 0), 5);
    assert_angle(angle_of(&lines, 1), 65);
    assert_text(&lines, "only the eye at 35°");
}

TEST(a_mirror_s_angles_are_marked_and_equal)
{
    for (double light = -85; light <= 85; light += 34) {
        const Optics optics = usual(light, 5, 10, REFLECTION_PHONG);
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_MIRROR, &optics, LIGHT_COLOR, 0.2);
        int arcs = 0;
        find_lines(&lines, INK, 0.06); /* N, from the foot of the ray */
        const DrawingPoint from = lines.ends[0][0];
        for (int k = 0; k < lines.drawing.path_count; k++) {
            const DrawingPath *path = &lines.drawing.paths[k];
            const DrawingPoint *at = &lines.drawing.points[path->first_point];
            const int last = path->step_count - 1;
            if (last < 2 || memcmp(&path->style.stroke, &LIGHT_COLOR, sizeof LIGHT_COLOR) != 0)
                continue;
            assert_angle((atan2(at[last].x - from.x, from.y - at[last].y) -
                          atan2(at[0].x - from.x, from.y - at[0].y)) *
                             180 / PI,
                         light);
            arcs++;
        }
        assert_int_equal(arcs, 2);
        assert_text(&lines, "at an equal angle");
    }
}

TEST(a_grazing_beam_s_labels_are_above_the_surface)
{
    for (double light = -85; light <= 85; light += 5) {
        const Optics optics = usual(light, 5, 10, REFLECTION_PHONG);
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_INCIDENCE, &optics, INK, 0.12);
        const double surface = lines.ends[0][0].y;
        assert_true(assert_text(&lines, "light").bottom < surface);
        find_lines(&lines, INK, 0.06);
        /* Three lines for each width: of both lit places, and of the beam at an angle. */
        assert_int_equal(lines.count, light == 0 ? 6 : 9);
        for (int i = 6; i < lines.count; i++)
            assert_true(fmax(lines.ends[i][0].y, lines.ends[i][1].y) < surface);
    }
}

/* N = (0, 0, 1) turned about the vertical by the eye's angle, then seen from 30 degrees above. */
TEST(a_polygon_has_two_unit_normals_by_the_right_hand_rule)
{
    for (int sides = 3; sides <= 16; sides++) {
        Optics optics = usual(0, 5.0 * sides, 10, REFLECTION_PHONG);
        char text[NUMBER_SIZE];
        optics.sides = sides;
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_WINDING, &optics, INK, 0.13);
        const double x = -sin(optics.eye * PI / 180), front = cosine(optics.eye);
        assert_int_equal(lines.count, 2);
        assert_angle(angle_of(&lines, 0), atan2(x, -front / 2) * 180 / PI);
        assert_angle(angle_of(&lines, 1), atan2(-x, front / 2) * 180 / PI);
        assert_text(&lines, board_number(front * cosine(30), text));
        assert_text(&lines, board_number(-front * cosine(30), text));
        snprintf(text, sizeof text, "%d", sides);
        assert_text(&lines, text);
        find_lines(&lines, EDGE_COLOR,
                   0.12); /* from 1 to 2, as seen: counter-clockwise, then not */
        for (int part = 0; part < 2; part++) {
            const double turn = angle_of(&lines, part * sides + 1) - angle_of(&lines, part * sides);
            assert_true((remainder(turn, 360) < 0) == (part == 0));
        }
    }
}

TEST(a_winding_s_arc_has_no_kink)
{
    const Optics optics = usual(0, 20, 10, REFLECTION_PHONG);
    CLOSED(lines_end) Lines lines = lines_of(FIGURE_WINDING, &optics, R_COLOR, 0.08);
    for (int i = 1; i < lines.count; i++)
        if (i != lines.count / 2) /* of each part: steps of 2.88 degrees, seen at an angle */
            assert_true(fabs(remainder(angle_of(&lines, i) - angle_of(&lines, i - 1), 360)) < 6);
}

/* From above, up in the picture is -z: an eye turned by its angle turns V back by it. */
TEST(eye_coordinates_are_world_coordinates_turned)
{
    for (int eye = -90; eye <= 90; eye += 15) {
        const Optics optics = usual(40, eye, 10, REFLECTION_PHONG);
        char x[NUMBER_SIZE], z[NUMBER_SIZE];
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_SPACES, &optics, V_COLOR, 0.13);
        assert_int_equal(lines.count, 2);
        assert_angle(angle_of(&lines, 0) - angle_of(&lines, 1), -eye);
        find_lines(&lines, GREY, 0.06); /* where the eye looks: straight up in eye coordinates */
        assert_angle(angle_of(&lines, 0), -eye);
        assert_angle(angle_of(&lines, 1), 0);
        assert_text(&lines, formatted("(%s, 0, %s)", board_number(1.7 + 1.9 * cosine(90 - eye), x),
                                      board_number(-0.6 + 1.9 * cosine(eye), z)));
        assert_text(&lines, "(0, 0, 0)"); /* no rounding of it */
        assert_text(&lines, "looks along −$z$");
        assert_text(&lines, "normalize(-v_Position)");
        assert_text(&lines, "normalize(u_EyePosition - v_Position)");
    }
}

TEST(ambient_light_comes_from_all_directions_alike)
{
    Optics optics = usual(40, 0, 10, REFLECTION_PHONG);
    char text[NUMBER_SIZE];
    optics.ambient = 0.5;
    CLOSED(lines_end) Lines lines = lines_of(FIGURE_AMBIENT, &optics, GREY, 0.08);
    assert_int_equal(lines.count, 32);
    for (int i = 0; i < 32; i++) {
        assert_angle(angle_of(&lines, i), 180 + 22.5 * (i % 16 + 0.5));
        assert_true(fabs(length_of(&lines, i) - length_of(&lines, 0)) < PIXELS);
    }
    assert_text(&lines, board_number(0.5 * optics.material->ambient.y, text));
}

/* 0.2 + 0.2 d + 0.2 d^2 = 1 where d = (sqrt(17) - 1) / 2. */
TEST(amplified_light_is_said)
{
    Optics optics = usual(0, 0, 10, REFLECTION_PHONG);
    optics.constant = 0.2;
    CLOSED(lines_end) Lines near = lines_of(FIGURE_ATTENUATION, &optics, GREY, 0.06);
    assert_text(&near, "2.16 times the light; amplified nearer than 1.56");
    assert_int_equal(near.count, 1); /* where nothing is lost */
    optics.linear = optics.quadratic = 0;
    CLOSED(lines_end) Lines everywhere = lines_of(FIGURE_ATTENUATION, &optics, GREY, 0.06);
    assert_text(&everywhere, "5 times the light; amplified everywhere");
}

TEST(the_curve_of_attenuation_goes_through_its_values)
{
    /* The coefficients, and the ends of the axes. */
    static const double CASES[][5] = {{1, 0.2, 0.2, 10, 1}, {0, 0, 1, 2, 5}, {0.2, 0.2, 0, 10, 5}};
    for (int i = 0; i < 3; i++) {
        const double *k = CASES[i];
        Optics optics = usual(0, 0, 10, REFLECTION_PHONG);
        optics.constant = k[0];
        optics.linear = k[1];
        optics.quadratic = k[2];
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_ATTENUATION, &optics, INK, 0.1);
        const Drawing *drawing = &lines.drawing;
        const DrawingPath *path = drawing->paths;
        const DrawingPoint zero = lines.ends[0][0];
        while (memcmp(&path->style.stroke, &LIGHT_COLOR, sizeof LIGHT_COLOR) != 0)
            path++;
        assert_true(path->step_count > 100);
        for (int j = 0; j < path->step_count; j++) {
            const DrawingPoint at = drawing->points[path->first_point + j];
            const double d = k[3] * (at.x - zero.x) / length_of(&lines, 0);
            const double share = k[4] * (zero.y - at.y) / length_of(&lines, 1);
            assert_true(fabs(share * (k[0] + k[1] * d + k[2] * d * d) - 1) < PIXELS);
        }
    }
}

static bool is_bar(const Drawing *drawing, int path, Vec3 fill, double bottom, double height)
{
    const DrawingBox box = path_box(drawing, &drawing->paths[path]);
    return memcmp(&drawing->paths[path].style.fill, &fill, sizeof fill) == 0 &&
           fabs(box.bottom - bottom) < PIXELS && fabs(box.bottom - box.top - height) < PIXELS;
}

TEST(bars_are_as_high_as_what_they_stand_for)
{
    const Vec3 WHITE = {1, 1, 1}, fills[] = {WHITE, WHITE, PALE}; /* two are hatched */
    for (int m = 0; m < MATERIAL_COUNT; m++) {
        const Vec3 kd = MATERIALS[m].material.diffuse, ks = MATERIALS[m].material.specular;
        const double d[] = {kd.x, kd.y, kd.z}, s[] = {ks.x, ks.y, ks.z};
        Optics optics = usual(0, 0, 10, REFLECTION_PHONG);
        optics.material = &MATERIALS[m].material;
        CLOSED(lines_end) Lines lines = lines_of(FIGURE_REFLECTIVITY, &optics, INK, 0.06);
        const double one = lines.ends[0][0].y; /* of the dashed line */
        int path = 0;
        double bottom = 0;
        find_lines(&lines, INK, 0.1);
        for (int i = 0; i < 9; i++) { /* stacked in this order */
            const double zero = lines.ends[0][0].y;
            const double shares[] = {d[i / 3], s[i / 3], 1 - d[i / 3] - s[i / 3]};
            const double height = shares[i % 3] * (zero - one);
            bottom = i % 3 ? bottom : zero;
            if (height < PIXELS)
                continue;
            while (path < lines.drawing.path_count &&
                   !is_bar(&lines.drawing, path, fills[i % 3], bottom, height))
                path++;
            assert_true(path < lines.drawing.path_count);
            bottom -= height;
        }
    }
}

TEST(numbers_have_a_minus_sign_and_no_negative_zero)
{
    char text[NUMBER_SIZE];
    assert_string_equal(board_number(0.766, text), "0.77");
    assert_string_equal(board_number(-0.5, text), "\xE2\x88\x92"
                                                  "0.50");
    assert_string_equal(board_number(-0.001, text), "0.00");
}

static bool apart(DrawingBox a, DrawingBox b, double gap)
{
    return a.right + gap <= b.left || b.right + gap <= a.left || a.bottom + gap <= b.top ||
           b.bottom + gap <= a.top;
}

static bool has_label(const Drawing *drawing, const char *letter)
{
    for (int i = 0; i < drawing->label_count; i++)
        if (drawing->labels[i].text[0] == '$' && strstr(drawing->labels[i].text, letter) &&
            !strstr(drawing->labels[i].text, "·"))
            return true;
    return false;
}

static void check_figure(Figure figure, const Optics *optics, double width, double height)
{
    CLOSED(drawing_end) Drawing drawing;
    SUCCEEDS(drawing_begin(&drawing, width, height, message));
    figure_draw(figure, optics, &drawing);
    const char *what =
        formatted("%s %gx%g light %g eye %g shininess %g %s %s sides %d distance %g",
                  FIGURE_NAMES[figure], width, height, optics->light, optics->eye,
                  optics->shininess, REFLECTION_NAMES[optics->reflection],
                  optics->radiating ? "radiating" : "parallel", optics->sides, optics->distance);
    const double em = fmin(drawing.width / 27, drawing.height / 21);
    for (int i = 0; i < drawing.label_count; i++)
        for (int j = 0; j < i; j++)
            if (!apart(drawing.labels[i].box, drawing.labels[j].box,
                       strchr("$(", drawing.labels[i].text[0]) ? 0.25 * em : 0))
                fail_msg("%s: %s touches %s", what, drawing.labels[i].text, drawing.labels[j].text);
    for (int i = 0; i < drawing.path_count; i++) {
        const DrawingBox box = path_box(&drawing, &drawing.paths[i]);
        if (!(box.left >= 0 && box.top >= 0 && box.right <= drawing.width &&
              box.bottom <= drawing.height) &&
            drawing.paths[i].step_count)
            fail_msg("%s: path %d is cut: %g %g %g %g of %gx%g", what, i, box.left, box.top,
                     box.right, box.bottom, drawing.width, drawing.height);
    }
    for (int i = 0; i < 4 && figure == FIGURE_VECTORS; i++)
        if (!has_label(&drawing, (const char *[]){"N", "L", "R", "V"}[i]))
            fail_msg("%s: no label %d", what, i);
    assert_true(figure != FIGURE_LOBE || has_label(&drawing, "V"));
}

TEST(nothing_overlaps_and_nothing_is_cut)
{
    static const double SIZES[][2] = {{400, 400}, {800, 450}, {1600, 400}, {400, 1600},
                                      {560, 400}, {400, 300}, {300, 400},  {520, 399}};
    static const double LIGHTS[] = {-180, -135, -90, -89.9, -60, -20, -1, 0,   0.02,
                                    5,    20,   40,  75,    89,  90,  91, 120, 180};
    static const double EYES[] = {-90, -20, 0, 3, 40, 90};
    static const double SHININESS[] = {0, 33.333333, 128};
    static const double DISTANCES[] = {0.25, 0.75, 1.3, 11740, 1e6}, COEFFICIENTS[] = {0, 0.3, 10};
    const int step = testing_step(33);
    for (int i = 0; i < 8 * 18 * 6 * 3 * FIGURE_COUNT * 4; i += step) {
        const double *size = SIZES[i / 4 / FIGURE_COUNT / 3 / 6 / 18];
        Optics optics =
            usual(LIGHTS[i / 4 / FIGURE_COUNT / 3 / 6 % 18], EYES[i / 4 / FIGURE_COUNT / 3 % 6],
                  SHININESS[i / 4 / FIGURE_COUNT % 3], (Reflection)(i & 1));
        optics.radiating = i & 2;
        optics.sides = 1 + i % OPTICS_SIDES_MAX;
        optics.distance = DISTANCES[i % 5];
        optics.constant = COEFFICIENTS[i % 3];
        optics.linear = COEFFICIENTS[i / 3 % 3];
        optics.quadratic = COEFFICIENTS[i / 9 % 3];
        optics.material = &MATERIALS[i % MATERIAL_COUNT].material;
        check_figure((Figure)(i / 4 % FIGURE_COUNT), &optics, size[0], size[1]);
    }
}

/* The semicircle of the unit vectors is in the middle of a picture with room on both sides. */
TEST(the_figure_of_a_very_wide_picture_is_in_its_middle)
{
    static const double SIZES[][2] = {{800, 200}, {1600, 400}, {1000, 300}};
    const Optics optics = usual(0, 0, 10, REFLECTION_PHONG);
    for (int i = 0; i < 3; i++) {
        int arcs = 0;
        CLOSED(drawing_end) Drawing drawing;
        SUCCEEDS(drawing_begin(&drawing, SIZES[i][0], SIZES[i][1], message));
        figure_draw(FIGURE_VECTORS, &optics, &drawing);
        for (int k = 0; k < drawing.path_count; k++) {
            const DrawingBox box = path_box(&drawing, &drawing.paths[k]);
            if (drawing.paths[k].style.dash == 0)
                continue;
            arcs++;
            assert_true(fabs(box.left + box.right - SIZES[i][0]) < 1);
        }
        assert_int_equal(arcs, 1);
    }
}

TEST(a_picture_of_a_pixel_can_be_drawn)
{
    const Optics optics = usual(40, 20, 10, REFLECTION_PHONG);
    for (int figure = 0; figure < FIGURE_COUNT; figure++) {
        CLOSED(drawing_end) Drawing drawing;
        CLOSED(image_close) Image image;
        SUCCEEDS(drawing_begin(&drawing, 1, 1, message));
        figure_draw((Figure)figure, &optics, &drawing);
        SUCCEEDS(image_open(&image, 1, 1, IMAGE_BYTE, message));
        SUCCEEDS(drawing_paint(&drawing, &image, false, message));
    }
}

TEST_MAIN("vectors", NULL, NULL)
