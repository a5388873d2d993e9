/*
 * undefined: what a submission's text alone says of its numbers: values that are never set, and
 * pictures that are black all over. By the evaluator, so that no driver decides it.
 */
#ifndef UNDEFINED_H
#define UNDEFINED_H

#include "labs/diagnosis/derivation.h"

/* Adds the mistake of a wrong submission: what it reads and has not set, or why it draws only black
 * in the right places; else what derive.h finds. False: it has no name. */
bool undefined_explain(Derivation *all, Verdict *verdict);

/* Adds a symptom to a right submission that is right by chance: where it takes a power of a
 * negative number, or another number that is undefined. *wrong: a mistake is added, because it
 * reads beyond an array. */
bool undefined_warn(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                    bool *wrong, Message *message);

#endif
