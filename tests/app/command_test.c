/*
 * The text of the command line that draws the same picture.
 */
#include "app/command.h"
#include "app/command_example.h"
#include "window/backends.h"
#include "window/window.h"

static void assert_command(const Options *options, const char *expected)
{
    char text[1024];
    assert_true(command_write(&example, options, defaults, text, sizeof text));
    assert_string_equal(text, expected);
}

COMMAND_TEST(defaults_are_left_out)
{
    Options options = plain_options(&example);
    assert_command(&options, "Example");
    /* Options that do not change the picture. */
    options.verbose = options.doctor = options.explain = options.watch = true;
    options.orbit.distance = 1;
    assert_command(&options, "Example");
}

COMMAND_TEST(options_are_quoted_for_a_shell)
{
    Options options = plain_options(&example);
    options.output = "the picture.png";
    options.output_given = true;
    options.width = 640;
    options.seconds = -0.7;
    options.canvas.samples = 4;
    options.orbit = (Orbit){.azimuth = -30, .elevation = 10.5};
    options.shaders.folder = "-my 'own' shaders";
    options.alpha = options.full = options.linear = options.show_clipped = true;
    options.clamp_vertex = options.signed_dots = options.normals = true;
    options.compress = 0;
    turn = 1.0 / 3;
    slices = -3;
    shape = 2;
    marks = false;
    sheet = true;
    color = (Vec3){0.5, 0.5, 0.5};
    model = "";
    title = "~/b\nc";
    assert_command(
        &options,
        "Example --output 'the picture.png' --size 640x400 --time=-0.7 --samples 4 "
        "--orbit=-30,10.5 --shaders='-my '\\''own'\\'' shaders' --alpha --compress 0 "
        "--full --clamp vertex --clamp-dots off --linear-light --normals on --show-clipped --turn 0.3333333333333333 "
        "--slices=-3 --shape 'tea pot' --marks off --sheet --color 0.5 --model '' "
        "--title '~/b\nc'");
}

/* What follows from an option is not written, unless it is otherwise; not even its default. */
COMMAND_TEST(what_follows_from_an_option_is_left_out)
{
    const Options options = plain_options(&example);
    style = 1;
    color = (Vec3){0, 0, 1};
    assert_command(&options, "Example --style blue");
    color = defaults[7].color;
    assert_command(&options, "Example --style blue --color 0.2,0.3,0.4");
    style = 2;
    slices = 3;
    assert_command(&options, "Example --style coarse");
    slices = 16;
    assert_command(&options, "Example --style coarse --slices 16");
    assert_true(slices == 16 && style == 2 && color.x == defaults[7].color.x);
}

/* It takes effect first, wherever it stands. */
COMMAND_TEST(options_change_what_follows_from_another)
{
    static const struct {
        const char *words[6];
        int slices;
        Vec3 color;
    } cases[] = {
        {{"--style", "blue"}, 16, {0, 0, 1}},
        {{"--style", "blue", "--color", "1,0,0"}, 16, {1, 0, 0}},
        {{"--color", "1,0,0", "--style=blue"}, 16, {1, 0, 0}},
        {{"--slices", "9", "--style", "coarse"}, 9, {0.2, 0.3, 0.4}},
        {{"--style", "coarse", "--style", "blue"}, 3, {0, 0, 1}},
        {{"--style=plain", "--slices=9"}, 9, {0.2, 0.3, 0.4}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const Usage usage = options_usage(&example);
        Options options;
        Message message = {0};
        char words[7][16] = {"Example"}, *argv[8] = {words[0]};
        int count = 1;
        for (; count < 7 && cases[i].words[count - 1]; count++) {
            snprintf(words[count], sizeof words[count], "%s", cases[i].words[count - 1]);
            argv[count] = words[count];
        }
        put_back(defaults);
        if (options_read(&options, &usage, count, argv, &message) != OPTIONS_RUN)
            fail_msg("%s", message.text);
        assert_int_equal(slices, cases[i].slices);
        assert_memory_equal(&color, &cases[i].color, sizeof color);
    }
}

/* As argv[0] has it, or with the script that the environment names. */
COMMAND_TEST(it_begins_as_the_program_was_started)
{
    static const struct {
        const char *script, *argv0, *start;
    } cases[] = {
        {NULL, "Example", "Example"},
        {NULL, "build/examples/Example", "build/examples/Example"},
        {"", "../my programs/Example", "'../my programs/Example'"},
        {"examples/run", "/build/examples/Example", "examples/run Example"},
        {"it's/run", "Example", "'it'\\''s/run' Example"},
        {NULL, "", "Example"},
        {NULL, NULL, "Example"},
    };
    Options options = plain_options(&example);
    options.seconds = 2;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char start[64];
        unsetenv("LIGHTING_RUN");
        if (cases[i].script)
            setenv("LIGHTING_RUN", cases[i].script, 1);
        assert_true(command_start("Example", cases[i].argv0, start, sizeof start));
        assert_string_equal(start, cases[i].start);
        options.start = start;
        assert_command(&options, formatted("%s --time 2", start));
        assert_false(command_start("Example", cases[i].argv0, start, strlen(cases[i].start)));
        assert_string_equal(start, "");
    }
    unsetenv("LIGHTING_RUN");
}

COMMAND_TEST(a_program_without_a_scene_has_no_scene_options)
{
    const Example lecture = {.name = "Lecture"};
    Options options = plain_options(&lecture);
    char text[64];
    options.linear = options.full = options.cheap = true;
    options.width = options.height = 500;
    options.shaders.precision = "mediump";
    assert_true(command_write(&lecture, &options, NULL, text, sizeof text));
    assert_string_equal(text, "Lecture --size 500x500 --precision mediump");
}

/* A window draws with EGL, whatever the default is. Every environment draws the same. */
COMMAND_TEST(the_backend_is_a_headless_one)
{
    static const struct {
        const char *usual;
        const CanvasBackend *given;
        const char *expected;
    } cases[] = {
        {NULL, NULL, "Example"},
        {NULL, &CANVAS_EGL, "Example"},
        {NULL, &CANVAS_OSMESA, "Example --backend osmesa"},
        {NULL, &CANVAS_WINDOW, "Example"},
        {"osmesa", NULL, "Example --backend osmesa"},
        {"osmesa", &CANVAS_EGL, "Example --backend egl"},
        {"osmesa", &CANVAS_OSMESA, "Example --backend osmesa"},
        {"osmesa", &CANVAS_WINDOW, "Example --backend egl"},
        {"window", NULL, "Example --backend egl"},
        {"window", &CANVAS_WINDOW, "Example --backend egl"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Options options = plain_options(&example);
        options.canvas.backend = cases[i].given;
        unsetenv("LIGHTING_BACKEND");
        if (cases[i].usual)
            setenv("LIGHTING_BACKEND", cases[i].usual, 1);
        assert_command(&options, cases[i].expected);
    }
}

COMMAND_TEST(settings_without_an_option_have_no_command)
{
    const Options options = plain_options(&example);
    ParameterValue set[PARAMETER_COUNT];
    char text[64] = "before";
    memcpy(set, defaults, sizeof set);
    set[6].on = true;
    assert_false(command_write(&example, &options, set, text, sizeof text));
    assert_string_equal(text, "");
    title = NULL;
    assert_false(command_write(&example, &options, defaults, text, sizeof text));
    title = defaults[9].text;
    turn = NAN;
    assert_false(command_write(&example, &options, defaults, text, sizeof text));
    assert_string_equal(text, "");
}

COMMAND_TEST(a_buffer_that_is_too_small_stays_empty)
{
    char whole[256], text[256];
    Options options = plain_options(&example);
    options.shaders.folder = "it's";
    turn = 3;
    assert_true(command_write(&example, &options, defaults, whole, sizeof whole));
    const size_t length = strlen(whole);
    for (size_t size = 0; size <= length + 1; size++) {
        memset(text, '#', sizeof text);
        const bool done = command_write(&example, &options, defaults, text, size);
        assert_true(done == (size == length + 1));
        assert_string_equal(size ? text : "", done ? whole : "");
        for (size_t i = size; i < sizeof text; i++)
            assert_true(text[i] == '#');
    }
}

int main(void)
{
    return testing_run(0, "command", save_defaults, NULL);
}
