/*
 * class: check for a whole class: finds the submissions, judges each in a sandbox, writes tables
 * and pages.
 */
#ifndef CLASS_H
#define CLASS_H

#include "base/message.h"
#include "base/parse.h"

#include <stdbool.h>
#include <stdint.h>

enum { CLASS_JOBS_MAX = 256 };

typedef struct ClassOptions {
    const char *folder; /* --class; NULL: --merge */
    const char *lab;    /* NULL: as the names tell */
    const char *output;
    char *const *merged; /* folders to merge, NULL-terminated */
    int jobs;
    Part part;
    bool deterministic;
    double limit; /* seconds of computing, for each submission */
    uint64_t seed;
    bool again; /* judge what has a result, too */
    bool help;  /* it has been printed */
} ClassOptions;

/* False with a message: a usage error. */
bool class_options_read(ClassOptions *options, int argc, char *argv[], Message *message);

/* Whether the command line has --class, --merge, or --inside, with which the program calls itself.
 * If so, it has run, and *code is the exit code: 0 if every result is there, whatever it says; 1
 * for a failure or an interrupt; 2 for a usage error. */
bool class_main(int argc, char *argv[], int *code);

#endif
