/*
 * class_options: the command line of check for a whole class.
 */
#ifndef CLASS_OPTIONS_H
#define CLASS_OPTIONS_H

#include "base/message.h"
#include "base/parse.h"

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

#endif
