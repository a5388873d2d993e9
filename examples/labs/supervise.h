/*
 * supervise: judges in a process of its own, which may hang, crash or take all memory.
 */
#ifndef SUPERVISE_H
#define SUPERVISE_H

#include "judge.h"

/* As judge. A submission that does not end within so many seconds is killed, with all that it
 * started, and VERDICT_TIMEOUT; one that brings the process down is VERDICT_ERROR. */
bool supervise(const JudgeOptions *options, double limit, Verdict *verdict, Message *message);

#endif
