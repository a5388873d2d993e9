/*
 * sandbox: runs this program again as a process with few rights, to judge untrusted submissions.
 *
 * Input is one open file; output is one stream of bytes (bundle.h) and a few lines of text, both
 * untrusted. If bubblewrap works, the process sees only the system's programs and libraries, this
 * program and the labs' folder, all read-only, and an empty folder in memory; it has no network,
 * sees no other process, and dies with this one. Limits on time, memory, file sizes and processes
 * always hold. If this program runs as root, the process does not, because root has no process
 * limit.
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
    SANDBOX_MEMORY = 3000,         /* MB of address space per process */
    SANDBOX_FILE = 16,             /* MB per file */
    SANDBOX_FOLDER = 64,           /* MB of all files together; only with bubblewrap */
    SANDBOX_OUTPUT_MAX = 32 << 20, /* bytes */
    SANDBOX_SAID_SIZE = 4096,      /* of its standard error */
    SANDBOX_SECONDS_MAX = 3600,
    SANDBOX_RUNS_MAX = 256, /* at once */
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
    double seconds;         /* of processor time per run; see sandbox_patience */
} Sandbox;

/* Opens the best sandbox that works for a lab's submissions. `hidden` is an existing path that the
 * sandbox must not see. False: not even the limits hold. */
bool sandbox_open(Sandbox *sandbox, const Lab *lab, double seconds, const char *hidden,
                  Message *message);

/* False, with a message: the lab has C, which runs only where it sees no files. */
bool sandbox_admits(const Sandbox *sandbox, const Lab *lab, Message *message);

/* What is proven, in one line. */
void sandbox_describe(const Sandbox *sandbox, char text[256]);

/* The wall time allowed for so many seconds of processor time, which runs share. */
double sandbox_patience(double seconds);

/* One process, running or ended. Zeroed: none. */
typedef struct SandboxRun {
    pid_t pid;
    int output, errors; /* pipes; -1: closed */
    unsigned char *bytes;
    size_t size, capacity;
    char said[SANDBOX_SAID_SIZE]; /* the end of its standard error */
    size_t said_size;
    double deadline;
    char folder[PATH_MAX]; /* removed at the end; empty: none */
    bool running, timed_out, too_much;
    int status; /* from waitpid */
} SandboxRun;

typedef enum SandboxEnd {
    SANDBOX_DONE,    /* its stream is in `bytes` */
    SANDBOX_REFUSED, /* sandbox_last_line says why */
    SANDBOX_TIMEOUT,
    SANDBOX_FAILED, /* a signal, too much output, an unknown exit code */
} SandboxEnd;

/* Starts `PROGRAM --inside ... arguments` with the open file `input` as standard input. `arguments`
 * end with NULL. Each concurrent run has its own `slot`, 0 to SANDBOX_RUNS_MAX - 1. */
bool sandbox_start(const Sandbox *sandbox, SandboxRun *run, int slot, int input,
                   const char *const arguments[], Message *message);

/* Reads the runs' output and kills those past their deadline, until one has ended, a signal
 * arrives, or `seconds` have passed. */
void sandbox_wait(SandboxRun *const runs[], int count, double seconds);

SandboxEnd sandbox_end(const SandboxRun *run);

/* The last line of its standard error that does not start with a space, as quoted source lines do:
 * at most 1000 bytes, without control characters. */
void sandbox_last_line(const SandboxRun *run, char text[1024]);

/* Ends it if it still runs. NULL or zeroed is fine. */
void sandbox_close(SandboxRun *run);

#endif
