/*
 * sandbox: runs this program again as a process with few rights, to judge untrusted submissions.
 *
 * A submission is bound read-only; one pipe brings text and results, both untrusted. If bubblewrap
 * works, the process sees only the system's programs and libraries, this program, the labs' folder
 * and the submission, all read-only, and an empty folder in memory; it has no network, sees no
 * other process, and dies with this one. Limits on time, memory, file sizes and processes always
 * hold. If this program runs as root, the process does not, because root has no process limit.
 *
 * None of that is taken for granted: sandbox_open first runs a process that tries to break out.
 */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "base/message.h"
#include "labs/program/lab.h"

#include <limits.h>
#include <stddef.h>
#include <sys/types.h>

enum {
    SANDBOX_PROCESSES = 24,        /* threads count; the C compiler needs five */
    SANDBOX_MEMORY = 2048,         /* MB of address space per process; compiling takes over 1024 */
    SANDBOX_FILE = 16,             /* MB per file */
    SANDBOX_FOLDER = 64,           /* MB of all files together; only with bubblewrap */
    SANDBOX_OUTPUT_MAX = 32 << 20, /* bytes */
    SANDBOX_SECONDS_MAX = 3600,
    SANDBOX_RUNS_MAX = 256, /* at once */
    SANDBOX_BROKEN = 5,     /* its exit code if not the submission is at fault */
};

/* What the process tried in vain. */
typedef enum SandboxProof {
    SANDBOX_NO_FILES = 1 << 0,   /* read or write a file outside */
    SANDBOX_NO_NETWORK = 1 << 1, /* reach a port of this machine */
    SANDBOX_LIMITS = 1 << 2,     /* exceed memory, file size, number of processes */
} SandboxProof;

typedef struct Sandbox {
    bool bubblewrap;
    unsigned proven;        /* of SandboxProof */
    char program[PATH_MAX]; /* this one */
    char folder[PATH_MAX];  /* of all labs, readable: it also has the headers for their C */
    double seconds;         /* of processor time per run */
} Sandbox;

/* Opens the best sandbox that works for a lab's submissions. `hidden` is an existing path that the
 * sandbox must not see. False: not even the limits hold. */
bool sandbox_open(Sandbox *sandbox, const Lab *lab, double seconds, const char *hidden,
                  Message *message);

/* False, with a message: the lab has C, which runs only where it sees no files. */
bool sandbox_admits(const Sandbox *sandbox, const Lab *lab, Message *message);

/* What is proven, in one line. */
void sandbox_describe(const Sandbox *sandbox, char text[256]);

/* What a submission is on disk. */
typedef enum SandboxSource {
    SOURCE_FOLDER,  /* a folder with the lab's files somewhere, under whatever names (source.h) */
    SOURCE_FILES,   /* such files */
    SOURCE_ARCHIVE, /* an archive of such a folder */
} SandboxSource;

/* Files or a folder that the process may read, and what the student calls them. */
typedef struct SandboxInput {
    const char *path, *name;
} SandboxInput;
typedef struct SandboxInputs {
    const SandboxInput *items;
    int count;
} SandboxInputs;

/* One process, running or ended. Zeroed: none.
 *
 * Standard output and error are one pipe. A zero byte in it says that what follows is the work of
 * the driver and the compiler on the submission; others begin the result and what belongs to it. */
typedef struct SandboxRun {
    pid_t pid;
    int pipe; /* -1: closed */
    char *bytes;
    size_t size, capacity;
    double start, deadline;
    char folder[PATH_MAX]; /* removed at the end; empty: none */
    bool running, timed_out, too_much;
    int status; /* its exit code; 128 more than the number of a signal */
} SandboxRun;

/* Starts `PROGRAM --inside STEP USER SECONDS FOLDER arguments`, then the place and the name of each
 * input. `arguments` begin with the step and end with NULL. Each concurrent run has its own `slot`,
 * 0 to SANDBOX_RUNS_MAX - 1. The process ends, if not by the processor time that it may use, at one
 * deadline. */
bool sandbox_start(const Sandbox *sandbox, SandboxRun *run, int slot, const char *const arguments[],
                   SandboxInputs inputs, Message *message);

/* Reads the runs' output and kills those past their deadline, until one has ended, a signal
 * arrives, or `seconds` have passed. */
void sandbox_wait(SandboxRun *const runs[], int count, double seconds);

typedef enum SandboxEnd {
    SANDBOX_DONE,    /* there is a result */
    SANDBOX_TIMEOUT, /* at the deadline, or out of processor time */
    SANDBOX_CRASHED, /* while it worked on the submission */
    SANDBOX_FAILED,  /* sandbox_reason */
} SandboxEnd;

SandboxEnd sandbox_end(const SandboxRun *run);

/* What a zero byte begins, in this order; the picture may have more of them. */
typedef enum SandboxPart {
    SANDBOX_WORK = 1,
    SANDBOX_RESULT,
    SANDBOX_STATEMENTS, /* statements_text */
    SANDBOX_PICTURE,
} SandboxPart;

/* NULL: there is none. */
char *sandbox_part(const SandboxRun *run, SandboxPart part, size_t *size);

/* Why there is no result: a sanitizer's line, or the last before it that does not start with a
 * space, as quoted source lines do; of at most 1000 bytes, without control characters. */
void sandbox_reason(const SandboxRun *run, char text[1024]);

/* Ends it if it still runs. NULL or zeroed is fine. */
void sandbox_close(SandboxRun *run);

/* In the sandbox: tries what must be impossible there. */

/* *failed: what was tried in vain, of SandboxProof: to see the path `hidden`, to reach this port of
 * the machine, and so on. False, with a message, if the process cannot work here at all: it may not
 * read the folder `labs` or run this program. */
bool breakout_try(const char *hidden, int port, const char *labs, unsigned *failed,
                  Message *message);

/* The program in its sandbox: reads a submission, gives up its rights, judges. */

/* PROGRAM --inside STEP USER SECONDS FOLDER ...: becomes that user (if root), takes on the limits,
 * then does one of these steps, with FOLDER for its files:
 *   prove HIDDEN PORT LABS   tries what must be impossible; its result is what failed
 *   check LAB SEED KIND PLACE NAME...   judges the submission in these places, of a SandboxSource;
 *     its results are the verdict as JSON, its statements and the picture
 * Standard output is as SandboxRun has it. Returns the exit code: 0 or SANDBOX_BROKEN. */
int sandboxed_main(int count, char *arguments[]);

#endif
