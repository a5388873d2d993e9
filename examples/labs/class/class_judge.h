/*
 * class_judge: judges every submission of a class in a sandbox, several at a time, as the command
 * line wants it.
 */
#ifndef CLASS_JUDGE_H
#define CLASS_JUDGE_H

#include "base/parse.h"
#include "labs/class/class_find.h"
#include "labs/class/class_store.h"
#include "labs/sandbox/sandbox.h"

#include <signal.h>

enum { CLASS_JOBS_MAX = 256 };

typedef struct ClassOptions {
    const char *folder; /* --class; NULL: --merge */
    const char *lab;    /* NULL: as the names tell */
    const char *output;
    char *const *merged; /* folders to merge, NULL-terminated */
    bool partial;        /* merge though something is missing */
    int jobs;
    Part part;
    bool deterministic;
    double limit; /* seconds of computing, for each submission */
    uint64_t seed;
    const char *late; /* a table of who is late; NULL: none */
    bool again;       /* judge what has a result, too */
    bool help;        /* it has been printed */
} ClassOptions;

/* False with a message: a usage error. */
bool class_options_read(ClassOptions *options, int argc, char *argv[], Message *message);

typedef struct ClassJudging {
    const ClassOptions *options;
    const Lab *lab;
    const FoundList *list;
    const Sandbox *sandbox;
    ClassStore *store;
    const volatile sig_atomic_t *interrupted;
} ClassJudging;

/* Judges submissions without a valid result and puts each result into the store at once; prints one
 * line on standard error for each that could not be judged. Returns early, with true, when
 * *interrupted; false only if results cannot be written, processes cannot be started, or some could
 * not be judged for a reason of this machine. */
bool class_judge(const ClassJudging *of, Message *message);

/* Whether a submission is in the part that the options name. Depends only on its folder's name, so
 * it stays the same whatever other submissions there are. */
bool class_in_part(const ClassOptions *options, const char *folder);

#endif
