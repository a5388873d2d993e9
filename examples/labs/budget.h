/*
 * budget: what a picture of lab 10 costs, and the points for it.
 */
#ifndef BUDGET_H
#define BUDGET_H

#include "canvas.h"
#include "lab_code.h"
#include "submission.h"
#include "verdict.h"

/* Measures the submission's program against the chapter's own (common/lighting, a sphere of 64 x
 * 64: the usual setting of `accuracy`), frames of both in turn, and counts operations where the
 * tools for it are there. Fills in the verdict's cost, and its points: of what is right 5, and up
 * to 5 more for time: all where it takes half of the plain program's or less, none where it takes
 * as long. */
bool budget_score(const LabBudget *budget, GLuint program, Canvas *canvas,
                  const SubmissionFiles *files, Verdict *verdict, Message *message);

#endif
