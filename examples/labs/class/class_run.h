/*
 * class_run: what a run over a class was, so that parts can be joined without losing a student.
 *
 * OUT/run.json is written before the first submission is judged, and says which part of how many it
 * is, what it was judged by, and who is in it.
 */
#ifndef CLASS_RUN_H
#define CLASS_RUN_H

#include "labs/class/class_judge.h"

/* Writes it for the students of the list that are in the options' part. */
bool class_run_write(const ClassOptions *options, const Lab *lab, const FoundList *list,
                     Message *message);

/* Whether the results in the options' folders are all of one class, once each, and judged alike:
 * same lab, seed, limit, options and version; each part there, and each of its students with a
 * result. False, with what is mixed, double or missing. What is missing only goes into `missing`
 * where the options allow it: --partial. */
bool class_runs_join(const ClassOptions *options, Message *missing, Message *message);

#endif
