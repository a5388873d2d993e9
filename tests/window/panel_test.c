/*
 * The panel's controls, used like a user would: pointer and keys go in, and parameters get new
 * values. Controls are found with the pointer, by the tooltips that they show.
 */
#include "support/testing.h"
#include "window/panel.h"

#include <float.h>
#include <unistd.h>

enum { MAX_ROWS = 32 };
enum { LEFT = 644 };                     /* of the panel in a window of 1000 pixels */
static const double LABEL_X = LEFT + 20; /* in the names of the parameters */

static Panel *panel;
static WindowInput window;
static PanelInput input;
static PanelContent content;
static PanelResult result;
static char clipboard[256];

static const char *get_clipboard(void *text)
{
    return text;
}

static void set_clipboard(void *to, const char *text)
{
    assert_ptr_equal(to, clipboard);
    snprintf(clipboard, sizeof clipboard, "%s", text);
}

/* A new panel of 1000x700 pixels, the pointer outside it. */
FIXTURE(open_panel)
{
    window = (WindowInput){.width = 1000, .height = 700, .scale = 1, .x = -10, .y = -10};
    clipboard[0] = '\0';
    input = (PanelInput){.window = &window,
                         .seconds = 1.0 / 60,
                         .clipboard = clipboard,
                         .get_clipboard = get_clipboard,
                         .set_clipboard = set_clipboard};
    content = (PanelContent){.name = "Test", .view = PANEL_OPEN};
    result = (PanelResult){.view = PANEL_OPEN};
    SUCCEEDS(panel_open(&panel, message));
}

FIXTURE(close_panel)
{
    panel_close(panel);
}

static void frame(void)
{
    SUCCEEDS(panel_frame(panel, &input, &content, &result, message));
    /* What is drawn is within the window, and indices are within the arrays. */
    const PanelDrawing *drawing = &result.drawing;
    for (int i = 0; i < drawing->command_count; i++) {
        const PanelCommand *command = &drawing->commands[i];
        assert_true(command->x >= 0 && command->y >= 0);
        assert_true(command->width > 0 && command->x + command->width <= window.width);
        assert_true(command->height > 0 && command->y + command->height <= window.height);
        assert_true(command->first >= 0 && command->count > 0 && command->count % 3 == 0);
        assert_true(command->first + command->count <= drawing->index_count);
        for (int k = command->first; k < command->first + command->count; k++)
            assert_true(command->vertex + drawing->indices[k] < drawing->vertex_count);
    }
    content.view = result.view;
    window.typed_count = 0;
    window.scroll = 0;
    memset(window.down, 0, sizeof window.down);
}

static void frames(int count)
{
    for (int i = 0; i < count; i++)
        frame();
}

/* Moves the pointer there, and lets the panel see it. */
static void point(double x, double y)
{
    window.x = x;
    window.y = y;
    frames(2);
}

/* A click, and the frame in which a button says that it was pressed. Returns what it changed. */
static uint32_t tap(double x, double y)
{
    point(x, y);
    window.buttons[0] = true;
    frame();
    const uint32_t changed = result.changed;
    window.buttons[0] = false;
    frame();
    return changed | result.changed;
}

static uint32_t click(double x, double y)
{
    const uint32_t changed = tap(x, y);
    frame();
    return changed | result.changed;
}

static uint32_t press_key(WindowKey key)
{
    window.down[key] = true;
    frame();
    const uint32_t changed = result.changed;
    frame();
    return changed | result.changed;
}

/* With control. */
static void press_chord(WindowKey key)
{
    window.control = window.down[key] = true;
    frame();
    window.control = false;
}

/* Whether a tooltip appears with the pointer there. */
static bool hovers(double x, double y)
{
    point(-10, -10);
    const int before = result.drawing.command_count;
    point(x, y);
    return result.drawing.command_count > before;
}

typedef struct Span {
    double from, to, middle;
} Span;

/* Where tooltips appear along the names of the parameters or, with a row, along it; returns in how
 * many places. */
static int find_spans(const double *row, Span spans[MAX_ROWS])
{
    int count = 0, first = -1;
    for (int at = row ? LEFT : 0; at < (row ? window.width : window.height); at++) {
        const bool here = hovers(row ? at : LABEL_X, row ? *row : at);
        if (here && first < 0)
            first = at;
        if (!here && first >= 0) {
            assert_true(count < MAX_ROWS);
            spans[count++] = (Span){first, at - 1, (first + at - 1) / 2.0};
            first = -1;
        }
    }
    return count;
}

/* The vertical middles of the parameters' rows; returns their number. */
static int find_rows(double rows[MAX_ROWS])
{
    Span spans[MAX_ROWS];
    const int count = find_spans(NULL, spans);
    for (int i = 0; i < count; i++)
        rows[i] = spans[i].middle;
    return count;
}

static double only_row(void)
{
    double rows[MAX_ROWS];
    assert_int_equal(find_rows(rows), 1);
    return rows[0];
}

/* Where the controls of a row are, without its name; returns their number. */
static int find_controls(double y, Span controls[MAX_ROWS])
{
    Span spans[MAX_ROWS];
    const int count = find_spans(&y, spans);
    assert_true(count > 0);
    memcpy(controls, spans + 1, (size_t)(count - 1) * sizeof *spans);
    return count - 1;
}

static Span only_control(double y)
{
    Span spans[MAX_ROWS];
    assert_int_equal(find_controls(y, spans), 1);
    return spans[0];
}

/* The parameters. */

static double number;
static int whole, choice, many;
static bool on, flag;
static Vec3 color;
static const char *file;
static const char *const FEW[] = {"one", "two", "three", NULL};
static const char *const MANY[] = {"brass", "bronze", "chrome", "copper", "gold", "jade", NULL};

static Parameter of_number(double min, double max)
{
    return (Parameter){"number",         "a number", PARAMETER_NUMBER,
                       .value = &number, .min = min, .max = max};
}

static void show(const Parameter *parameters)
{
    content.parameters = parameters;
    frames(3);
}

/* Shows one alone; where its control is, and its row. */
static Span show_one(Parameter parameter, double *y)
{
    static Parameter parameters[2];
    parameters[0] = parameter;
    show(parameters);
    *y = only_row();
    return only_control(*y);
}

static const Parameter EVERY[] = {
    {"number", "a number", PARAMETER_NUMBER, .value = &number, .min = 0, .max = 1},
    {"whole", "h", PARAMETER_WHOLE, .value = &whole, .min = 1, .max = 9},
    {"choice", "h", PARAMETER_CHOICE, .value = &choice, .choices = FEW},
    {"many", "h", PARAMETER_CHOICE, .value = &many, .choices = MANY},
    {"switch", "h", PARAMETER_SWITCH, .value = &on},
    {"flag", "h", PARAMETER_FLAG, .value = &flag},
    {"color", "h", PARAMETER_COLOR, .value = &color, .min = 0, .max = 4},
    {"file", "h", PARAMETER_TEXT, .value = &file},
    {.name = NULL},
};
enum { EVERY_COUNT = 8 };

static void set_every(void)
{
    number = 1.0 / 3;
    whole = 5;
    choice = 1;
    many = 4;
    on = true;
    flag = false;
    color = (Vec3){0.1, 2.5, 1.0 / 7};
    file = "models/teapot.obj";
}

static void save_every(ParameterValue values[EVERY_COUNT])
{
    for (int i = 0; i < EVERY_COUNT; i++)
        values[i] = parameter_save(&EVERY[i]);
}

static void assert_every(const ParameterValue values[EVERY_COUNT], uint32_t but)
{
    for (int i = 0; i < EVERY_COUNT; i++)
        assert_int_equal(parameter_equal(&EVERY[i], &values[i]), !(but >> i & 1));
}

/* Whether the command line could have set them. */
static void assert_readable(const Parameter *parameters)
{
    for (; parameters->name; parameters++) {
        char text[PARAMETER_TEXT_SIZE];
        const ParameterValue value = parameter_save(parameters);
        Message message = {0};
        if (!parameter_write(parameters, text, sizeof text))
            continue; /* a flag that is false */
        if (parameters->kind != PARAMETER_TEXT && !parameter_read(parameters, text, &message))
            fail_msg("%s", message.text);
        assert_true(parameter_equal(parameters, &value));
    }
}

/* Sliders. */

#define PANEL_TEST(name) TEST_WITH(0, name, open_panel, close_panel)

PANEL_TEST(test_a_slider_is_dragged)
{
    double y;
    number = 2;
    const Span span = show_one(of_number(-1, 3), &y);
    assert_true(span.to - span.from > 100);
    assert_true(number == 2); /* hovering sets nothing */
    point(span.from + 1, y);
    window.buttons[0] = true;
    frames(2);
    assert_true(number == -1);
    window.x = span.middle;
    frame();
    assert_int_equal(result.changed, 1);
    assert_true(fabs(number - 1) < 0.05);               /* two pixels of 200 */
    assert_true(number * 1000 == round(number * 1000)); /* a thousandth of the range, as decimals */
    assert_true(result.wants_pointer);
    window.x = 999; /* far to the right, and below */
    window.y = 600;
    frame();
    assert_true(number == 3);
    assert_true(result.wants_pointer);
    frame();
    assert_int_equal(result.changed, 0);
    window.buttons[0] = false;
    frames(2);
    assert_true(number == 3);
    assert_false(result.wants_pointer);
}

PANEL_TEST(test_wide_ranges_have_a_logarithmic_slider)
{
    double y;
    number = 0.001;
    const Span span = show_one(of_number(0.001, 1000), &y);
    click(span.middle, y);
    assert_true(number > 0.8 && number < 1.25); /* the geometric mean, to two pixels of 200 */
    click(span.to - 1, y);
    assert_true(number == 1000);
}

PANEL_TEST(test_whole_numbers_stay_whole)
{
    double y;
    whole = 0;
    const Span span = show_one(
        (Parameter){"whole", "h", PARAMETER_WHOLE, .value = &whole, .min = -3, .max = 5}, &y);
    click(span.to - 1, y);
    assert_int_equal(whole, 5);
    click(span.middle, y);
    assert_int_equal(whole, 1);
    click(span.from + 1, y);
    assert_int_equal(whole, -3);
}

/* Typing. */

/* Ctrl and a click on the slider, then text that replaces its own. */
static void type_into(double x, double y, const char *text)
{
    window.control = true;
    click(x, y);
    press_chord(WINDOW_KEY_A);
    frame();
    assert_true(result.wants_keys);
    for (; *text; text++) {
        window.typed[0] = (unsigned char)*text;
        window.typed_count = 1;
        frame();
    }
}

static uint32_t enter(double x, double y, const char *text)
{
    type_into(x, y, text);
    const uint32_t changed = press_key(WINDOW_KEY_ENTER);
    frame();
    assert_false(result.wants_keys);
    return changed;
}

PANEL_TEST(test_a_value_is_typed)
{
    static const struct {
        const char *text;
        double before, after;
    } cases[] = {
        {"0.125", 0.5, 0.125}, {"0.12345678901234566", 0.5, 0.12345678901234566},
        {"1e-3", 0.5, 0.001},  {"7", 0.5, 1},  /* to the end of the range */
        {"-7", 0.5, 0},        {"", 0.5, 0.5}, /* not a number: unchanged */
        {"+-e", 0.5, 0.5},     {"1e999", 0.5, 1},
    };
    double y;
    number = 0;
    const double x = show_one(of_number(0, 1), &y).middle;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        number = cases[i].before;
        const uint32_t changed = enter(x, y, cases[i].text);
        if (number != cases[i].after)
            fail_msg("\"%s\" made %.17g", cases[i].text, number);
        assert_int_equal(changed, cases[i].before != cases[i].after);
    }
}

PANEL_TEST(test_an_incomplete_value_is_ignored)
{
    double y;
    number = 1.0 / 3;
    const double x = show_one(of_number(0, 1), &y).middle;
    type_into(x, y, "0.9");
    assert_true(number == 1.0 / 3);
    press_key(WINDOW_KEY_ESCAPE);
    frames(2);
    assert_false(result.wants_keys);
    assert_true(number == 1.0 / 3); /* bit for bit */
    /* Left without typing. */
    window.control = true;
    click(x, y);
    window.control = false;
    assert_int_equal(press_key(WINDOW_KEY_ENTER), 0);
    assert_true(number == 1.0 / 3);
    /* Left by a click elsewhere: the value is set. */
    type_into(x, y, "0.75");
    assert_int_equal(click(100, 600), 1);
    assert_true(number == 0.75);
}

PANEL_TEST(test_the_clipboard_is_pasted)
{
    double y;
    number = 0.25;
    const double x = show_one(of_number(0, 1), &y).middle;
    snprintf(clipboard, sizeof clipboard, "0.625");
    type_into(x, y, "");
    press_chord(WINDOW_KEY_V);
    assert_int_equal(press_key(WINDOW_KEY_ENTER), 1);
    assert_true(number == 0.625);
    input.get_clipboard = NULL;
    input.set_clipboard = NULL;
    type_into(x, y, "0.5");
    press_chord(WINDOW_KEY_V);
    press_chord(WINDOW_KEY_C);
    press_key(WINDOW_KEY_ENTER);
    assert_true(number == 0.5);
}

/* Choices, switches, colours. */

PANEL_TEST(test_many_choices_unfold)
{
    double y;
    many = 6; /* none of them */
    const double x = show_one(EVERY[3], &y).middle;
    click(x, y);
    assert_true(result.wants_keys); /* Escape closes the list, not the window */
    press_key(WINDOW_KEY_ESCAPE);
    frames(2);
    assert_false(result.wants_keys);
    assert_int_equal(many, 6);
    /* Each choice that is found below. */
    bool seen[6] = {false};
    for (double below = 8; below < 160; below += 4) {
        click(x, y);
        click(x, y + below);
        if (result.wants_keys) /* between two */
            press_key(WINDOW_KEY_ESCAPE);
        frames(2);
        if (many < 6)
            seen[many] = true;
    }
    for (int i = 0; i < 6; i++)
        assert_true(seen[i]);
}

PANEL_TEST(test_switches_and_flags_are_ticked)
{
    double rows[MAX_ROWS];
    on = false;
    flag = true;
    show(&EVERY[4]); /* and what follows */
    assert_int_equal(find_rows(rows), 4);
    const double x = only_control(rows[0]).from + 8;
    assert_int_equal(click(x, rows[0]), 1);
    assert_true(on);
    assert_int_equal(click(x, rows[0]), 1);
    assert_false(on);
    assert_int_equal(click(x, rows[1]), 2);
    assert_false(flag);
}

PANEL_TEST(test_a_color_has_a_slider_for_each_part)
{
    double rows[MAX_ROWS];
    Span spans[MAX_ROWS];
    set_every();
    show(&EVERY[6]);
    assert_int_equal(find_rows(rows), 2);
    assert_int_equal(find_controls(rows[0], spans), 3);
    const Vec3 before = color;
    assert_int_equal(click(spans[1].to - 1, rows[0]), 1);
    assert_true(color.x == before.x && color.y == 4 && color.z == before.z);
    assert_int_equal(enter(spans[0].middle, rows[0], "3.75"), 1);
    assert_true(color.x == 3.75 && color.y == 4 && color.z == before.z);
    /* The picker keeps the bits of what it does not change. */
    click(spans[2].to + 10, rows[0]);
    assert_true(result.wants_keys);
    click(spans[2].to + 40, rows[0] + 60);
    assert_readable(&EVERY[6]);
    press_key(WINDOW_KEY_ESCAPE);
    frames(2);
    assert_false(result.wants_keys);
}

/* A choice, a switch whose states have names, and a text of a few choices or none. */
PANEL_TEST(test_a_few_choices_lie_side_by_side)
{
    static const char *const states[] = {"vertex", "end", NULL};
    static const char *const precisions[] = {"highp", "mediump", NULL};
    const char *precision = NULL;
    const Parameter parameters[] = {
        {"clamp", "h", PARAMETER_SWITCH, .value = &on, .choices = states},
        {"precision", "h", PARAMETER_TEXT, .value = &precision, .choices = precisions,
         .standard = "any"},
        EVERY[2],
        {.name = NULL}};
    double rows[MAX_ROWS];
    Span spans[MAX_ROWS];
    on = false;
    choice = 0;
    show(parameters);
    assert_int_equal(find_rows(rows), 3);
    assert_int_equal(find_controls(rows[0], spans), 2);
    assert_int_equal(click(spans[1].middle, rows[0]), 0);
    assert_int_equal(click(spans[0].middle, rows[0]), 1);
    assert_true(on);
    assert_int_equal(find_controls(rows[1], spans), 3);
    assert_int_equal(click(spans[2].middle, rows[1]), 2);
    assert_ptr_equal(precision, precisions[1]);
    assert_int_equal(click(spans[0].middle, rows[1]), 2);
    assert_null(precision);
    assert_int_equal(find_controls(rows[2], spans), 3);
    for (int i = 2; i >= 0; i--) {
        assert_int_equal(click(spans[i].middle, rows[2]), 4);
        assert_int_equal(choice, i);
        assert_int_equal(click(spans[i].middle, rows[2]), 0);
    }
}

/* Its switch lies below three lines of errors. */
PANEL_TEST(test_the_map_of_the_error_is_switched)
{
    static const unsigned char colors[4][3] = {{0, 0, 255}, {0, 255, 0}, {255, 0, 0}, {9, 9, 9}};
    content.error = (PanelError){.computing = true, .colors = colors};
    frames(3);
    const int computing = result.drawing.vertex_count;
    content.error.known = true;
    content.error.of_mesh = (PanelErrorPart){1.5, 20};
    frames(3);
    assert_true(result.drawing.vertex_count != computing);
    assert_false(result.mapped);
    for (double y = 150; y < 260 && !content.error.mapped; y += 5) {
        tap(LEFT + 24, y);
        content.error.mapped = result.mapped;
    }
    assert_true(content.error.mapped);
    frames(3);
    assert_true(result.mapped);
}

PANEL_TEST(test_tries_say_what_to_look_for)
{
    static const char *const tries[] = {"--shape cube", "--terms specular", NULL};
    static const char *const looks[] = {"its edges", "the highlight alone", NULL};
    const char *tried = NULL;
    content.tries = tries;
    frames(3);
    click(LEFT + 60, 52); /* unfolds them */
    frames(3);
    const int before = result.drawing.vertex_count;
    content.looks = looks;
    frames(3);
    assert_true(result.drawing.vertex_count > before + 4 * 15);
    for (double y = 66; y < 160 && !tried; y += 5) {
        tap(LEFT + 40, y);
        tried = result.tried;
    }
    assert_string_equal(tried, tries[0]);
}

/* Rings over the picture, and never over the panel. */
PANEL_TEST(test_marks_are_drawn_over_the_picture)
{
    const PanelMark marks[] = {{0, 100, 200, false}, {1, LEFT - 2, 300, true}, {2, 800, 10, false}};
    frames(3);
    const int before = result.drawing.vertex_count;
    content.marks = marks;
    content.mark_count = 3;
    frames(3);
    assert_true(result.drawing.vertex_count > before);
    const PanelCommand *first = &result.drawing.commands[0]; /* behind the panel */
    assert_true(first->x + first->width <= LEFT);
    content.view = PANEL_FOLDED;
    frames(3);
    assert_true(result.drawing.vertex_count < before);
}

/* All of them. */

PANEL_TEST(test_every_kind_has_a_row_and_keeps_its_bits)
{
    ParameterValue values[EVERY_COUNT];
    double rows[MAX_ROWS];
    set_every();
    save_every(values);
    show(EVERY);
    assert_int_equal(find_rows(rows), EVERY_COUNT);
    for (int i = 0; i < EVERY_COUNT; i++) /* clicks beside the controls, and hovering */
        click(LABEL_X, rows[i]);
    assert_every(values, 0);
}

PANEL_TEST(test_defaults_come_back)
{
    ParameterValue defaults[EVERY_COUNT], values[EVERY_COUNT];
    double rows[MAX_ROWS];
    set_every();
    save_every(defaults);
    content.defaults = defaults;
    show(EVERY);
    assert_int_equal(find_rows(rows), EVERY_COUNT);
    const double right = only_control(rows[0]).to;
    number = 0.5;
    on = false;
    file = NULL; /* unchanged: it does not belong to the panel */
    save_every(values);
    frames(2);
    /* Somewhere to the right of the slider there is a button. */
    uint32_t changed = 0;
    for (double x = right + 3; x < right + 40 && !changed; x += 3)
        changed = click(x, rows[0]);
    assert_int_equal(changed, 1);
    assert_true(number == 1.0 / 3);
    assert_every(values, 1);
    /* Below the last row there is a button for all. */
    flag = true;
    many = 0;
    frames(2);
    changed = 0;
    for (double y = rows[EVERY_COUNT - 1] + 15; y < rows[EVERY_COUNT - 1] + 60 && !changed; y += 5)
        changed = click(LABEL_X, y);
    assert_int_equal(changed, 1 << 3 | 1 << 4 | 1 << 5);
    assert_null(file);
    file = "models/teapot.obj";
    assert_every(defaults, 0);
}

/* The panel as a whole. */

PANEL_TEST(test_the_title_collapses_it)
{
    set_every();
    show(EVERY);
    const int open = result.drawing.vertex_count;
    click(LEFT + 30, 27);
    assert_int_equal(content.view, PANEL_FOLDED);
    frames(2);
    assert_true(result.drawing.vertex_count < open / 2);
    point(500, 400);
    assert_false(result.wants_pointer);
    click(30, 27);
    assert_int_equal(content.view, PANEL_OPEN);
    frames(2);
    assert_int_equal(panel_next_view(PANEL_OPEN), PANEL_HIDDEN);
    assert_int_equal(panel_next_view(PANEL_FOLDED), PANEL_OPEN);
    assert_int_equal(panel_next_view(PANEL_HIDDEN), PANEL_OPEN);
}

/* No visible part of a triangle is over the picture. */
static void assert_beside(const int place[4])
{
    const PanelDrawing *drawing = &result.drawing;
    for (int i = 0; i < drawing->command_count; i++) {
        const PanelCommand *command = &drawing->commands[i];
        for (int k = command->first; k < command->first + command->count; k++) {
            const PanelVertex *vertex = &drawing->vertices[command->vertex + drawing->indices[k]];
            const double right = fmax(vertex->x, command->x);
            const double bottom = fmin(vertex->y, command->y + command->height);
            const double top = fmax(vertex->y, command->y);
            assert_true(right >= place[2] || bottom <= place[1] || top >= place[1] + place[3]);
        }
    }
}

/* Open beside the picture, folded above it, errors below; at every size of a window. */
PANEL_TEST(test_the_panel_covers_nothing_of_the_picture)
{
    static const int sides[] = {1, 2, 30, 170, 400, 868, 5000};
    static const PanelView views[] = {PANEL_HIDDEN, PANEL_FOLDED, PANEL_OPEN};
    set_every();
    content.parameters = EVERY;
    content.effects = content.command = "some text";
    for (int i = 0; i < 7 * 7 * 3 * 2 * 2; i++) {
        int place[4];
        window.width = sides[i % 7];
        window.height = sides[i / 7 % 7];
        window.scale = i / 147 % 2 + 1;
        content.view = views[i / 49 % 3];
        content.errors =
            i / 294 ? "shader.frag:23: error\n a line\n of source\n and\n a\n hint" : NULL;
        panel_place(content.view, content.errors, window.scale, window.width, window.height, place);
        assert_true(place[2] >= (window.width + 2) / 3 && place[3] >= (window.height + 2) / 3);
        assert_true(place[0] == 0 && place[2] <= window.width);
        assert_true(place[1] >= 0 && place[1] + place[3] <= window.height);
        for (int k = 0; k < 3; k++)
            frame();
        assert_beside(place);
    }
    /* A window that grows by the margins keeps its picture. */
    int margins[PANEL_MARGINS], place[4];
    panel_margins(PANEL_OPEN, false, 1, margins);
    assert_true(margins[PANEL_RIGHT] >= 340 && !margins[PANEL_ABOVE] && !margins[PANEL_BELOW]);
    panel_place(PANEL_OPEN, false, 1, 512 + margins[PANEL_RIGHT], 512, place);
    assert_true(place[1] == 0 && place[2] == 512 && place[3] == 512);
    panel_margins(PANEL_FOLDED, true, NAN, margins);
    panel_place(PANEL_FOLDED, true, NAN, 512, 512 + margins[PANEL_ABOVE] + margins[PANEL_BELOW],
                place);
    assert_true(!margins[PANEL_RIGHT] && margins[PANEL_ABOVE] > 20 && margins[PANEL_BELOW] > 80);
    assert_true(place[1] == margins[PANEL_ABOVE] && place[2] == 512 && place[3] == 512);
}

/* More lines than fit are scrolled. */
PANEL_TEST(test_errors_are_scrolled)
{
    static PanelVertex before[1 << 16];
    content.view = PANEL_HIDDEN;
    content.errors = "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n13\n14\n15\n16\n17\n18\n19\n20";
    frames(3);
    point(100, window.height - 60);
    frames(2);
    assert_true(result.wants_pointer);
    const size_t size = (size_t)result.drawing.vertex_count * sizeof before[0];
    assert_true(size <= sizeof before);
    memcpy(before, result.drawing.vertices, size);
    window.scroll = -3;
    frame();
    window.scroll = 0;
    frames(2);
    assert_true((size_t)result.drawing.vertex_count * sizeof before[0] != size ||
                memcmp(before, result.drawing.vertices, size) != 0);
}

PANEL_TEST(test_the_command_is_copied)
{
    bool copied = false;
    content.command = "LightedCube --size 400x400 # 100%s";
    frames(3);
    for (double y = 60; y < 400 && !copied; y += 5) {
        tap(LEFT + 30, y);
        copied = clipboard[0] != '\0';
        if (!copied && click(LEFT + 30, y) == 0)
            frame(); /* a collapsed section is expanded again */
    }
    assert_true(copied);
    assert_string_equal(clipboard, content.command);
}

PANEL_TEST(test_elsewhere_the_pointer_belongs_to_the_picture)
{
    set_every();
    show(EVERY);
    point(LEFT + 100, 100);
    assert_true(result.wants_pointer);
    point(300, 350);
    assert_false(result.wants_pointer);
    /* A drag that begins on the picture still belongs to the picture over the panel. */
    window.buttons[0] = true;
    frame();
    point(LEFT + 100, 100);
    assert_false(result.wants_pointer);
    window.buttons[0] = false;
    frames(2);
    assert_true(result.wants_pointer);
    assert_false(result.wants_keys);
}

PANEL_TEST(test_what_is_shown_over_the_picture)
{
    static const PanelHelp help[] = {{"space", "pauses"}, {"h", "help"}, {NULL, NULL}};
    content.view = PANEL_HIDDEN;
    frames(2);
    assert_int_equal(result.drawing.command_count, 0);
    content.help = help;
    frames(2);
    assert_true(result.drawing.command_count > 0);
    content.help = NULL;
    content.notice = "saved LightedCube0001.png";
    frames(2);
    assert_true(result.drawing.command_count > 0);
    point(990, 15);
    assert_false(result.wants_pointer);
    content.notice = NULL;
    content.errors = "shader.frag:23: 'u_Colour' undeclared\n    a line of source 100%s";
    frames(2);
    assert_true(result.drawing.command_count > 0);
    content.errors = NULL;
    frame();
    assert_int_equal(result.drawing.command_count, 0);
    assert_false(result.wants_pointer || result.wants_keys);
}

PANEL_TEST(test_two_panels)
{
    Panel *first = panel, *second;
    set_every();
    show(EVERY);
    const int count = result.drawing.vertex_count;
    SUCCEEDS(panel_open(&second, message));
    panel = second;
    content.parameters = NULL;
    frames(3);
    assert_true(result.drawing.vertex_count < count);
    panel_close(second);
    panel = first;
    content.parameters = EVERY;
    frames(3);
    assert_int_equal(result.drawing.vertex_count, count);
    panel_close(NULL);
}

/* Impossible values. */

PANEL_TEST(test_impossible_numbers)
{
    static const double numbers[] = {NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, 0, -1, 1e-300};
    static const int sizes[] = {0, -1, 1, 16, 32767, 32768, INT32_MAX, INT32_MIN};
    set_every();
    content.parameters = EVERY;
    content.errors = content.notice = content.effects = content.command = "some text";
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        window.x = window.y = window.scale = window.scroll = input.seconds = numbers[i];
        content.milliseconds = content.frames_per_second = numbers[i];
        const PanelErrorPart part = {numbers[i], numbers[i]};
        content.error = (PanelError){.known = true,
                                     .computing = i % 2,
                                     .of_computing = part,
                                     .of_mesh = part,
                                     .at_edges = part,
                                     .seconds = numbers[i]};
        frames(2);
        window.typed_count = i % 2 ? -1 : INT32_MAX;
        frame();
        window.width = sizes[i];
        frame();
        window.height = sizes[i];
        frames(2);
        window.width = 1000;
        window.height = 700;
    }
    assert_readable(EVERY);
}

PANEL_TEST(test_impossible_texts)
{
    static char text[100000];
    static const char *const texts[] = {"",    "\xff\xfe\x80", "\xe2\x82", "%s%n%d",
                                        "###", "a\tb\r\n\n",   text};
    memset(text, 'x', sizeof text - 1);
    set_every();
    content.parameters = EVERY;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const PanelHelp help[] = {{texts[i], texts[i]}, {NULL, NULL}};
        file = texts[i];
        content.name = content.effects = content.command = texts[i];
        content.errors = content.notice = texts[i];
        content.help = help;
        frames(3);
        content.help = NULL;
    }
}

/* Clicks, drags and keys everywhere, with ranges and values of every kind. */
PANEL_TEST(test_no_input_makes_an_impossible_value)
{
    static double values[6];
    static int wholes[2];
    static const double ranges[6][2] = {
        {0, 0}, {-DBL_MAX, DBL_MAX}, {DBL_MIN, DBL_MAX}, {0, 1e-300}, {-1, 1}, {1e-9, 1e9}};
    Parameter parameters[EVERY_COUNT + 9] = {{.name = NULL}};
    ParameterValue defaults[EVERY_COUNT + 8];
    static const char letters[] = "0123456789.-+e%xnaif";
    uint64_t random = 12345;
    set_every();
    memcpy(parameters, EVERY, EVERY_COUNT * sizeof *EVERY);
    for (int i = 0; i < 8; i++) {
        parameters[EVERY_COUNT + i] =
            (Parameter){.name = "n",
                        .help = "h",
                        .kind = i < 6 ? PARAMETER_NUMBER : PARAMETER_WHOLE,
                        .value = i < 6 ? (void *)&values[i] : (void *)&wholes[i - 6],
                        .min = i < 6 ? ranges[i][0] : INT32_MIN,
                        .max = i < 6 ? ranges[i][1] : INT32_MAX};
        if (i < 6)
            values[i] = ranges[i][0];
    }
    for (int i = 0; i < EVERY_COUNT + 8; i++)
        defaults[i] = parameter_save(&parameters[i]);
    content.parameters = parameters;
    content.defaults = defaults;
    content.effects = "# object\nwithout a back: it is lit as the front\ndiffuse: both have it";
    content.command = "LightedCube";
    PanelObject objects[20];
    for (int i = 0; i < 20; i++)
        objects[i] = (PanelObject){i % 2 ? "object, Lid: lights 0, 3" : "",
                                   i % 3 ? "diffuse" : "",
                                   i > 9 ? "few" : "diffuse",
                                   i,
                                   {NAN, (float)i, 1e30f}};
    content.objects = (PanelObjects){objects, 20, 20};
    for (int i = 0; i < 6000; i++) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        const unsigned r = (unsigned)(random >> 33);
        if (r % 5 == 0) {
            window.x = LEFT + r / 5 % 360;
            window.y = r / 2000 % 700;
        }
        window.buttons[0] = r / 7 % 3 != 0;
        window.control = r / 11 % 3 == 0;
        window.down[r / 13 % WINDOW_KEY_COUNT] = r / 17 % 4 == 0;
        window.typed[0] = (unsigned char)letters[r / 19 % (sizeof letters - 1)];
        window.typed_count = r / 23 % 3 == 0;
        window.scroll = r / 29 % 40 == 0 ? (int)(r / 31 % 21) - 10 : 0;
        if (r / 37 % 200 == 0)
            content.view = PANEL_OPEN;
        frame();
        assert_readable(parameters);
    }
    assert_int_not_equal(access("imgui.ini", F_OK), 0); /* no file is left */
}

/* The number of the object that has a ring; -1: none. */
static int ringed(void)
{
    double left = HUGE_VAL;
    for (int i = 0; i < result.drawing.vertex_count; i++)
        if (memcmp(result.drawing.vertices[i].color, (uint8_t[]){255, 210, 80, 255}, 4) == 0)
            left = fmin(left, (double)result.drawing.vertices[i].x);
    return left < LEFT ? (int)(left / 20) - 1 : -1;
}

/* Twelve have the same effects, and then eight have others each. */
PANEL_TEST(test_objects_with_the_same_effects_are_a_row_that_opens)
{
    const double x = LEFT + 60;
    double y = 45;
    PanelObject objects[20];
    for (int i = 0; i < 20; i++)
        objects[i] = (PanelObject){"object", "diffuse", i < 12 ? "few" : &"abcdefgh" [i - 12], i, {
                                       (float)(20 * i + 38), 300, 8
                                   }};
    content.effects = "diffuse";
    content.objects = (PanelObjects){objects, 20, 20};
    frames(3);
    for (; y < 690 && ringed() < 0; y += 6) {
        const int before = result.drawing.vertex_count;
        click(x, y);
        if (result.drawing.vertex_count < before - 40) /* it was a heading */
            click(x, y);
    }
    const int first = ringed();
    assert_true(first == 0 || first == 12); /* of the row if that is open, or below it */
    click(x, y - 18);
    click(x, y - 6);
    assert_int_equal(ringed(), 12 - first);
    click(x, y - 6);
    assert_int_equal(ringed(), -1);
}

PANEL_TEST(test_a_value_out_of_its_range_is_shown_and_stays)
{
    const Parameter parameters[] = {of_number(0, 1), EVERY[6], EVERY[2], {.name = NULL}};
    number = NAN;
    color = (Vec3){NAN, INFINITY, -1e300};
    choice = 77;
    show(parameters);
    assert_true(isnan(number) && isnan(color.x) && isinf(color.y) && color.z == -1e300);
    assert_int_equal(choice, 77);
}

int main(void)
{
    if (!panel_probe(NULL))
        return EXIT_SKIPPED; /* the module was not built */
    return testing_run(0, "panel", NULL, NULL);
}
