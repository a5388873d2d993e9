/*
 * options: the command line, the same for every program.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "canvas.h"
#include "orbit.h"
#include "parameter.h"
#include "shader.h"

/* Exit codes besides 0. */
enum {
    EXIT_FAILED = 1, /* the machine, a file or a driver did not allow it */
    EXIT_USAGE = 2,  /* the command line is at fault */
};

enum { FRAMES_MOST = 1000000 };

/* Of a picture in pixels, where neither --size nor the program says more; and without --fps. */
enum { OPTIONS_SIDE = 400, OPTIONS_FPS = 30 };

/* The lecture's animations turn at this pace, so an angle is a time. */
enum { OPTIONS_DEGREES_PER_SECOND = 30 };

/* Of a moment, before and after 0. */
enum { OPTIONS_MOST_SECONDS = 1000000000 };

typedef struct Options {
    const char *output; /* a file, "-", a name with %d; for a gallery a folder */
    bool output_given;
    int width, height;
    bool size_given;
    double seconds;
    int frames;
    bool numbered; /* --frames was given, and the output's name has a number */
    double fps;
    const char *format;    /* of standard output: "png", "y4m", "rgb"; NULL: it was not said */
    const char *animation; /* the format of the one file or stream of all pictures, as animation.h
                              has it; NULL: each has its own file */
    Orbit orbit;
    bool watch;           /* draw again when a shader changes */
    CanvasOptions canvas; /* without size and real */
    ShaderLoader shaders;
    bool alpha;
    int compress;
    bool verbose;
    bool doctor;
    /* Of programs that draw scenes. */
    bool explain;      /* say which effects the scene calls for, and draw nothing */
    bool full;         /* draw with the program that has every effect */
    bool clamp_vertex; /* see scene.h */
    bool linear;
    bool show_clipped;
    bool cheap; /* --error: draw as cheaply as an error of `error` steps of 1/255 allows */
    double error;
    char *const *names; /* arguments that are no options; NULL-terminated */
    char default_output[128];
} Options;

/* What --help says besides the options, and what the program accepts. */
typedef struct Usage {
    const char *name;
    const char *summary;
    const char *details;         /* what --help says last; NULL: what there is to try */
    bool gallery;                /* -o names a folder, names may follow the options, no --frames */
    bool study;                  /* -o names a folder; measures, so that one moment is drawn as its
                                    own options say: none of those that change a picture */
    bool scene;                  /* the options of programs that draw scenes */
    const char *names;           /* of a study: what arguments that are no options stand for,
                                    "LAB PATH"; NULL: there are none */
    int width, height;           /* of the picture where --size says nothing; zero: 400 */
    const Parameter *parameters; /* the program's own options; ended by a NULL name; may be NULL */
} Usage;

enum { OPTIONS_MOST_PARAMETERS = 32 };

typedef enum OptionsResult { OPTIONS_RUN, OPTIONS_ANSWERED, OPTIONS_BAD } OptionsResult;

/* Reads the command line. OPTIONS_ANSWERED: --help or --version was printed on standard output;
 * OPTIONS_BAD: a usage error, with its message. */
OptionsResult options_read(Options *options, const Usage *usage, int argc, char *argv[],
                           Message *message);

/* getopt_long's '?' and ':' as a message, with the option that was meant, perhaps; false. `all` has
 * at most as many options as a program here can have. */
struct option;
bool options_refuse(const struct option *all, int result, int argc, char *argv[], Message *message);

/* Has a handler, with sigaction's flags, for the signals by which people and systems end a process.
 * What whoever started it had ignored stays so: nohup, a shell's background. */
void options_catch_signals(void (*handler)(int), int flags);

/* The edge of a program: opens /dev/null in the place of closed standard streams (a picture must
 * not land in a file that took the number of standard output), turns signals about broken pipes and
 * file sizes into errors of the write, and has those that end the process remove what is
 * half-written first. */
void options_prepare_process(void);

/* The beginning of a program: options_prepare_process and options_read, with what those have to
 * say. False where it is to return *code at once. */
bool options_begin(Options *options, const Usage *usage, int argc, char *argv[], int *code);

/* Says a message on standard error and returns `code`. */
int options_fail(const char *program, const Message *message, int code);

/* Closes standard output; EXIT_FAILED, having said so, where something written did not arrive. */
int options_finish(const char *program, int code);

#endif
