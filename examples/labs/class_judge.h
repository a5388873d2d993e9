/*
 * class_judge: every submission of a class, each in a sandbox, several at a time.
 */
#ifndef CLASS_JUDGE_H
#define CLASS_JUDGE_H

#include "class_find.h"
#include "class_options.h"
#include "class_store.h"
#include "sandbox.h"

#include <signal.h>

/* Judges those that have no result that stands, and puts each result into the store as soon as it
 * is known; one line on standard error for each that could not be judged to its end. Ends early,
 * with true, when *interrupted; false only where results cannot be written or processes not be
 * started. */
bool class_judge(const ClassOptions *options, const Lab *lab, const FoundList *list,
                 const Sandbox *sandbox, ClassStore *store,
                 const volatile sig_atomic_t *interrupted, Message *message);

/* Whether a submission is in the part that the options name: as the name of its folder has it, so
 * that it is in the same one whoever else has handed in. */
bool class_in_part(const ClassOptions *options, const char *folder);

#endif
