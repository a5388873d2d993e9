#include "options.h"

#include "animation.h"
#include "output.h"
#include "parse.h"

#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    OPTION_SAMPLES = 256,
    OPTION_FPS,
    OPTION_FORMAT,
    OPTION_SHADERS,
    OPTION_PRECISION,
    OPTION_PRINT_SHADER,
    OPTION_ALPHA,
    OPTION_COMPRESS,
    OPTION_DOCTOR,
    OPTION_VERSION,
    OPTION_EXPLAIN,
    OPTION_FULL,
    OPTION_CLAMP,
    OPTION_LINEAR,
    OPTION_SHOW_CLIPPED,
    OPTION_ERROR,
    OPTION_ORBIT,
    OPTION_WATCH,
    OPTION_PARAMETER, /* the first of the program's own */
};

static const struct option LONG_OPTIONS[] = {
    {"output", required_argument, NULL, 'o'},
    {"size", required_argument, NULL, 's'},
    {"time", required_argument, NULL, 't'},
    {"angle", required_argument, NULL, 'a'},
    {"frames", required_argument, NULL, 'n'},
    {"fps", required_argument, NULL, OPTION_FPS},
    {"format", required_argument, NULL, OPTION_FORMAT},
    {"samples", required_argument, NULL, OPTION_SAMPLES},
    {"orbit", required_argument, NULL, OPTION_ORBIT},
    {"backend", required_argument, NULL, 'b'},
    {"window", no_argument, NULL, 'w'},
    {"watch", no_argument, NULL, OPTION_WATCH},
    {"shaders", required_argument, NULL, OPTION_SHADERS},
    {"precision", required_argument, NULL, OPTION_PRECISION},
    {"print-shader", optional_argument, NULL, OPTION_PRINT_SHADER},
    {"alpha", no_argument, NULL, OPTION_ALPHA},
    {"compress", required_argument, NULL, OPTION_COMPRESS},
    {"doctor", no_argument, NULL, OPTION_DOCTOR},
    {"verbose", no_argument, NULL, 'v'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, OPTION_VERSION},
};

static const struct option SCENE_OPTIONS[] = {
    {"explain", no_argument, NULL, OPTION_EXPLAIN},
    {"full", no_argument, NULL, OPTION_FULL},
    {"clamp", required_argument, NULL, OPTION_CLAMP},
    {"linear", no_argument, NULL, OPTION_LINEAR},
    {"show-clipped", no_argument, NULL, OPTION_SHOW_CLIPPED},
    {"error", required_argument, NULL, OPTION_ERROR},
};

enum {
    LONG_COUNT = sizeof LONG_OPTIONS / sizeof LONG_OPTIONS[0],
    SCENE_COUNT = sizeof SCENE_OPTIONS / sizeof SCENE_OPTIONS[0],
    MOST_OPTIONS = LONG_COUNT + SCENE_COUNT + OPTIONS_MOST_PARAMETERS + 1,
};

/* Whether a study has this one of LONG_OPTIONS. */
static bool is_of_study(int option)
{
    static const int OF_STUDY[] = {'o',           's', 'b', OPTION_SHADERS,
                                   OPTION_DOCTOR, 'v', 'h', OPTION_VERSION};
    for (size_t i = 0; i < sizeof OF_STUDY / sizeof OF_STUDY[0]; i++)
        if (option == OF_STUDY[i])
            return true;
    return false;
}

/* Every option that a program has, as getopt_long wants them. */
static void gather_options(const Usage *usage, struct option all[MOST_OPTIONS])
{
    int count = 0;
    for (int i = 0; i < LONG_COUNT; i++)
        if (!usage->study || is_of_study(LONG_OPTIONS[i].val))
            all[count++] = LONG_OPTIONS[i];
    for (int i = 0; i < SCENE_COUNT && usage->scene; i++)
        all[count++] = SCENE_OPTIONS[i];
    const Parameter *parameter = usage->parameters;
    for (int i = 0; parameter && parameter[i].name && i < OPTIONS_MOST_PARAMETERS; i++)
        all[count++] =
            (struct option){parameter[i].name,
                            parameter[i].kind == PARAMETER_FLAG ? no_argument : required_argument,
                            NULL, OPTION_PARAMETER + i};
    all[count] = (struct option){NULL, 0, NULL, 0};
}

/* What --help says of the options, each part on its own lines. */
static const char HELP_DRAW[] =
    "  -t, --time SECONDS     the moment to draw; default 0\n"
    "  -a, --angle DEG        the moment at which an animation that turns by 30 degrees a\n"
    "                         second has this angle\n";
static const char HELP_FRAMES[] =
    "  -n, --frames N         N pictures from --time on, default 1: all in one file that is an\n"
    "                         animation, .gif, .webp, .apng, .mp4 or .webm; or each in its own,\n"
    "                         whose name has a number, as in -o turn%03d.png\n"
    "      --fps F            pictures for each second of time; default 30\n"
    "      --format png|y4m|rgb\n"
    "                         what -o - writes: one PNG, the default; a film of all the pictures\n"
    "                         (YUV4MPEG2); or their bytes, red, green, blue, and nothing else\n";
static const char HELP_SAMPLES[] =
    "      --samples N        antialiasing with N samples a pixel; default 0, none\n";
static const char HELP_WINDOW[] =
    "  -w, --window           show it in a window, in which time runs; h tells the keys\n"
    "      --watch            draw again whenever a shader's file changes, until Ctrl-C\n";
static const char HELP_ORBIT[] =
    "      --orbit AZIMUTH,ELEVATION[,DISTANCE]\n"
    "                         move the camera about what it looks at: so many degrees to its\n"
    "                         right and up, and to so many times its distance\n";
static const char HELP_WHERE[] =
    "  -b, --backend egl|osmesa|window\n"
    "                         what draws, the first two headless; default egl (also:\n"
    "                         LIGHTING_BACKEND in the environment)\n"
    "      --shaders DIR      look for shader files here first: edit a copy of a shader and\n"
    "                         see what changes (also: LIGHTING_SHADERS in the environment)\n";
static const char HELP_PICTURE[] =
    "      --precision highp|mediump\n"
    "                         of fragment shaders; default: as the shader says\n"
    "      --print-shader[=vert|frag]\n"
    "                         print what the driver is given, and draw nothing\n"
    "      --alpha            keep the alpha channel: the background is transparent\n"
    "      --compress 0..9    of PNG files: 0 is none, 9 is small; default fast\n";
static const char HELP_SCENE[] =
    "      --explain          say which effects the scene calls for, which it does not, why,\n"
    "                         and what they cost; draw nothing\n"
    "      --full             draw with the program that has every effect\n"
    "      --error E          draw as cheaply as an error of E steps of 1/255 allows\n"
    "      --clamp end|vertex where colours are clamped; default end; vertex is as\n"
    "                         OpenGL 1.1 does\n"
    "      --linear           light in linear space, and encode sRGB at the end\n"
    "      --show-clipped     paint over-exposed pixels magenta\n";
static const char HELP_REST[] =
    "  -v, --verbose          say what runs where, and how long it took\n"
    "      --doctor           say what this machine has for drawing, and what is missing\n"
    "  -h, --help             this text\n"
    "      --version          the version\n";

static void print_output_help(const Usage *usage)
{
    if (usage->gallery)
        printf("Usage: %s [options] [NAME...]\n\n%s\n\n"
               "  -o, --output DIR       the folder for the pictures, the contact sheet and\n"
               "                         index.html; made if need be; default gallery\n",
               usage->name, usage->summary);
    else if (usage->study)
        printf("Usage: %s [options]%s%s\n\n%s\n\n"
               "  -o, --output DIR       the folder for what it finds; made if need be; default\n"
               "                         %s\n",
               usage->name, usage->names ? " " : "", usage->names ? usage->names : "",
               usage->summary, usage->name);
    else
        printf(
            "Usage: %s [options]\n\n%s\n\n"
            "Draws one picture without a window or a display.\n\n"
            "  -o, --output FILE      the picture; default %s.png. The extension names the\n"
            "                         format (.png, .exr, .tif, .jpg, .webp, .mp4...); - writes\n"
            "                         to standard output\n",
            usage->name, usage->summary, usage->name);
}

static void print_help(const Usage *usage)
{
    const Parameter *parameter = usage->parameters;
    const bool draws = !usage->study;
    print_output_help(usage);
    printf("  -s, --size WxH         in pixels; default %dx%d\n",
           usage->width ? usage->width : OPTIONS_SIDE,
           usage->height ? usage->height : OPTIONS_SIDE);
    const bool one = draws && !usage->gallery;
    printf("%s%s%s%s%s%s%s%s%s", draws ? HELP_DRAW : "", one ? HELP_FRAMES : "",
           draws ? HELP_SAMPLES : "", draws ? HELP_ORBIT : "", one ? HELP_WINDOW : "", HELP_WHERE,
           draws ? HELP_PICTURE : "", usage->scene ? HELP_SCENE : "", HELP_REST);
    if (parameter && parameter->name)
        printf("\nOf this program:\n");
    for (; parameter && parameter->name; parameter++)
        parameter_help(parameter, stdout);
    printf("\nExit status: 0, 1 if something failed, 2 if the command line is wrong.\n");
    if (usage->details)
        printf("\n%s", usage->details);
    else if (!usage->gallery)
        printf("\nTry:  %s --size 800x800 --samples 4\n"
               "      %s --frames 90 -o turn%%03d.png\n"
               "      %s --precision highp --print-shader=frag\n",
               usage->name, usage->name, usage->name);
}

static bool unknown_option(const struct option *all, const char *given, Message *message)
{
    const char *names[MOST_OPTIONS] = {NULL};
    char word[64];
    for (int i = 0; all[i].name; i++)
        names[i] = all[i].name;
    const char *start = given + strspn(given, "-");
    snprintf(word, sizeof word, "%.*s", (int)strcspn(start, "="), start);
    /* An abbreviation of several is no option either. */
    const char *first = NULL;
    for (int i = 0; names[i] && word[0]; i++) {
        if (strncmp(names[i], word, strlen(word)) != 0)
            continue;
        if (first && start > given + 1)
            return message_set(message, "%s: could be --%s or --%s", given, first, names[i]);
        first = names[i];
    }
    const char *nearest = word[1] ? parse_nearest(word, names) : NULL;
    if (nearest)
        return message_set(message, "%s: no such option; did you mean --%s?", given, nearest);
    return message_set(message, "%s: no such option; --help lists them", given);
}

bool options_refuse(const struct option *all, int result, int argc, char *argv[], Message *message)
{
    const char *last = argv[optind - 1 < argc ? optind - 1 : argc - 1];
    char shown[3] = {'-', (char)optopt, '\0'};
    if (result == ':')
        return message_set(message, "%s: needs a value; see --help",
                           strncmp(last, "--", 2) == 0 ? last : shown);
    if (!optopt)
        return unknown_option(all, last, message);
    /* Of a known option, this is a value that it does not take; else, a letter among letters. */
    for (const struct option *option = all; option->name; option++)
        if (option->val == optopt)
            return message_set(message, "%s: takes no value", last);
    return unknown_option(all, shown, message);
}

static bool bad_value(const char *option, const char *value, const char *wanted, Message *message)
{
    return message_set(message, "%s %s: must be %s", option, value, wanted);
}

/* "30,-10" or "30,-10,0.5". */
static bool read_orbit(const char *text, Orbit *orbit)
{
    static const double least[] = {-36000, -90, 0.01}, most[] = {36000, 90, 100};
    double values[3] = {0, 0, 1};
    if (parse_numbers(text, least, most, values) < 2)
        return false;
    *orbit = (Orbit){values[0], values[1], values[2]};
    return true;
}

static bool read_backend(Options *options, const char *name, Message *message)
{
    Message why = {0};
    options->canvas.backend = canvas_backend(name, &why);
    return options->canvas.backend || message_set(message, "--backend %s", why.text);
}

static bool read_option(Options *options, int option, const char *value, Message *message)
{
    switch (option) {
    case 'o':
        options->output = value;
        options->output_given = true;
        return value[0] ? true : message_set(message, "--output: the name is empty");
    case 's':
        if (!parse_size(value, &options->width, &options->height))
            return bad_value("--size", value, "WIDTHxHEIGHT, each 1 to 16384, as in 400x400",
                             message);
        options->size_given = true;
        return true;
    case 't':
        if (!parse_number(value, -OPTIONS_MOST_SECONDS, OPTIONS_MOST_SECONDS, &options->seconds))
            return bad_value("--time", value, "seconds, -1e9 to 1e9", message);
        return true;
    case 'a':
        if (!parse_number(value, -3e10, 3e10, &options->seconds))
            return bad_value("--angle", value, "degrees, -3e10 to 3e10", message);
        options->seconds /= OPTIONS_DEGREES_PER_SECOND;
        return true;
    case 'n':
        if (!parse_whole(value, 1, FRAMES_MOST, &options->frames))
            return bad_value("--frames", value, "a whole number, 1 to 1000000", message);
        options->numbered = true;
        return true;
    case OPTION_FPS:
        if (!parse_number(value, 1e-3, 1e6, &options->fps))
            return bad_value("--fps", value, "pictures for each second, 0.001 to 1000000", message);
        return true;
    case OPTION_FORMAT:
        if (strcmp(value, "png") != 0 && strcmp(value, "y4m") != 0 && strcmp(value, "rgb") != 0)
            return bad_value("--format", value, "png, y4m or rgb", message);
        options->format = value;
        return true;
    case OPTION_SAMPLES:
        if (!parse_whole(value, 0, 65536, &options->canvas.samples))
            return bad_value("--samples", value, "a whole number, 0 to 65536", message);
        return true;
    case OPTION_ORBIT:
        if (!read_orbit(value, &options->orbit))
            return bad_value("--orbit", value,
                             "AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,DISTANCE: degrees, -90 to 90 "
                             "for the elevation, and a factor of 0.01 to 100",
                             message);
        return true;
    case 'b':
        return read_backend(options, value, message);
    case 'w':
        options->canvas.backend = &CANVAS_WINDOW;
        return true;
    case OPTION_WATCH:
        options->watch = true;
        return true;
    case OPTION_SHADERS:
        options->shaders.folder = value;
        return value[0] ? true : message_set(message, "--shaders: the name is empty");
    case OPTION_PRECISION:
        if (strcmp(value, "highp") != 0 && strcmp(value, "mediump") != 0)
            return bad_value("--precision", value, "highp or mediump", message);
        options->shaders.precision = value;
        return true;
    case OPTION_PRINT_SHADER:
        if (!value)
            options->shaders.print = SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT;
        else if (strcmp(value, "vert") == 0)
            options->shaders.print = SHADER_PRINT_VERTEX;
        else if (strcmp(value, "frag") == 0)
            options->shaders.print = SHADER_PRINT_FRAGMENT;
        else
            return bad_value("--print-shader", value, "vert or frag, or nothing for both", message);
        return true;
    case OPTION_ALPHA:
        options->alpha = true;
        return true;
    case OPTION_COMPRESS:
        if (!parse_whole(value, 0, 9, &options->compress))
            return bad_value("--compress", value, "a whole number, 0 to 9", message);
        return true;
    case OPTION_DOCTOR:
        options->doctor = true;
        return true;
    case OPTION_EXPLAIN:
        options->explain = true;
        return true;
    case OPTION_FULL:
        options->full = true;
        return true;
    case OPTION_CLAMP:
        if (strcmp(value, "vertex") != 0 && strcmp(value, "end") != 0)
            return bad_value("--clamp", value, "vertex or end", message);
        options->clamp_vertex = strcmp(value, "vertex") == 0;
        return true;
    case OPTION_LINEAR:
        options->linear = true;
        return true;
    case OPTION_SHOW_CLIPPED:
        options->show_clipped = true;
        return true;
    case OPTION_ERROR:
        if (!parse_number(value, 0, 255, &options->error))
            return bad_value("--error", value, "steps of 1/255, 0 to 255", message);
        options->cheap = true;
        return true;
    default: /* 'v' */
        options->verbose = true;
        options->shaders.verbose = true;
        return true;
    }
}

static bool in_window(const Options *options)
{
    const CanvasBackend *given = options->canvas.backend;
    return (given ? given : canvas_default_backend(NULL)) == &CANVAS_WINDOW;
}

/* Standard output: one picture, or a stream of them. */
static bool check_stream(Options *options, Message *message)
{
    options->numbered = false;
    if (options->watch)
        return message_set(message, "--output -: standard output takes one picture, and --watch "
                                    "draws many; name a file");
    if (options->format && strcmp(options->format, "png") != 0)
        options->animation = options->format;
    else if (options->frames > 1)
        return message_set(message,
                           "--output -: standard output takes one picture as PNG, not %d; "
                           "--format y4m or rgb takes them all",
                           options->frames);
    if (isatty(STDOUT_FILENO))
        return message_set(message, "--output -: standard output is a terminal; send it to a "
                                    "file or a pipe");
    return true;
}

/* Whether the pictures go to one file that is an animation, or each to its own. */
static bool find_animation(Options *options, Message *message)
{
    char first[PATH_MAX];
    const char *output = options->output;
    const char *animation = in_window(options) ? NULL : animation_format(output, options->frames);
    /* One picture needs no number, and nor does an animation. */
    if (options->numbered && (options->frames == 1 || animation))
        options->numbered = output_numbered(output, 0, first, sizeof first, NULL);
    if (!options->numbered)
        options->animation = animation;
    else if (animation_format(output, 1))
        return message_set(message, "%s: a .%s holds all the pictures; leave the number out",
                           output, animation_format(output, 1));
    return !options->numbered || output_numbered(output, 0, first, sizeof first, message);
}

static bool check_animation(const Options *options, Message *message)
{
    const AnimationOptions animation = {.format = options->animation,
                                        .width = options->width,
                                        .height = options->height,
                                        .fps = options->fps,
                                        .alpha = options->alpha};
    return animation_check(&animation, message);
}

/* What the command line alone shows to be wrong about the output. */
static bool check_output(Options *options, const Usage *usage, Message *message)
{
    char format[16];
    const char *output = options->output;
    if (options->doctor || options->shaders.print || options->explain)
        return true;
    if (usage->gallery || usage->study)
        return strcmp(output, "-") != 0
                   ? true
                   : message_set(message, "--output -: a %s is a folder, not one picture",
                                 usage->gallery ? "gallery" : "study");
    if (in_window(options) && options->numbered)
        return message_set(message, "--frames: in a window time runs without end; leave out "
                                    "--window to draw pictures to files");
    if (in_window(options) && strcmp(output, "-") == 0)
        return message_set(message, "--output -: in a window the key s saves a picture, as often "
                                    "as it is pressed; name a file");
    if (strcmp(output, "-") == 0)
        return check_stream(options, message) &&
               (!options->animation || check_animation(options, message));
    if (options->format)
        return message_set(message,
                           "--format %s: is of standard output, -o -; the extension names the "
                           "format of a file",
                           options->format);
    const size_t length = strlen(output);
    if (output[length - 1] == '/')
        return message_set(message, "%s: is a folder; name a file in it", output);
    if (!find_animation(options, message))
        return false;
    if (options->animation)
        return check_animation(options, message);
    if (!image_format(output, format, message))
        return false;
    if (options->alpha && !image_format_has_alpha(format))
        return message_set(message,
                           "%s: .%s has no alpha channel; leave out --alpha, or name a .png",
                           output, format);
    return true;
}

/* Whether a gallery, which draws every program once, has no use for an option. */
static bool refuse_for_gallery(int option, Message *message)
{
    static const struct {
        int option;
        const char *name;
    } refused[] = {{'n', "--frames"},
                   {OPTION_FPS, "--fps"},
                   {OPTION_FORMAT, "--format"},
                   {'w', "--window"},
                   {OPTION_WATCH, "--watch"}};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        if (refused[i].option == option) {
            message_set(message, "%s: a gallery has one picture of each program", refused[i].name);
            return true;
        }
    }
    return false;
}

OptionsResult options_read(Options *options, const Usage *usage, int argc, char *argv[],
                           Message *message)
{
    *options = (Options){.width = usage->width ? usage->width : OPTIONS_SIDE,
                         .height = usage->height ? usage->height : OPTIONS_SIDE,
                         .frames = 1,
                         .fps = OPTIONS_FPS,
                         .compress = IMAGE_COMPRESS_DEFAULT};
    optind = 0; /* from the beginning, however often this is called */
    opterr = 0;
    struct option all[MOST_OPTIONS];
    int option;
    gather_options(usage, all);
    const char *letters = usage->study ? ":o:s:b:vh" : ":o:s:t:a:n:b:wvh";
    while ((option = getopt_long(argc, argv, letters, all, NULL)) != -1) {
        if (option == 'h') {
            print_help(usage);
            return OPTIONS_ANSWERED;
        }
        if (option == OPTION_VERSION) {
            printf("%s (lighting) %s\n", usage->name, VERSION);
            return OPTIONS_ANSWERED;
        }
        if (option == '?' || option == ':') {
            options_refuse(all, option, argc, argv, message);
            return OPTIONS_BAD;
        }
        if (usage->gallery && refuse_for_gallery(option, message))
            return OPTIONS_BAD;
        if (option >= OPTION_PARAMETER
                ? !parameter_read(&usage->parameters[option - OPTION_PARAMETER], optarg, message)
                : !read_option(options, option, optarg, message))
            return OPTIONS_BAD;
    }
    options->names = argv + optind;
    if (!usage->gallery && !usage->names && optind < argc) {
        message_set(message, "%s: not an option; --help lists them, -o %s", argv[optind],
                    usage->study ? "DIR names the folder" : "FILE names the picture");
        return OPTIONS_BAD;
    }
    if (!options->output_given) {
        if (usage->gallery || usage->study)
            snprintf(options->default_output, sizeof options->default_output, "%s", usage->name);
        else
            snprintf(options->default_output, sizeof options->default_output, "%s%s.png",
                     usage->name, options->frames > 1 ? "%04d" : "");
        options->output = options->default_output;
    }
    if (options->cheap && options->shaders.precision) {
        message_set(message, "--error and --precision: one of them, for --error chooses the "
                             "precision, too");
        return OPTIONS_BAD;
    }
    if (options->watch && !options->doctor && (options->shaders.print || options->explain)) {
        const char *other = options->explain ? "--explain" : "--print-shader";
        message_set(message, "--watch and %s: one of them, for %s draws nothing", other, other);
        return OPTIONS_BAD;
    }
    return check_output(options, usage, message) ? OPTIONS_RUN : OPTIONS_BAD;
}

/* Ends the process as the signal does by itself, but for names of files that are not whole. */
static void end_by_signal(int number)
{
    const struct sigaction standard = {.sa_handler = SIG_DFL};
    output_unlink_temporaries();
    sigaction(number, &standard, NULL);
    raise(number); /* delivered when this returns */
}

void options_catch_signals(void (*handler)(int), int flags)
{
    static const int ending[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction action = {.sa_handler = handler, .sa_flags = flags};
    struct sigaction before;
    for (size_t i = 0; i < sizeof ending / sizeof ending[0]; i++)
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(ending[i], &action, NULL);
}

void options_prepare_process(void)
{
    for (int file = 0; file <= 2; file++) {
        /* Read-only for the outputs too, so that writing to what was closed fails. */
        if (fcntl(file, F_GETFD) < 0 && errno == EBADF)
            (void)!open("/dev/null", O_RDONLY);
    }
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    options_catch_signals(end_by_signal, SA_RESTART);
}

int options_fail(const char *program, const Message *message, int code)
{
    fflush(stdout);
    if (message->located)
        fprintf(stderr, "%s\n", message->text);
    else
        fprintf(stderr, "%s: %s\n", program, message->text[0] ? message->text : "failed");
    return code;
}

int options_finish(const char *program, int code)
{
    Message message = {0};
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        /* An earlier write may have failed, whose reason is gone. */
        message_set(&message, "standard output: cannot write%s%s", errno ? ": " : "",
                    errno ? strerror(errno) : "");
        return options_fail(program, &message, EXIT_FAILED);
    }
    return code;
}

bool options_begin(Options *options, const Usage *usage, int argc, char *argv[], int *code)
{
    Message message = {0};
    options_prepare_process();
    switch (options_read(options, usage, argc, argv, &message)) {
    case OPTIONS_ANSWERED:
        *code = options_finish(usage->name, 0);
        return false;
    case OPTIONS_BAD:
        *code = options_fail(usage->name, &message, EXIT_USAGE);
        return false;
    case OPTIONS_RUN:
        break;
    }
    return true;
}
