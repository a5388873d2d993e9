/*
 * --show and --probe against closed forms: a square over the whole picture, whose shader computes
 * functions of the place, in highp and mediump. Needs no driver.
 */
#include "probe/probe.h"
#include "probe/show.h"

#include "support/testing.h"

enum { SIDE = 40, PIXELS = SIDE * SIDE };

static const char *vertex = "attribute vec2 a_Place;\n"
                            "varying vec2 v_Place;\n"
                            "void main() {\n"
                            "    vec4 twice = vec4(2.0 * a_Place, 0.0, 1.0);\n"
                            "    v_Place = a_Place;\n"
                            "    gl_Position = vec4(a_Place, 0.0, 1.0);\n"
                            "}\n";

/* Draws the square from -1 to 1; valid until the next. */
static const Capture *capture_of(const char *fragment)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    static unsigned vertices[4] = {0, 1, 2, 3};
    static CaptureAttribute place = {.name = "a_Place",
                                     .bytes = (const unsigned char *)corners,
                                     .byte_count = sizeof corners,
                                     .stride = sizeof corners[0],
                                     .type = GL_FLOAT,
                                     .size = 2};
    static CaptureDraw draw;
    static Capture capture = {.draws = &draw, .draw_count = 1};
    draw = (CaptureDraw){.sources = {vertex, fragment},
                         .mode = GL_TRIANGLE_STRIP,
                         .vertex_count = 4,
                         .vertices = vertices,
                         .attributes = &place,
                         .attribute_count = 1,
                         .viewport = {0, 0, SIDE, SIDE},
                         .colors = {true, true, true, true}};
    return &capture;
}

static bool show(Show *shown, const char *fragment, const char *what, Message *message)
{
    return show_open(shown, capture_of(fragment), &GLSL_LLVMPIPE, what, (const int[2]){SIDE, SIDE},
                     message);
}

/* The same as a picture, and what is said of it. */
static char *paint(const char *fragment, const char *what, Image *picture)
{
    Show shown;
    char *legend = NULL;
    size_t size;
    FILE *file = open_memstream(&legend, &size);
    SUCCEEDS(show(&shown, fragment, what, message) &&
             image_open(picture, SIDE, SIDE, IMAGE_BYTE, message));
    show_paint(&shown, picture, file);
    fclose(file);
    show_close(&shown);
    return legend;
}

/* Of a pixel: x to the right and y up. */
static void place_of(int i, double place[2])
{
    place[0] = (i % SIDE + 0.5) * 2 / SIDE - 1;
    place[1] = 1 - (i / SIDE + 0.5) * 2 / SIDE;
}

static const unsigned char *at(const Image *picture, int i)
{
    return (const unsigned char *)picture->pixels + 4 * (size_t)i;
}

static bool is(const unsigned char *color, int red, int green, int blue)
{
    return color[0] == red && color[1] == green && color[2] == blue;
}

static const char SPHERE[] = "precision highp float;\n"
                             "varying vec2 v_Place;\n"
                             "void main() {\n"
                             "    float square = 1.0 - dot(v_Place, v_Place);\n"
                             "    vec3 normal;\n"
                             "    normal.xy = v_Place;\n"
                             "    normal.z = sqrt(square);\n"
                             "    gl_FragColor = vec4(2.0 * normal, 1.0);\n"
                             "}\n";

TEST(a_spheres_normals_are_directions)
{
    CLOSED(image_close) Image picture = {.width = 0};
    free(paint(SPHERE, "normal", &picture));
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        const double square = 1 - place[0] * place[0] - place[1] * place[1];
        const double normal[3] = {place[0], place[1], sqrt(square)};
        if (square < 0)
            assert_true(is(at(&picture, i), 255, 128, 0)); /* the root of a negative number */
        else
            for (int c = 0; c < 3; c++) /* half a step, and the error of a float */
                assert_true(fabs(at(&picture, i)[c] - 255 * (0.5 + 0.5 * normal[c])) < 0.5001);
    }
}

/* Of the first pixel, which is drawn red. */
static char *verdict_of(const char *fragment)
{
    CLOSED(probe_close) Probe probe;
    const ProbeQuestion question = {
        .capture = capture_of(fragment), .driver = &GLSL_LLVMPIPE, .height = SIDE, .drawn = {255}};
    SUCCEEDS(probe_open(&probe, &question, message));
    return probe_verdict(&probe);
}

/* In so many pixels, the first of them. */
static void undefined(const char *fragment, int count)
{
    static const char *const SAID[] = {"undefined, in orange: %d pixels",
                                       "%d pixels, white: the colour is undefined"};
    for (int i = 0; i < 2; i++) {
        CLOSED(image_close) Image picture = {.width = 0};
        char said[80], *legend = paint(fragment, i ? "blame" : "error", &picture);
        snprintf(said, sizeof said, SAID[i], count);
        assert_non_null(strstr(legend, said));
        free(legend);
    }
    char *text = verdict_of(fragment);
    assert_non_null(strstr(text, "verdict: the colour is undefined\n"));
    free(text);
}

TEST(what_is_undefined_or_not_as_drawn_is_not_called_right)
{
    int outside = 0; /* the circle */
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        outside += place[0] * place[0] + place[1] * place[1] > 1;
    }
    undefined(SPHERE, outside);
    undefined("precision highp float; void main() { float k; gl_FragColor = vec4(k); }", PIXELS);
    undefined("precision highp float; void main() { float k = 1.0; }", PIXELS);
    undefined("void main() { gl_FragColor = vec4(0.0); while (true) gl_FragColor.r = 0.1; }",
              PIXELS);
    char *text = verdict_of("void main() { gl_FragColor = vec4(0.0); }");
    assert_non_null(strstr(text, "verdict: not what is drawn; as computed, 0.00 steps off: "));
    free(text);
}

TEST(a_vertex_that_reads_what_has_no_value_is_undefined)
{
    const char *const usual = vertex;
    vertex = "attribute vec2 a_Place; varying float v_Light; float lit() { float k; return k; }\n"
             "void main() { v_Light = lit(); gl_Position = vec4(a_Place, 0.0, 1.0); }";
    undefined("precision highp float; varying float v_Light;\n"
              "void main() { gl_FragColor = vec4(v_Light); }",
              PIXELS);
    vertex = usual;
}

TEST(a_scalar_has_a_scale_and_negative_numbers_a_colour)
{
    CLOSED(image_close) Image picture = {.width = 0};
    char *legend = paint(SPHERE, "square", &picture);
    double least = 1, most = 0;
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        const double square = 1 - place[0] * place[0] - place[1] * place[1];
        least = square >= 0 ? fmin(least, square) : least;
        most = fmax(most, square);
    }
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        unsigned char expected[3] = {0, 128, 255};
        place_of(i, place);
        const double square = 1 - place[0] * place[0] - place[1] * place[1];
        if (square >= 0)
            image_viridis((square - least) / (most - least), expected);
        for (int c = 0; c < 3; c++) /* a float's error may turn the rounding to a byte */
            assert_true(abs(at(&picture, i)[c] - expected[c]) <= 1);
    }
    assert_non_null(strstr(legend, "negative, in azure"));
    free(legend);
}

TEST(colours_are_shown_as_they_are_and_clipped_ones_marked)
{
    CLOSED(image_close) Image picture = {.width = 0};
    free(paint("precision highp float;\n"
               "varying vec2 v_Place;\n"
               "void main() {\n"
               "    gl_FragColor = vec4(v_Place.x + 0.9, 0.25, 0.5, 1.0);\n"
               "}\n",
               "gl_FragColor", &picture));
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        const double red = place[0] + 0.9;
        assert_true(red < 0   ? is(at(&picture, i), 0, 128, 255)
                    : red > 1 ? is(at(&picture, i), 255, 0, 255)
                              : is(at(&picture, i), (int)(255 * red + 0.5), 64, 128));
    }
}

TEST(values_of_the_vertex_shader_and_components)
{
    static const char *const NAMES[] = {"twice", "gl_Position.y", "v_Place.x"};
    for (int k = 0; k < 3; k++) {
        CLOSED(show_close) Show shown;
        SUCCEEDS(show(&shown, SPHERE, NAMES[k], message));
        for (int i = 0; i < PIXELS; i++) {
            double place[2];
            place_of(i, place);
            const double expected = k == 0 ? 2 * place[0] : k == 1 ? place[1] : place[0];
            assert_int_equal(shown.pixels[i].count, k == 0 ? 4 : 1);
            assert_true(fabs((double)shown.pixels[i].values[0] - expected) < 1e-6);
        }
    }
}

static const char DIGITS[] = "#line 1 0\n"
                             "precision mediump float;\n"
                             "varying vec2 v_Place;\n"
                             "void main() {\n"
                             "    float far = v_Place.x + 17.0;\n"
                             "    float back = far - 16.5;\n"
                             "    float half_back = 0.5 * back;\n"
                             "    gl_FragColor = vec4(half_back * 0.3, 0.0, 0.0, 1.0);\n"
                             "}\n";

/* 11 significant bits; none of the numbers here is less than 2^-14. */
static double mediump(double x)
{
    int exponent;
    frexp(x, &exponent);
    return ldexp(nearbyint(ldexp(x, 11 - exponent)), exponent - 11);
}

TEST(errors_are_those_of_eleven_bits)
{
    CLOSED(show_close) Show shown;
    SUCCEEDS(show(&shown, DIGITS, "error", message));
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        const double far = mediump(mediump(place[0]) + 17), back = mediump(far - 16.5);
        const double red = mediump(mediump(0.5 * back) * mediump(0.3));
        const double exact = (place[0] + 0.5) / 2 * 0.3;
        const double error = 255 * (fmax(red, 0) - fmax(exact, 0));
        /* The shaders' constants are floats, and so is what is shown. */
        assert_true(fabs((double)shown.pixels[i].values[0] - error) < 1e-5);
    }
}

TEST(what_the_variables_cause_adds_up)
{
    static const char *const NAMES[] = {"error", "error:far", "error:back", "error:half_back",
                                        "error:gl_FragColor"};
    static double sums[PIXELS], far[PIXELS];
    for (int k = 0; k < 5; k++) {
        CLOSED(show_close) Show shown;
        SUCCEEDS(show(&shown, DIGITS, NAMES[k], message));
        for (int i = 0; i < PIXELS; i++) {
            const double value = (double)shown.pixels[i].values[0];
            sums[i] = k == 0 ? value : sums[i] - value;
            far[i] = k == 1 ? value : far[i];
        }
    }
    double most = 0;
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        const double exact = fmax(place[0] + 0.5, 0);
        const double apart = fmax(mediump(mediump(place[0]) + 17) - 16.5, 0) - exact;
        assert_true(fabs(sums[i]) < 1e-5);
        assert_true(fabs(far[i] - 255 * 0.15 * apart) < 1e-5); /* as above */
        most = fmax(most, fabs(far[i]));
    }
    assert_true(most > 0.1);
}

TEST(the_line_that_loses_digits_is_blamed)
{
    CLOSED(image_close) Image picture = {.width = 0};
    CLOSED(show_close) Show shown;
    char *legend = paint(DIGITS, "blame", &picture);
    assert_non_null(strstr(legend, "orange: line 4: float far = v_Place.x + 17.0;"));
    free(legend);
    SUCCEEDS(show(&shown, DIGITS, "blame", message));
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_of(i, place);
        const double far = 255 * 0.15 * fabs(mediump(mediump(place[0]) + 17) - 17 - place[0]);
        if (place[0] > -0.48 && far > 0.1) /* the other lines' are less than 255 * 2^-12 / 2 */
            assert_true(is(at(&picture, i), 230, 159, 0));
        if (place[0] < -0.55) /* black whatever the digits */
            assert_true(is(at(&picture, i), 64, 64, 64));
    }
}

TEST(twelve_lines_have_a_colour_of_their_own)
{
    enum { LINES = 13 };
    CLOSED(image_close) Image picture = {.width = 0};
    static char text[LINES * 80 + 200];
    int length = snprintf(text, sizeof text,
                          "precision mediump float;\nvarying vec2 v_Place;\n"
                          "void main() {\n    float far = 0.0;\n");
    for (int i = 0; i < LINES; i++)
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "if (v_Place.x >= %.2f) far = v_Place.x + 17.0; // %d\n",
                           i ? -0.84 + 0.15 * i : -1.0, i);
    snprintf(text + length, sizeof text - (size_t)length,
             "    gl_FragColor = vec4(0.5 * (18.0 - far));\n}\n");
    char *legend = paint(text, "blame", &picture);
    int named = 0, others = 0;
    for (const char *at = legend; (at = strstr(at, " pixels, ")); at += 9) {
        named++;
        others += strncmp(at + 9, "light grey, as all further: ", 28) == 0;
    }
    assert_int_equal(named, LINES + 1);
    assert_int_equal(others, 1);
    free(legend);
}

TEST(a_loops_int_is_not_blamed_for_what_a_function_is_given)
{
    CLOSED(image_close) Image picture = {.width = 0};
    char *legend = paint("#line 1 0\n"
                         "precision mediump float;\n"
                         "varying vec2 v_Place;\n"
                         "float twice(float a) {\n"
                         "    for (int i = 0; i < 1; i++) a *= 2.0;\n"
                         "    return a;\n"
                         "}\n"
                         "void main() {\n"
                         "    float x = twice(v_Place.x + 17.0) - 34.0;\n"
                         "    gl_FragColor = vec4(x);\n"
                         "}\n",
                         "blame", &picture);
    assert_non_null(strstr(legend, "orange: line 8: float x = "));
    assert_null(strstr(legend, "line 4"));
    free(legend);
}

TEST(a_condition_and_a_return_are_blamed_for_what_they_round)
{
    static const struct {
        const char *text, *said;
    } CASES[] = {{"precision mediump float;\nvarying vec2 v_Place;\n"
                  "void main() {\nfloat x = 0.0;\n"
                  "if (v_Place.x + 64.0 - 64.0 > 0.0124)\nx = 1.0;\ngl_FragColor = vec4(x);\n}\n",
                  "line 5: if (v_Place.x"},
                 {"precision mediump float;\nvarying vec2 v_Place;\n"
                  "float moved() {\nreturn v_Place.x + 17.0;\n}\n"
                  "void main() {\ngl_FragColor = vec4(moved() - 17.0);\n}\n",
                  "line 4: return v_Place.x"}};
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        CLOSED(image_close) Image picture = {.width = 0};
        char text[400];
        snprintf(text, sizeof text, "#line 1 0\n%s", CASES[i].text);
        char *legend = paint(text, "blame", &picture);
        assert_non_null(strstr(legend, CASES[i].said));
        free(legend);
    }
}

TEST(a_power_magnifies_what_rounding_has_left)
{
    static const char power[] = "#line 1 0\n"
                                "precision mediump float;\n"
                                "varying vec2 v_Place;\n"
                                "void main() {\n"
                                "    float base = 0.5 * v_Place.x + 0.5;\n"
                                "    float power = pow(base, 24.0);\n"
                                "    gl_FragColor = vec4(power);\n"
                                "}\n";
    ProbeQuestion question = {
        .driver = &GLSL_LLVMPIPE, .capture = capture_of(power), .height = SIDE};
    int judged = 0;
    for (question.column = SIDE / 2; question.column < SIDE; question.column++) {
        CLOSED(probe_close) Probe probe;
        double place[2];
        place_of(question.column, place);
        const double base = (place[0] + 1) / 2, slope = 24 * pow(base, 23);
        SUCCEEDS(probe_open(&probe, &question, message));
        /* What pow rounds in 11 bits, at most: log2, below 0.25 here; the product, below 4; exp2.
         */
        const double own = (24 * 0x1p-15 + 0x1p-11) * 0.7 * pow(base, 24) + 0x1p-12;
        const double left = fabs(mediump(0.5 * mediump(place[0]) + 0.5) - base);
        if (base < 0.9 || left * slope < own)
            continue;
        char *text = probe_text(&probe);
        assert_non_null(strstr(text, "born in line 4 (0.5 * v_Place.x + 0.5), magnified "));
        assert_non_null(strstr(text, " times in line 5 (pow(base, 24.0))"));
        assert_true(fabs(probe.magnified / slope - 1) < 0.01); /* 23 / 2 of 2^-11 by curvature */
        free(text);
        judged++;
    }
    assert_true(judged > 1);
}

TEST(a_cube_map_is_not_read_as_a_flat_texture)
{
    float red[4] = {1, 0, 0, 1}, unit = 0;
    CaptureTexture flat = {.width = 1, .height = 1, .texels = red}, *textures[] = {&flat};
    CaptureUniform cube = {
        .name = "u_Cube", .type = GL_SAMPLER_CUBE, .length = 1, .numbers = 1, .values = &unit};
    const Capture *capture = capture_of("precision highp float;\n"
                                        "uniform samplerCube u_Cube;\n"
                                        "void main() {\n"
                                        "    gl_FragColor = textureCube(u_Cube, vec3(1.0));\n"
                                        "}\n");
    CLOSED(probe_close) Probe probe;
    capture->draws->textures = textures;
    capture->draws->texture_count = 1;
    capture->draws->uniforms = &cube;
    capture->draws->uniform_count = 1;
    SUCCEEDS(probe_open(
        &probe, &(ProbeQuestion){.capture = capture, .driver = &GLSL_LLVMPIPE, .height = SIDE},
        message));
    assert_true(probe.driver.color[0] == 0);
    assert_false(probe.judged);
    assert_non_null(strstr(probe.remarks, "u_Cube: a cube map, which is not read: taken as black"));
}

TEST(an_unknown_name_is_told_with_those_there_are)
{
    CLOSED(show_close) Show shown;
    Message message = {.located = false};
    assert_false(show(&shown, SPHERE, "nromal", &message));
    assert_true(shown.unknown);
    assert_non_null(strstr(message.text, "nromal: no shader here has it; there are normal, "));
    assert_non_null(strstr(message.text, "twice"));
    show_close(&shown);
    message = (Message){.located = false};
    assert_false(show(&shown, SPHERE, "error:twice", &message)); /* of the vertex shader */
    assert_null(strstr(message.text, "are twice"));
}

/* CIE 1976 L* of an sRGB colour (IEC 61966-2-1). */
static double lightness(const unsigned char color[3])
{
    static const double weights[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        const double value = color[c] / 255.0;
        sum += weights[c] * (value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4));
    }
    return 116 * cbrt(sum) - 16;
}

TEST(the_scale_is_even_in_lightness)
{
    unsigned char first[3], last[3], color[3];
    image_viridis(0, first);
    image_viridis(1, last);
    for (int i = 0; i <= 100; i++) {
        const double even = lightness(first) + i / 100.0 * (lightness(last) - lightness(first));
        image_viridis(i / 100.0, color);
        assert_true(fabs(lightness(color) - even) < 3); /* of 76; the colours are whole numbers */
    }
}

TEST_MAIN("show", NULL, NULL)
