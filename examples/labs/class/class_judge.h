/*
 * class_judge: judges every submission of a class in a sandbox, several at a time.
 */
#ifndef CLASS_JUDGE_H
#define CLASS_JUDGE_H

#include "labs/class/class_find.h"
#include "labs/class/class.h"
#include "labs/class/class_store.h"
#include "labs/sandbox/sandbox.h"

#include <signal.h>

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
 * *interrupted; false only if results cannot be written or processes cannot be started. */
bool class_judge(const ClassJudging *of, Message *message);

/* Whether a submission is in the part that the options name. Depends only on its folder's name, so
 * it stays the same whatever other submissions there are. */
bool class_in_part(const ClassOptions *options, const char *folder);

#endif
