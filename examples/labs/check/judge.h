/*
 * judge: compares one submission with the exact pictures of a lab's scenes.
 *
 * Submitted shaders may hang or crash the driver: call it in a separate process
 * (sandboxed_check.h).
 */
#ifndef JUDGE_H
#define JUDGE_H

#include "core/canvas.h"
#include "labs/submission/submission.h"
#include "labs/submission/verdict.h"

#include <sys/resource.h>

typedef struct JudgeOptions {
    const Lab *lab;
    const SubmissionFiles *files; /* the submission's */
    uint64_t seed;
    const CanvasBackend *backend; /* NULL: the default one */
    const char *scratch;          /* an empty folder; NULL if the lab has no C */
    const char *pictures;         /* the folder for the worst scene's picture; NULL: none */
} JudgeOptions;

/* Limits this process's processor time until the submission is drawn; diagnosing it does not count.
 */
void judge_limit(rlim_t seconds);

/* False, with a message, if this machine cannot judge: no driver, out of memory, pictures cannot be
 * written. Any fault of the submission is a verdict. */
bool judge(const JudgeOptions *options, Verdict *verdict, Message *message);

/* Writes the exact picture of a lab's usual scene at 1 s, as its task shows. */
bool judge_expected(const Lab *lab, const char *path, Message *message);

#endif
