/*
 * budget: the cost of lab 10's picture, and its points.
 */
#ifndef BUDGET_H
#define BUDGET_H

#include "core/canvas.h"
#include "labs/program/lab_code.h"
#include "labs/submission/submission.h"
#include "labs/submission/verdict.h"

/* Counts the operations of a picture, vertices times those of a vertex plus fragments times those
 * of a fragment, and the same for the chapter's own program (common/lighting/lighting, a sphere of
 * 64 x 64: the usual setting of `accuracy`); also measures both, alternating frames. Fills in the
 * verdict's cost and points: a right submission has 5, and up to 5 more for its operations: all at
 * 0.63 of the plain program's or fewer, none at as many. Counts are the same on every machine;
 * times are not, so they give no points. */
bool budget_score(const LabBudget *budget, GLuint program, Canvas *canvas,
                  const SubmissionFiles *files, Verdict *verdict, Message *message);

/* A lab's two shaders with all directives carried out as GLSL ES 1.00 has them. False, with a
 * message: one is in error; then `plain` has no files. */
bool budget_preprocess(const SubmissionFiles *files, SubmissionFiles *plain, Message *message);

#endif
