/*
 * alone: judges one submission in a sandbox, as a class's are.
 */
#ifndef ALONE_H
#define ALONE_H

#include "labs/check/judge.h"

/* As judge, with `limit` as in supervise. A note on what does not hold on this machine is printed
 * to standard error. False, with a message: also if a lab with C has no sandbox. */
bool alone_judge(const JudgeOptions *options, double limit, Verdict *verdict, Message *message);

#endif
