/*
 * undefined: what a submission's text alone says of its numbers: values that are never set, and
 * pictures that are black all over. By the evaluator, so that no driver decides it.
 */
#ifndef UNDEFINED_H
#define UNDEFINED_H

#include "labs/submission/lab_pictures.h"
#include "labs/submission/verdict.h"

/* Adds the mistake of a wrong submission that reads what it has not set, or draws only black in the
 * right places. *found: it is one of these. False, with a message: the driver failed. */
bool undefined_explain(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                       bool *found, Message *message);

/* Adds a symptom to a right submission that is right by chance: where it takes a power of a
 * negative number, or another number that is undefined. */
bool undefined_warn(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                    Message *message);

#endif
