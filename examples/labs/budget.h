/*
 * budget: what a picture of lab 10 costs, and the points for it.
 */
#ifndef BUDGET_H
#define BUDGET_H

#include "canvas.h"
#include "lab_code.h"
#include "submission.h"
#include "verdict.h"

/* Counts the operations of a picture, those of a vertex times vertices and those of a fragment
 * times fragments, and the same for the chapter's own program (common/lighting, a sphere of 64 x
 * 64: the usual setting of `accuracy`); also measures both, frames in turn. Fills in the verdict's
 * cost, and its points: of what is right 5, and up to 5 more for its operations: all where they are
 * 0.63 of the plain program's or fewer, none where they are as many. The counts are the same on
 * every machine; times are not, so they give no points. */
bool budget_score(const LabBudget *budget, GLuint program, Canvas *canvas,
                  const SubmissionFiles *files, Verdict *verdict, Message *message);

#endif
