/*
 * help: what a program prints about its options: --help, a man page, completion for shells.
 */
#ifndef HELP_H
#define HELP_H

#include "scene/parameter.h"
#include "scene/scene.h"

/* Exit codes besides 0. */
enum {
    EXIT_FAILED = 1, /* of the machine, a file or a driver */
    EXIT_USAGE = 2,  /* of the command line */
};

/* What the program accepts, and what --help says besides the options. */
typedef struct Usage {
    const char *name;
    const char *summary;
    const char *details; /* the last part of --help; NULL: examples */
    bool gallery;        /* -o names a folder, names may follow the options, no --frames */
    bool study;          /* -o names a folder; no options that change a picture */
    const struct ExampleKind *kind; /* of the example that it draws; NULL: it draws none */
    ShadowSettings shadows;         /* without --shadows */
    const char *names;              /* the operands in --help, "LAB PATH"; NULL: there are none */
    const char **operand;           /* of one that is needed: where it goes; may be NULL */
    const char *const *tries;       /* as in an Example; may be NULL */
    const char *const *looks;       /* as many */
    int width, height;              /* of the picture without --size; zero: 400 */
    double seconds;                 /* of the picture without --time */
    void (*resize)(int *width, int *height); /* where that depends on an option; may be NULL */
    const Parameter *parameters; /* the program's own options; ended by a NULL name; may be NULL */
} Usage;

/* `table` has the common options of the program, which a NULL name ends. */
void help_print(const Usage *usage, const Parameter *table);

/* The lines of --help for the options of a table, which a NULL name ends. */
void help_options(const Parameter *table);

/* "man": a page in roff's man macros; "bash", "zsh", "fish": the completion for that shell. `table`
 * has all options. */
void help_generate(const char *form, const Usage *usage, const Parameter *table);

#endif
