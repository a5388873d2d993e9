/*
 * judge: one submission against the exact pictures of a lab's scenes.
 *
 * What it draws need not end, and may bring the driver down: call it in a process of its own.
 */
#ifndef JUDGE_H
#define JUDGE_H

#include "canvas.h"
#include "verdict.h"

typedef struct JudgeOptions {
    const Lab *lab;
    const char *folder;           /* the submission's */
    uint64_t seed;                /* of the second set of scenes */
    const CanvasBackend *backend; /* NULL: the default one */
    const char *scratch;          /* an empty folder; NULL where the lab has no C */
    const char *pictures;         /* the folder for the worst scene's pictures; NULL: none */
} JudgeOptions;

/* False, with a message, where this machine could not judge: no driver, no memory, nowhere to write
 * pictures. Whatever is wrong with the submission is a verdict. */
bool judge(const JudgeOptions *options, Verdict *verdict, Message *message);

/* Draws a lab's usual scene, at 1 s, exactly, as the picture of its task. */
bool judge_expected(const Lab *lab, const char *path, Message *message);

#endif
