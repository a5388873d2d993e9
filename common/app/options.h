/*
 * options: the command line, the same for every program.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "app/example_kind.h"
#include "app/help.h"
#include "base/parse.h"

enum { FRAMES_MAX = 1000000 };

/* Of a program: its own options, and all. */
enum { OPTIONS_MAX_PARAMETERS = 32, OPTIONS_MAX = 72 };

/* The defaults of --size in pixels and of --fps. */
enum { OPTIONS_SIDE = 400, OPTIONS_FPS = 30 };

/* The range of --time, before and after 0. */
enum { OPTIONS_MAX_SECONDS = 1000000000 };

typedef struct Options {
    char *const *names; /* the arguments that are no options; NULL-terminated */
    const char *output; /* a file, "-", a name with %d; for a gallery or a study a folder */
    bool output_given;
    int width, height;
    bool size_given;
    double seconds;
    bool seconds_given;
    int frames;
    bool numbered; /* --frames was given, and the output's name has a number */
    double fps;
    Part part;          /* of the pictures */
    bool keeps;         /* the part's pictures say what they are drawn from */
    bool merge;         /* instead of drawing, put together what the parts have drawn */
    const char *format; /* of standard output: "png", "y4m", "rgb", "svg", "pdf"; NULL: not given */
    const char *vector; /* "svg" or "pdf", of a diagram; NULL: pixels */
    const char *animation; /* the format of the one file or stream of all pictures, see animation.h;
                              NULL: each picture has its own file */
    Orbit orbit;
    bool watch;           /* draw again when a shader changes */
    CanvasOptions canvas; /* without size and real */
    ShaderLoader shaders;
    bool deterministic; /* options_begin has seen to it */
    bool alpha;
    int compress;
    bool verbose;
    bool doctor;
    struct {
        bool asked;
        int column, row;    /* of the pixel, from the picture's upper left corner */
    } probe;                /* instead of drawing a file, explain a pixel */
    const char *show;       /* instead of the picture, what its shaders compute: see show.h */
    bool show_unknown;      /* no shader has it */
    const char *arithmetic; /* the device as which the shaders are computed; NULL: llvmpipe */
    const char *generate;   /* "man", "bash", "zsh", "fish": what is printed; NULL: nothing */
    /* Of programs that draw scenes. */
    const char *save_scene; /* a file to write instead of drawing; NULL: none */
    bool explain;           /* report the effects that the scene needs, and draw nothing */
    bool full, clamp_vertex, signed_dots, linear, show_clipped, normals,
        cheap; /* as in DrawRequest */
    double error;
    SceneTerms terms;
    ShadowSettings shadows;
    LightPlaces places;
    LightTints tints;
    bool own_given[OPTIONS_MAX_PARAMETERS]; /* the program's own options, in their order */
    /* Of the example's own parameters before the command line was read; NULL: they are unchanged.
     */
    const ParameterValue *defaults;
    /* The first words of the command that started the program, for a shell: see command_start.
     * NULL: its name alone. */
    const char *start;
    char default_output[128];
} Options;

typedef enum OptionsResult { OPTIONS_RUN, OPTIONS_ANSWERED, OPTIONS_BAD } OptionsResult;

/* Reads the command line. OPTIONS_ANSWERED: --help, --version or --generate was printed on standard
 * output; OPTIONS_BAD: a usage error, with its message. */
OptionsResult options_read(Options *options, const Usage *usage, int argc, char *argv[],
                           Message *message);

/* The value of an option --part, a Part. */
extern const ParameterCodec OPTION_PART;

Usage options_usage(const Example *example);

/* What they ask for of an example. */
DrawRequest options_request(const Options *options, const Example *example);

/* Whether the options go together: what needs neither driver nor files. Sets what follows from the
 * output's name: the animation, the vector format. */
bool options_check(Options *options, const Usage *usage, Message *message);

/* The size of the picture without --size. */
void options_size(const Usage *usage, int *width, int *height);

/* As options_read leaves them without arguments, apart from the output. */
Options options_default(const Usage *usage);

/* Fills `table` with the options that a program has, in the order of --help, their values in
 * `options`: the common ones, how many of which is returned, then its own, then a NULL name. To
 * write: only those that change what is drawn or where it goes. */
typedef enum OptionsPurpose { OPTIONS_TO_READ, OPTIONS_TO_SHOW, OPTIONS_TO_WRITE } OptionsPurpose;
int options_table(const Usage *usage, Options *options, OptionsPurpose purpose,
                  Parameter table[OPTIONS_MAX]);

bool options_in_window(const Options *options);

/* Whether a light may have shadows: then several samples of a pixel are pixels of their own. */
bool options_have_shadows(const Options *options);

/* Opens the canvas, with float colors if the format of `output` stores them. With --verbose
 * describes it on standard error. */
bool options_open_canvas(Canvas *canvas, const Options *options, const char *output,
                         Message *message);

/* Sets a handler, with sigaction's flags, for SIGINT, SIGTERM and SIGHUP; not for those that are
 * ignored, as under nohup. */
void options_catch_signals(void (*handler)(int), int flags);

/* Opens /dev/null for closed standard streams, so that a picture does not land in a file that got
 * the number of standard output; ends the process quietly if the reader of standard output leaves;
 * turns SIGPIPE of other pipes and SIGXFSZ into errors of the write; removes half-written files
 * before a signal ends the process. */
void options_prepare_process(void);

/* "NAME=VALUE" ended by NULL: the environment of --deterministic, which caps the processor. */
extern const char *const OPTIONS_LEAST[];

/* --deterministic: starts the program again with these arguments in that environment; true if that
 * is the environment already. */
bool options_restart(char *const *arguments, Message *message);

/* The beginning of a program: options_prepare_process and options_read, whose message it prints;
 * with --deterministic, starts the program again in an environment that caps the processor; does
 * what --doctor asks for. False if the program is to return *code at once. */
bool options_begin(Options *options, const Usage *usage, int argc, char *argv[], int *code);

/* Prints a message on standard error and returns `code`. */
int options_fail(const char *program, const Message *message, int code);

/* Prints a warning on standard error. */
void options_warn(const char *program, const Message *message);

/* Says on standard error what was done, if that is a terminal. */
void options_tell(const char *program, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Flushes standard output; EXIT_FAILED, with a message, if something written did not arrive. */
int options_finish(const char *program, int code);

#endif
