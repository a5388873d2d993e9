/* The options that programs of every kind have, in the order of --help. */
#include "app/options_table.h"

#include <limits.h>

enum {
    FILM = PROGRAM_ONE | PROGRAM_DIAGRAM | NOT_GALLERY,
    GL_FILM = PROGRAM_ONE | NOT_DIAGRAM | NOT_GALLERY,
    DRAWS = PROGRAM_ONE | PROGRAM_DIAGRAM | PROGRAM_GALLERY,
    GL_DRAWS = PROGRAM_ONE | PROGRAM_GALLERY | NOT_DIAGRAM,
    GL_ALL = GL_DRAWS | PROGRAM_STUDY,
    ALL = DRAWS | PROGRAM_STUDY,
};

static const char *const FORMATS[] = {"png", "y4m", "rgb", NULL};
static const char *const DIAGRAM_FORMATS[] = {"png", "y4m", "rgb", "svg", "pdf", NULL};
static const char *const BACKEND_NAMES[] = {"egl", "osmesa", "window", NULL};
static const char *const PRECISIONS[] = {"highp", "mediump", NULL};
static const char *const STAGES[] = {"vert", "frag", NULL};
static const char *const FORMS[] = {"man", "bash", "zsh", "fish", NULL};

#define OUTPUT_ROW(words, what, who)                                                               \
    {                                                                                              \
        {"output", words, PARAMETER_TEXT, .min = 1, .letter = 'o', .placeholder = what},           \
            IN_OPTIONS(output), GIVEN_IN(output_given), .programs = who                            \
    }
#define FORMAT_ROW(names, who)                                                                     \
    {                                                                                              \
        {"format",                                                                                 \
         "what -o - writes: one PNG (default); all pictures as YUV4MPEG2 video (y4m); or their "   \
         "raw bytes: red, green, blue (rgb)",                                                      \
         PARAMETER_TEXT, .choices = names},                                                        \
            IN_OPTIONS(format), .programs = who                                                    \
    }
#define SAMPLES_ROW(usual, who)                                                                    \
    {                                                                                              \
        {"samples",          "multisampling with N samples per pixel",                             \
         PARAMETER_WHOLE,    .max = INT_MAX,                                                       \
         .placeholder = "N", .standard = usual},                                                   \
            IN_OPTIONS(canvas.samples), .programs = who                                            \
    }
#define PART_ROW(words, who)                                                                       \
    {                                                                                              \
        {"part", words, PARAMETER_TEXT, .standard = "", .codec = &OPTION_PART}, IN_OPTIONS(part),  \
            .programs = who | ASIDE                                                                \
    }
#define MERGE_ROW(words, who)                                                                      \
    {                                                                                              \
        {"merge", words, .kind = PARAMETER_FLAG}, IN_OPTIONS(merge), .programs = who | ASIDE       \
    }

/* Before those of the kind. */
static const OptionRow FIRST[] = {
    OUTPUT_ROW("the picture; the extension names the format (.png, .exr, .tif, .jpg, .webp, "
               ".mp4...); - writes to standard output",
               "FILE", PROGRAM_ONE),
    OUTPUT_ROW("the picture; the extension names the format (.svg, .pdf, .png, .tif, .jpg, .webp, "
               ".mp4...); - writes to standard output",
               "FILE", PROGRAM_DIAGRAM),
    OUTPUT_ROW("the folder for the pictures, the contact sheet and index.html; created if missing",
               "DIR", PROGRAM_GALLERY),
    OUTPUT_ROW("the folder for the results; created if missing", "DIR", PROGRAM_STUDY),
    {{"size", "in pixels", PARAMETER_TEXT, .letter = 's', .codec = &OPTION_SIZE},
     IN_OPTIONS(width),
     GIVEN_IN(size_given),
     .programs = ALL},
    {{"time", "the time to draw", PARAMETER_NUMBER, .min = -OPTIONS_MAX_SECONDS,
      .max = OPTIONS_MAX_SECONDS, .letter = 't', .placeholder = "SECONDS"},
     IN_OPTIONS(seconds),
     .programs = DRAWS},
    {{"angle", "the time at which an animation of 30 degrees per second reaches this angle",
      PARAMETER_TEXT, .letter = 'a', .standard = "", .codec = &OPTION_ANGLE},
     IN_OPTIONS(seconds),
     .programs = DRAWS | ASIDE},
    {{"frames",
      "N pictures from --time on: all in one file if that is an animation (.gif, .webp, .apng, "
      ".mp4, .webm); otherwise one file each, with a number in its name, as in -o turn%03d.png",
      PARAMETER_WHOLE, .min = 1, .max = FRAMES_MAX, .letter = 'n', .placeholder = "N"},
     IN_OPTIONS(frames),
     GIVEN_IN(numbered),
     .programs = FILM},
    {{"fps", "pictures per second", PARAMETER_NUMBER, .min = 1e-3, .max = 1e6, .placeholder = "F"},
     IN_OPTIONS(fps),
     .programs = FILM},
    PART_ROW("draw only the I-th of N parts of --frames, for several processes or machines. Those "
             "of an animation go to the folder FILE.parts as PNG",
             PROGRAM_ONE | PROGRAM_DIAGRAM),
    PART_ROW("draw only the I-th of N parts, for several processes or machines that share DIR",
             PROGRAM_GALLERY),
    MERGE_ROW("draw nothing: put the animation together when all parts are drawn",
              PROGRAM_ONE | PROGRAM_DIAGRAM),
    MERGE_ROW("draw nothing: write what is missing when all parts are drawn, the contact sheet and "
              "index.html",
              PROGRAM_GALLERY),
    FORMAT_ROW(FORMATS, PROGRAM_ONE | NOT_GALLERY),
    FORMAT_ROW(DIAGRAM_FORMATS, PROGRAM_DIAGRAM),
    SAMPLES_ROW("0 (off)", PROGRAM_ONE | NOT_DIAGRAM),
    SAMPLES_ROW("4", PROGRAM_GALLERY),
    {{"orbit",
      "move the camera about its target: degrees to the right and up, and a factor for the "
      "distance",
      PARAMETER_TEXT, .codec = &OPTION_ORBIT},
     IN_OPTIONS(orbit),
     .programs = GL_DRAWS},
    {{"window", "run in a window; h lists the keys", PARAMETER_FLAG, .letter = 'w',
      .codec = &OPTION_WINDOW},
     IN_OPTIONS(canvas.backend),
     .programs = FILM | ASIDE},
    {{"watch", "draw again whenever a shader file changes, until Ctrl-C", .kind = PARAMETER_FLAG},
     IN_OPTIONS(watch),
     .programs = GL_FILM | ASIDE},
    {{"backend",
      "what draws; egl and osmesa need no display; also LIGHTING_BACKEND in the environment",
      PARAMETER_TEXT, .choices = BACKEND_NAMES, .letter = 'b', .standard = "egl",
      .codec = &OPTION_BACKEND},
     IN_OPTIONS(canvas.backend),
     .programs = GL_ALL},
    {{"shaders",
      "look for shader files here first, for example your own copies; also LIGHTING_SHADERS in the "
      "environment",
      PARAMETER_TEXT, .min = 1, .placeholder = "DIR"},
     IN_OPTIONS(shaders.folder),
     .programs = GL_ALL},
    {{"precision", "of fragment shaders", PARAMETER_TEXT, .choices = PRECISIONS,
      .standard = "as the shader says"},
     IN_OPTIONS(shaders.precision),
     .programs = GL_DRAWS},
    {{"print-shader", "print the source that the driver gets; draw nothing", PARAMETER_FLAG,
      .choices = STAGES, .codec = &OPTION_PRINT},
     IN_OPTIONS(shaders.print),
     .programs = GL_DRAWS | ASIDE},
    {{"deterministic",
      "use no more of an x86 processor than SSE4.1 and vectors of 128 bits, in Mesa and in the C "
      "library, so that different processors give the same bytes",
      .kind = PARAMETER_FLAG},
     IN_OPTIONS(deterministic),
     .programs = ALL},
    {{"alpha", "keep the alpha channel: the background is transparent", .kind = PARAMETER_FLAG},
     IN_OPTIONS(alpha),
     .programs = DRAWS},
    {{"compress", "of PNG files: 0 is none, 9 is smallest", PARAMETER_WHOLE, .max = 9,
      .standard = "fast"},
     IN_OPTIONS(compress),
     .programs = DRAWS},
};

static const OptionRow LAST[] = {
    {{"verbose", "report what runs where and how long it takes", PARAMETER_FLAG, .letter = 'v'},
     IN_OPTIONS(verbose),
     .programs = ALL | ASIDE},
    {{"doctor", "report what this machine can draw with, and what to install",
      .kind = PARAMETER_FLAG},
     IN_OPTIONS(doctor),
     .programs = ALL | ASIDE},
    {{"generate", "print the man page, or the completion for a shell", PARAMETER_TEXT,
      .choices = FORMS},
     IN_OPTIONS(generate),
     .programs = ALL | ASIDE},
    {{"help", "print this text", PARAMETER_FLAG, .letter = 'h'}, .programs = ALL | ASIDE},
    {{"version", "print the version", .kind = PARAMETER_FLAG}, .programs = ALL | ASIDE},
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

static void add_row(Filling *filling, const OptionRow *row)
{
    static const ParameterCodec IN_DIAGRAM = {.read = refuse_in_diagram};
    static const ParameterCodec IN_GALLERY = {.read = refuse_in_gallery};
    const int program = filling->program, has = row->programs;
    const bool reads = filling->purpose == OPTIONS_TO_READ, own = has & program;
    const ParameterCodec *refusal = own || !reads                                     ? NULL
                                    : program == PROGRAM_DIAGRAM && has & NOT_DIAGRAM ? &IN_DIAGRAM
                                    : program == PROGRAM_GALLERY && has & NOT_GALLERY ? &IN_GALLERY
                                                                                      : NULL;
    if (!refusal && (!own || (has & ASIDE && filling->purpose == OPTIONS_TO_WRITE)))
        return;
    Parameter *option = &filling->table[filling->count++];
    char *base = (char *)filling->options;
    *option = row->option;
    option->value = row->value ? base + row->value : NULL;
    option->given = row->given ? (bool *)(base + row->given) : NULL;
    if (refusal)
        option->codec = refusal;
    if (row->value == offsetof(Options, output))
        option->standard = filling->options->default_output;
}

int options_table(const Usage *usage, Options *options, OptionsPurpose purpose,
                  Parameter table[OPTIONS_MAX])
{
    Filling filling = {
        .table = table, .program = program_of(usage), .options = options, .purpose = purpose};
    for (size_t i = 0; i < sizeof FIRST / sizeof FIRST[0]; i++)
        add_row(&filling, &FIRST[i]);
    for (const OptionRow *row = usage->kind ? usage->kind->options : NULL; row && row->option.name;
         row++)
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
