/*
 * sandbox: this program again, as a process that can do little, to judge what is not trusted.
 *
 * What goes in is one open file, what comes out is one stream of bytes (bundle.h) and a few lines
 * of text; neither is believed. Where bubblewrap is installed and works, the process sees no files
 * but the system's programs and libraries, this program and the lab's folder, all of them
 * read-only, and an empty folder in memory; it has no network, sees no other process, and dies with
 * this one. Limits on time, memory, the size of files and the number of processes hold always.
 * Where this program is root, the process is not: limits on the number of processes do not bind
 * root.
 *
 * Which of that holds is not taken for granted: sandbox_open sends a process in that tries.
 */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "message.h"

#include <limits.h>
#include <stddef.h>
#include <sys/types.h>

enum {
    SANDBOX_PROCESSES = 24,         /* threads count; the compiler of C needs five */
    SANDBOX_MEMORY = 3000,          /* MB of addresses, of each process */
    SANDBOX_FILE = 16,              /* MB, of each file */
    SANDBOX_FOLDER = 64,            /* MB, of all files together; bubblewrap alone */
    SANDBOX_OUTPUT_MOST = 32 << 20, /* bytes */
    SANDBOX_SAID_SIZE = 4096,       /* of what it says on standard error */
    SANDBOX_SECONDS_MOST = 3600,
    SANDBOX_RUNS_MOST = 256, /* at once */
};

/* What was tried, and could not be done. */
typedef enum SandboxProof {
    SANDBOX_NO_FILES = 1 << 0,   /* read a file outside, or write one */
    SANDBOX_NO_NETWORK = 1 << 1, /* reach a port of this machine */
    SANDBOX_LIMITS = 1 << 2,     /* exceed memory, file size, number of processes */
} SandboxProof;

typedef struct Sandbox {
    bool bubblewrap;
    unsigned proven;        /* of SandboxProof */
    char program[PATH_MAX]; /* this one */
    char folder[PATH_MAX];  /* that it may read besides, of the labs; may be empty */
    double seconds; /* of computing, for each run; twice as many and one more pass at most */
} Sandbox;

/* Finds the best kind of sandbox that works. `hidden` is a path that exists and that nothing in the
 * sandbox may see. False where not even the limits hold. */
bool sandbox_open(Sandbox *sandbox, const char *folder, double seconds, const char *hidden,
                  Message *message);

/* What is proven, in one line; and why it is not more, where it is not: `message`. */
void sandbox_describe(const Sandbox *sandbox, char text[256]);

/* How many seconds may pass while a run computes for so many: others want the processors, too. */
double sandbox_patience(double seconds);

/* One process that runs, or has. Zeroed, there is none. */
typedef struct SandboxRun {
    pid_t pid;
    int output, errors; /* pipes; -1: closed */
    unsigned char *bytes;
    size_t size, capacity;
    char said[SANDBOX_SAID_SIZE]; /* the end of what it said */
    size_t said_size;
    double deadline;
    char folder[PATH_MAX]; /* to be removed; empty: none */
    bool running, timed_out, too_much;
    int status; /* as waitpid has it */
} SandboxRun;

/* What a run came to. */
typedef enum SandboxEnd {
    SANDBOX_DONE,    /* its stream is in `bytes` */
    SANDBOX_REFUSED, /* it says why in one line of its own making: sandbox_last_line */
    SANDBOX_TIMEOUT,
    SANDBOX_FAILED, /* a signal, too much output, an exit code that means nothing */
} SandboxEnd;

/* Starts `PROGRAM --inside ... arguments` with the open file `input` as standard input. `slot`, 0
 * to SANDBOX_RUNS_MOST - 1, is another one for each that runs at a time. `arguments` ends with
 * NULL. */
bool sandbox_start(const Sandbox *sandbox, SandboxRun *run, int slot, int input,
                   const char *const arguments[], Message *message);

/* Reads what the runs write and ends those whose time is over, until one has ended, a signal comes,
 * or `seconds` have passed. */
void sandbox_wait(SandboxRun *const runs[], int count, double seconds);

SandboxEnd sandbox_end(const SandboxRun *run);

/* The last line that it said and that begins with no space, as lines of sources under a message do:
 * at most 1000 bytes, without control characters. */
void sandbox_last_line(const SandboxRun *run, char text[1024]);

/* Ends it if it still runs. NULL or zeroed is fine. */
void sandbox_close(SandboxRun *run);

#endif
