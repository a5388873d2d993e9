/*
 * The command line that draws the same picture: its text, and that a real shell and options_read
 * get from it exactly the settings that it was written for.
 */
#include "app/command.h"
#include "base/random.h"
#include "images/image_file.h"
#include "scene/scene_example.h"
#include "support/testing.h"
#include "window/backends.h"
#include "window/window.h"

#include <unistd.h>

/* An example with parameters of every kind. */

static const char *const SHAPES[] = {"sphere", "cube", "tea pot", NULL};
static double turn = 0.1, wide = 0;
static int slices = 16, shape = 1;
static bool marks = true, sheet, always;
static Vec3 color = {0.2, 0.3, 0.4};
static const char *model, *title = "a title";

/* A style is a color and slices, which other options change. */
static const char *const STYLES[] = {"plain", "blue", "coarse", NULL};
static int style;

static void style_changed(const Parameter *parameter)
{
    assert_ptr_equal(parameter->value, &style);
    if (style == 1)
        color = (Vec3){0, 0, 1};
    if (style == 2)
        slices = 3;
}

static const Parameter PARAMETERS[] = {
    {"turn", NULL, PARAMETER_NUMBER, .value = &turn, .min = -1e300, .max = 1e300},
    {"wide", NULL, PARAMETER_NUMBER, .value = &wide, .min = 0, .max = 1},
    {"slices", NULL, PARAMETER_WHOLE, .value = &slices, .min = -9, .max = 512},
    {"shape", NULL, PARAMETER_CHOICE, .value = &shape, .choices = SHAPES},
    {"marks", NULL, PARAMETER_SWITCH, .value = &marks},
    {"sheet", NULL, PARAMETER_FLAG, .value = &sheet},
    {"always", NULL, PARAMETER_FLAG, .value = &always},
    {"color", NULL, PARAMETER_COLOR, .value = &color, .min = -1, .max = 2},
    {"model", NULL, PARAMETER_TEXT, .value = &model},
    {"title", NULL, PARAMETER_TEXT, .value = &title},
    {"style", NULL, PARAMETER_CHOICE, .value = &style, .choices = STYLES, .changed = style_changed},
    {.name = NULL},
};

enum { PARAMETER_COUNT = sizeof PARAMETERS / sizeof PARAMETERS[0] - 1 };

static ParameterValue defaults[PARAMETER_COUNT];

static void no_scene(double seconds, int view, Scene *scene)
{
    (void)seconds, (void)view, (void)scene;
}

static const Example example = {.name = "Example",
                                .width = 500,
                                .kind = &SCENE_KIND,
                                .content = &(const SceneExample){.make = no_scene},
                                .parameters = PARAMETERS};

static void put_back(const ParameterValue *values)
{
    for (int i = 0; i < PARAMETER_COUNT; i++)
        parameter_restore(&PARAMETERS[i], values[i]);
}

FIXTURE(save_defaults)
{
    for (int i = 0; i < PARAMETER_COUNT; i++)
        defaults[i] = parameter_save(&PARAMETERS[i]);
    unsetenv("LIGHTING_BACKEND");
}

FIXTURE(restore_defaults)
{
    put_back(defaults);
    unsetenv("LIGHTING_BACKEND");
}

#define COMMAND_TEST(name) TEST_WITH(0, name, NULL, restore_defaults)

/* The options of an empty command line, without the default name of the output. */
static Options plain_options(const Example *of)
{
    const Usage usage = options_usage(of);
    char name[] = "Example", *argv[] = {name, NULL};
    Options options;
    Message message = {0};
    assert_int_equal(options_read(&options, &usage, 1, argv, &message), OPTIONS_RUN);
    options.output = NULL;
    return options;
}

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
        char start[64], expected[128];
        unsetenv("LIGHTING_RUN");
        if (cases[i].script)
            setenv("LIGHTING_RUN", cases[i].script, 1);
        assert_true(command_start("Example", cases[i].argv0, start, sizeof start));
        assert_string_equal(start, cases[i].start);
        options.start = start;
        snprintf(expected, sizeof expected, "%s --time 2", start);
        assert_command(&options, expected);
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

/* Any settings, through a shell and back. */

enum { COUNT = 2000, MAX_WORDS = 64 };
static const unsigned long long SEED = 20;

static Random random_state;

static int below(int limit)
{
    return random_below(&random_state, limit);
}

static double uniform(void)
{
    return random_between(&random_state, 0, 1);
}

/* Short decimals, values between them, any size, and the ends of the range. */
static double any_number(double min, double max)
{
    double number = 0;
    switch (below(6)) {
    case 0:
        number = min + uniform() * (max - min);
        break;
    case 1:
        number = (below(2001) - 1000) / pow(10, below(4));
        break;
    case 2:
        number = (uniform() - 0.5) * pow(10, below(640) - 330);
        break;
    case 3:
        number = below(2) ? min : max;
        break;
    case 4:
        number = nextafter(below(100) / 100.0, below(2) ? 1000 : -1000);
        break;
    default:
        number = (double)(float)uniform();
    }
    return fmin(fmax(number, min), max);
}

/* An awkward file name, to be freed. `numbered`: with the %d that --output needs. */
static char *any_name(const char *end, bool numbered)
{
    static const char *const odd[] = {" ",  "'",  "\"", "\\", "\n",  "\t", "$",  "`",    "!",
                                      "*",  "?",  "[",  "]",  "{",   "}",  "(",  ")",    "<",
                                      ">",  "|",  "&",  ";",  "#",   "~",  "=",  "%",    "-",
                                      "--", "+",  ",",  ":",  "@",   "^",  "ä",  "\x81", "\x88",
                                      "\1", "\7", "''", "$(", "\\n", "&&", "%s", "\xFF", "\r"};
    char name[512] = "";
    for (int i = below(24) + (end[0] == '.'); i > 0; i--) {
        const char letter[2] = {(char)('a' + below(26)), '\0'};
        const char *part = below(2) ? letter : odd[below((int)(sizeof odd / sizeof odd[0]))];
        if (!numbered || !strchr(part, '%'))
            strcat(name, part);
    }
    strcat(name, numbered ? "%03d" : "");
    strcat(name, end);
    return strdup(name);
}

typedef struct Setting {
    Options options;
    ParameterValue values[PARAMETER_COUNT];
    char *names[4]; /* what is to be freed */
    char *command;
} Setting;

static void any_output(Setting *setting)
{
    Options *options = &setting->options;
    options->output_given = true;
    if (below(8) == 0 && !isatty(STDOUT_FILENO)) {
        options->output = "-";
        options->format = below(2) ? "png" : NULL;
        return;
    }
    options->numbered = below(2);
    options->frames = options->numbered ? 1 + below(5) : 1;
    options->fps = below(2) ? 30 : any_number(1e-3, 1e6);
    options->output = setting->names[0] = any_name(".png", options->numbered);
}

static void any_options(Setting *setting)
{
    static const CanvasBackend *const backends[] = {NULL, &CANVAS_EGL, &CANVAS_OSMESA};
    Options *options = &setting->options;
    *options = plain_options(&example);
    if (below(3))
        any_output(setting);
    if (below(2)) {
        options->width = 1 + below(16384);
        options->height = 1 + below(16384);
    }
    if (below(2))
        options->seconds = any_number(-1e9, 1e9);
    options->canvas.samples = below(3) ? 0 : below(65537);
    if (below(2))
        options->orbit =
            (Orbit){any_number(-36000, 36000), any_number(-90, 90),
                    below(2) ? any_number(0.01, 100) : 0, below(2) ? any_number(-36000, 36000) : 0};
    options->canvas.backend = backends[below(3)];
    if (below(3) == 0)
        options->shaders.folder = setting->names[1] = any_name("x", false);
    options->alpha = below(2);
    options->compress = below(2) ? IMAGE_COMPRESS_DEFAULT : below(10);
    options->full = below(2);
    options->clamp_vertex = below(2);
    options->signed_dots = below(2);
    options->normals = below(2);
    options->linear = below(2);
    options->show_clipped = below(2);
    options->cheap = below(3) == 0;
    options->error = options->cheap ? any_number(0, 255) : 0;
    if (!options->cheap && below(2))
        options->shaders.precision = below(2) ? "highp" : "mediump";
}

static void any_parameters(Setting *setting)
{
    ParameterValue *values = setting->values;
    memcpy(values, defaults, sizeof setting->values);
    if (below(2))
        values[0].number = any_number(-1e300, 1e300);
    if (below(2))
        values[1].number = any_number(0, 1);
    values[2].whole = below(2) ? 16 : below(522) - 9;
    values[3].whole = below(3);
    values[4].on = below(2);
    values[5].on = below(2);
    if (below(2))
        values[7].color = (Vec3){any_number(-1, 2), any_number(-1, 2), any_number(-1, 2)};
    if (below(4) == 0)
        values[7].color.y = values[7].color.z = values[7].color.x;
    if (below(2))
        values[8].text = setting->names[2] = any_name("", false);
    if (below(2))
        values[9].text = setting->names[3] = any_name("", false);
    values[10].whole = below(3);
    if (values[10].whole == 1 && below(2)) /* what follows from it */
        values[7].color = (Vec3){0, 0, 1};
    if (values[10].whole == 2 && below(2))
        values[2].whole = 3;
}

static void write_setting(Setting *setting)
{
    static char text[16384];
    put_back(setting->values);
    if (!command_write(&example, &setting->options, defaults, text, sizeof text))
        fail_msg("no command");
    setting->command = strdup(text);
}

static bool same_text(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

static const CanvasBackend *backend_of(const Options *options)
{
    return options->canvas.backend ? options->canvas.backend : backend_default(NULL);
}

static bool same_options(const Options *a, const Options *b)
{
    const double far_a = a->orbit.distance > 0 ? a->orbit.distance : 1;
    const double far_b = b->orbit.distance > 0 ? b->orbit.distance : 1;
    return a->output_given == b->output_given &&
           (!a->output_given || same_text(a->output, b->output)) && a->width == b->width &&
           a->height == b->height && a->seconds == b->seconds && a->frames == b->frames &&
           a->numbered == b->numbered && a->fps == b->fps && same_text(a->format, b->format) &&
           a->canvas.samples == b->canvas.samples && a->orbit.azimuth == b->orbit.azimuth &&
           a->orbit.elevation == b->orbit.elevation && far_a == far_b &&
           a->orbit.roll == b->orbit.roll && backend_of(a) == backend_of(b) &&
           same_text(a->shaders.folder, b->shaders.folder) &&
           same_text(a->shaders.precision, b->shaders.precision) && a->alpha == b->alpha &&
           a->compress == b->compress && a->full == b->full && a->cheap == b->cheap &&
           a->error == b->error && a->clamp_vertex == b->clamp_vertex &&
           a->signed_dots == b->signed_dots && a->normals == b->normals && a->linear == b->linear &&
           a->show_clipped == b->show_clipped && !b->verbose && !b->watch && !b->explain;
}

/* The words of a command, as the shell splits it: their number, and then each. */
static void check_words(const Setting *setting, int count, char *words[])
{
    const Usage usage = options_usage(&example);
    Options options;
    Message message = {0};
    static char again[16384];
    put_back(defaults);
    if (options_read(&options, &usage, count, words, &message) != OPTIONS_RUN)
        fail_msg("%s\n%s", message.text, setting->command);
    if (!same_options(&setting->options, &options))
        fail_msg("other options: %s", setting->command);
    for (int i = 0; i < PARAMETER_COUNT; i++)
        if (!parameter_equal(&PARAMETERS[i], &setting->values[i]))
            fail_msg("another --%s: %s", PARAMETERS[i].name, setting->command);
    assert_true(command_write(&example, &options, defaults, again, sizeof again));
    assert_string_equal(again, setting->command);
}

/* Runs every command with a function of the shell that writes its words, each ended by a NUL. */
static FILE *run_shell(const Setting *settings, const char *script)
{
    char shell[64];
    FILE *file = fopen(script, "w");
    assert_non_null(file);
    fprintf(file, "Example() { printf '%%d\\0Example\\0' $(($# + 1)); "
                  "[ $# = 0 ] || printf '%%s\\0' \"$@\"; }\n");
    for (int i = 0; i < COUNT; i++)
        fprintf(file, "%s\n", settings[i].command);
    assert_int_equal(fclose(file), 0);
    snprintf(shell, sizeof shell, "exec sh %s", script);
    return popen(shell, "r");
}

COMMAND_TEST(any_settings_survive_a_shell)
{
    Setting *settings = calloc(COUNT, sizeof *settings);
    char script[] = "/tmp/command-XXXXXX";
    const int descriptor = mkstemp(script);
    size_t length = 0;
    assert_non_null(settings);
    assert_true(descriptor >= 0);
    close(descriptor);
    random_state.state = SEED;
    print_message("seed %llu\n", SEED);
    for (int i = 0; i < COUNT; i++) {
        any_options(&settings[i]);
        any_parameters(&settings[i]);
        write_setting(&settings[i]);
        length += strlen(settings[i].command);
    }
    FILE *shell = run_shell(settings, script);
    assert_non_null(shell);
    for (int i = 0; i < COUNT; i++) {
        char *words[MAX_WORDS + 1] = {NULL};
        size_t sizes[MAX_WORDS + 1] = {0};
        char *number = NULL;
        size_t size = 0;
        assert_true(getdelim(&number, &size, '\0', shell) > 0);
        const int count = atoi(number);
        assert_in_range(count, 1, MAX_WORDS);
        for (int k = 0; k < count; k++)
            assert_true(getdelim(&words[k], &sizes[k], '\0', shell) > 0);
        char *given[MAX_WORDS + 1]; /* reading moves the words that are not options */
        memcpy(given, words, sizeof given);
        check_words(&settings[i], count, given);
        put_back(defaults);
        free(number);
        for (int k = 0; k <= count; k++)
            free(words[k]);
    }
    assert_int_equal(fgetc(shell), EOF);
    assert_int_equal(pclose(shell), 0);
    unlink(script);
    print_message("%d commands of %.0f characters in the mean, the last: %s\n", COUNT,
                  (double)length / COUNT, settings[COUNT - 1].command);
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < 4; k++)
            free(settings[i].names[k]);
        free(settings[i].command);
    }
    free(settings);
}

int main(void)
{
    return testing_run(0, "command", save_defaults, NULL);
}
