/*
 * The command line that draws the same picture: a real shell and options_read get from it exactly
 * the settings that it was written for.
 */
#include "app/command.h"
#include "app/command_example.h"
#include "base/random.h"
#include "images/image_file.h"
#include "window/backends.h"

#include <unistd.h>

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
    FILE *file = fopen(script, "w");
    assert_non_null(file);
    fprintf(file, "Example() { printf '%%d\\0Example\\0' $(($# + 1)); "
                  "[ $# = 0 ] || printf '%%s\\0' \"$@\"; }\n");
    for (int i = 0; i < COUNT; i++)
        fprintf(file, "%s\n", settings[i].command);
    assert_int_equal(fclose(file), 0);
    return popen(formatted("exec sh %s", script), "r");
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

TEST_MAIN("command, through a shell", save_defaults, NULL)
