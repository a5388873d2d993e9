/* The options that programs of every kind have, in the order of --help. */
#include "app/options_table.h"

#include <limits.h>
#include <string.h>

enum {
    FILM = PROGRAM_ONE | PROGRAM_DIAGRAM | NOT_GALLERY,
    GL_FILM = PROGRAM_ONE | NOT_DIAGRAM | NOT_GALLERY,
    DRAWS = PROGRAM_ONE | PROGRAM_DIAGRAM | PROGRAM_GALLERY,
    GL_DRAWS = PROGRAM_ONE | PROGRAM_GALLERY | NOT_DIAGRAM,
    GL_ALL = GL_DRAWS | PROGRAM_STUDY,
    ALL = DRAWS | PROGRAM_STUDY,
};

static const char *const FORMATS[] = {"png", "y4m", "rgb", "json", NULL};
static const char *const DIAGRAM_FORMATS[] = {"png", "y4m", "rgb", "svg", "pdf", NULL};
static const char *const BACKEND_NAMES[] = {"egl", "osmesa", "window", NULL};
static const char *const PRECISIONS[] = {"highp", "mediump", NULL};
static const char *const STAGES[] = {"vert", "frag", NULL};
static const char *const FORMS[] = {"man", "bash", "zsh", "fish", NULL};

#define FORMAT_HELP                                                                                \
    "what -o - writes: one PNG (default); all pictures as YUV4MPEG2 video (y4m); or their raw "    \
    "bytes: red, green, blue (rgb)"
#define SAMPLES_HELP "multisampling with N samples per pixel"

/* Before those of the kind. */
static const Parameter FIRST[] = {
    {"output",
     "the picture; the extension names the format (.png, .exr, .tif, .jpg, .webp, "
     ".mp4...); - writes to standard output",
     PARAMETER_TEXT, AT(output), .min = 1, .letter = 'o', .placeholder = "FILE",
     GIVEN_AT(output_given), .programs = PROGRAM_ONE},
    {"output",
     "the picture; the extension names the format (.svg, .pdf, .png, .tif, .jpg, .webp, "
     ".mp4...); - writes to standard output",
     PARAMETER_TEXT, AT(output), .min = 1, .letter = 'o', .placeholder = "FILE",
     GIVEN_AT(output_given), .programs = PROGRAM_DIAGRAM},
    {"output", "the folder for the pictures and index.html; created if missing", PARAMETER_TEXT,
     AT(output), .min = 1, .letter = 'o', .placeholder = "DIR", GIVEN_AT(output_given),
     .programs = PROGRAM_GALLERY},
    {"output", "the folder for the results; created if missing", PARAMETER_TEXT, AT(output),
     .min = 1, .letter = 'o', .placeholder = "DIR", GIVEN_AT(output_given),
     .programs = PROGRAM_STUDY},
    {"size", "in pixels", PARAMETER_TEXT, .letter = 's', .codec = &OPTION_SIZE, AT(width),
     GIVEN_AT(size_given), .programs = ALL},
    {"time", "the time to draw", PARAMETER_NUMBER, .min = -OPTIONS_MAX_SECONDS,
     .max = OPTIONS_MAX_SECONDS, .letter = 't', .placeholder = "SECONDS", AT(seconds),
     GIVEN_AT(seconds_given), .programs = DRAWS},
    {"angle", "the time at which an animation of 30 degrees per second reaches this angle",
     PARAMETER_TEXT, .letter = 'a', .standard = "", .codec = &OPTION_ANGLE, AT(seconds),
     GIVEN_AT(seconds_given), .programs = DRAWS | ASIDE},
    {"frames",
     "N pictures from --time on: all in one file if that is an animation (.gif, .webp, .apng, "
     ".mp4, .webm); otherwise one file each, with a number in its name, as in -o turn%03d.png",
     PARAMETER_WHOLE, .min = 1, .max = FRAMES_MAX, .letter = 'n', .placeholder = "N", AT(frames),
     GIVEN_AT(numbered), .programs = FILM},
    {"fps", "pictures per second", PARAMETER_NUMBER, .min = 1e-3, .max = 1e6, .placeholder = "F",
     AT(fps), .programs = FILM},
    {"part",
     "draw only the I-th of N parts of --frames, for several processes or machines. Those "
     "of an animation go to the folder FILE.parts as PNG. PNG that are there already are kept. "
     "examples/run cluster does this for all parts",
     PARAMETER_TEXT, AT(part), .standard = "", .codec = &OPTION_PART,
     .programs = PROGRAM_ONE | PROGRAM_DIAGRAM | ASIDE},
    {"part",
     "draw only the I-th of N parts, for several processes or machines that share the folder "
     "DIR.parts; examples/run cluster does this for all parts",
     PARAMETER_TEXT, AT(part), .standard = "", .codec = &OPTION_PART,
     .programs = PROGRAM_GALLERY | ASIDE},
    {"merge", "draw nothing: put the animation together when all parts are drawn", PARAMETER_FLAG,
     AT(merge), .programs = PROGRAM_ONE | PROGRAM_DIAGRAM | ASIDE},
    {"merge", "draw nothing: write index.html, too, when all parts are drawn", PARAMETER_FLAG,
     AT(merge), .programs = PROGRAM_GALLERY | ASIDE},
    {"format", FORMAT_HELP, PARAMETER_TEXT, AT(format), .choices = FORMATS,
     .programs = PROGRAM_ONE | NOT_GALLERY},
    {"format", FORMAT_HELP, PARAMETER_TEXT, AT(format), .choices = DIAGRAM_FORMATS,
     .programs = PROGRAM_DIAGRAM},
    {"samples", SAMPLES_HELP, PARAMETER_WHOLE, AT(canvas.samples), .max = INT_MAX,
     .placeholder = "N", .standard = "0 (off)", .programs = PROGRAM_ONE | NOT_DIAGRAM},
    {"samples", SAMPLES_HELP, PARAMETER_WHOLE, AT(canvas.samples), .max = INT_MAX,
     .placeholder = "N", .standard = "4", .programs = PROGRAM_GALLERY},
    {"orbit",
     "move the camera about its target: degrees to the right and up, a factor for the distance, "
     "and degrees by which the picture rolls counter-clockwise",
     PARAMETER_TEXT, .codec = &OPTION_ORBIT, AT(orbit), .programs = GL_DRAWS},
    {"window", "run in a window; h lists the keys", PARAMETER_FLAG, .letter = 'w',
     .codec = &OPTION_WINDOW, AT(canvas.backend), .programs = FILM | ASIDE},
    {"watch", "draw again whenever a shader file changes, until Ctrl-C", PARAMETER_FLAG, AT(watch),
     .programs = GL_FILM | ASIDE},
    {"backend",
     "what draws; egl and osmesa need no display; also LIGHTING_BACKEND in the environment",
     PARAMETER_TEXT, .choices = BACKEND_NAMES, .letter = 'b', .standard = "egl",
     .codec = &OPTION_BACKEND, AT(canvas.backend), .programs = GL_ALL},
    {"shaders",
     "look for shader files here first, for example your own copies; also LIGHTING_SHADERS in the "
     "environment",
     PARAMETER_TEXT, .min = 1, .placeholder = "DIR", AT(shaders.folder), .programs = GL_ALL},
    {"precision", "of fragment shaders", PARAMETER_TEXT, .choices = PRECISIONS,
     .standard = "as the shader says", AT(shaders.precision), .programs = GL_DRAWS},
    {"print-shader", "print the source that the driver gets; draw nothing", PARAMETER_FLAG,
     .choices = STAGES, .codec = &OPTION_PRINT, AT(shaders.print), .programs = GL_DRAWS | ASIDE},
    {"probe",
     "explain a pixel, column X and row Y from the upper left: what each line of its shader "
     "computes, and exactly; draw nothing",
     PARAMETER_TEXT, .standard = "", .codec = &OPTION_PROBE, AT(probe),
     .programs = GL_FILM | ASIDE},
    {"show",
     "draw a variable of the shaders instead, as in normal.z; error: what rounding changes; "
     "error:NAME: the part of that which NAME causes; blame: the line that causes most",
     PARAMETER_TEXT, .min = 1, .placeholder = "NAME", AT(show), .programs = GL_FILM},
    {"arithmetic",
     "draw what another device would: llvmpipe, llvmpipe-128, softpipe, nvidia, half, float, or a "
     "file or link with what precision measured there; with --probe and --show, of that device",
     PARAMETER_TEXT, .min = 1, .placeholder = "DEVICE", AT(arithmetic), .programs = GL_FILM},
    {"deterministic",
     "use no more of an x86 processor than SSE4.1 and vectors of 128 bits, in Mesa and in the C "
     "library, so that different processors give the same bytes",
     PARAMETER_FLAG, AT(deterministic), .programs = ALL},
    {"alpha", "keep the alpha channel: the background is transparent", PARAMETER_FLAG, AT(alpha),
     .programs = DRAWS},
    {"compress", "of PNG files: 0 is none, 9 is smallest", PARAMETER_WHOLE, .max = 9,
     .standard = "fast", AT(compress), .programs = DRAWS},
};

static const Parameter LAST[] = {
    {"verbose", "report what runs where and how long it takes", PARAMETER_FLAG, .letter = 'v',
     AT(verbose), .programs = ALL | ASIDE},
    {"doctor", "report what this machine can draw with, and what to install", PARAMETER_FLAG,
     AT(doctor), .programs = ALL | ASIDE},
    {"generate", "print the man page, or the completion for a shell", PARAMETER_TEXT,
     .choices = FORMS, AT(generate), .programs = ALL | ASIDE},
    {"help", "print this text", PARAMETER_FLAG, .letter = 'h', .programs = ALL | ASIDE},
    {"version", "print the version", PARAMETER_FLAG, .programs = ALL | ASIDE},
};

static bool refuse_in_diagram(const Parameter *parameter, const char *text, Message *message)
{
    (void)text;
    return message_set(message,
                       "--%s: a diagram is drawn without OpenGL: it has no camera, no shaders and "
                       "no samples, and its edges are smooth already",
                       parameter->name);
}

static bool refuse_in_gallery(const Parameter *parameter, const char *text, Message *message)
{
    (void)text;
    return message_set(message, "--%s: a gallery has one picture of each program", parameter->name);
}

static int program_of(const Usage *usage)
{
    return usage->gallery ? PROGRAM_GALLERY
           : usage->study ? PROGRAM_STUDY
           : usage->kind  ? usage->kind->program
                          : PROGRAM_ONE;
}

/* A table that is filled. */
typedef struct Filling {
    Parameter *table;
    int count, program;
    Options *options;
    OptionsPurpose purpose;
} Filling;

/* An address in the options instead of a place. */
static void *address(Options *options, const void *place)
{
    return place ? (char *)options + (size_t)place : NULL;
}

static void add_row(Filling *filling, const Parameter *row)
{
    static const ParameterCodec IN_DIAGRAM = {.read = refuse_in_diagram};
    static const ParameterCodec IN_GALLERY = {.read = refuse_in_gallery};
    const int program = filling->program, has = row->programs;
    const bool reads = filling->purpose == OPTIONS_TO_READ, own = has & program;
    const bool in_diagram = program == PROGRAM_DIAGRAM && has & NOT_DIAGRAM;
    const bool refused =
        !own && reads && (in_diagram || (program == PROGRAM_GALLERY && has & NOT_GALLERY));
    if (!refused && (!own || (has & ASIDE && filling->purpose == OPTIONS_TO_WRITE)))
        return;
    Parameter *option = &filling->table[filling->count++];
    *option = *row;
    option->value = address(filling->options, row->value);
    option->given = address(filling->options, row->given);
    if (refused)
        option->codec = in_diagram ? &IN_DIAGRAM : &IN_GALLERY;
    if (option->value == &filling->options->output)
        option->standard = filling->options->default_output;
}

/* A program may have an option of its own by a name that other programs of its kind share. */
static bool has_own(const Usage *usage, const char *name)
{
    const Parameter *own = usage->parameters;
    while (own && own->name && strcmp(own->name, name) != 0)
        own++;
    return own && own->name;
}

int options_table(const Usage *usage, Options *options, OptionsPurpose purpose,
                  Parameter table[OPTIONS_MAX])
{
    Filling filling = {
        .table = table, .program = program_of(usage), .options = options, .purpose = purpose};
    for (size_t i = 0; i < sizeof FIRST / sizeof FIRST[0]; i++)
        add_row(&filling, &FIRST[i]);
    for (const Parameter *row = usage->kind ? usage->kind->options : NULL; row && row->name; row++)
        if (!has_own(usage, row->name))
            add_row(&filling, row);
    for (size_t i = 0; i < sizeof LAST / sizeof LAST[0]; i++)
        add_row(&filling, &LAST[i]);
    const int common = filling.count;
    int count = common;
    const Parameter *own = usage->parameters;
    for (int i = 0; own && own[i].name && i < OPTIONS_MAX_PARAMETERS; i++, count++) {
        table[count] = own[i];
        /* What is named stays with --error, even if it is the default. */
        if (!own[i].given && (purpose == OPTIONS_TO_READ || options->cheap))
            table[count].given = &options->own_given[i];
    }
    table[count].name = NULL;
    return common;
}
