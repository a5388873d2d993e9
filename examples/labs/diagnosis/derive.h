/*
 * derive: names a mistake that no catalogue has: the change of a right program (mutation.h) that
 * makes it compute what the submission computes.
 */
#ifndef DERIVE_H
#define DERIVE_H

#include "labs/submission/lab_pictures.h"
#include "labs/submission/verdict.h"

/* *named: a mistake was added, less sure if others draw the same and are as near to its text.
 * False, with a message: the driver failed. */
bool derive_name(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                 bool *named, Message *message);

#endif
