/*
 * supervise: judges in a separate process, which may hang, crash or use up memory.
 */
#ifndef SUPERVISE_H
#define SUPERVISE_H

#include "labs/check/judge.h"

/* As judge. A submission whose compiling and drawing takes longer than `limit`
 * seconds of processor time is killed with its children; diagnosing it does not count:
 * VERDICT_TIMEOUT; one that crashes the process is VERDICT_ERROR. */
bool supervise(const JudgeOptions *options, double limit, Verdict *verdict, Message *message);

#endif
