/*
 * sandboxed_check: judges submissions in a sandbox.
 */
#ifndef SANDBOXED_CHECK_H
#define SANDBOXED_CHECK_H

#include "labs/check/judge.h"
#include "labs/sandbox/sandbox.h"

/* A submission of one path unless it is SOURCE_FILES. */
typedef struct SandboxedCheck {
    const Lab *lab;
    uint64_t seed;
    SandboxSource kind;
    SandboxInputs inputs;
} SandboxedCheck;

bool sandboxed_check_start(const Sandbox *sandbox, SandboxRun *run, int slot,
                           const SandboxedCheck *check, Message *message);

/* The verdict of a run that has ended; for the untrusted process a crash or a timeout is one, too.
 * False, with a message: it has no valid one. */
bool sandboxed_check_end(const Sandbox *sandbox, const SandboxRun *run, const SandboxedCheck *check,
                         Verdict *verdict, Message *message);

/* Judges what is at `path`, a folder, an archive or a file, as a class's submissions are, with
 * `limit` seconds of processor time for compiling and drawing: diagnosing does not count. False,
 * with a message: this machine cannot; also if a lab with C has no sandbox. */
bool sandboxed_check(const JudgeOptions *options, const char *path, double limit, Verdict *verdict,
                     Message *message);

#endif
