/*
 * statements: what a student wrote beyond the starter, statement by statement, so that submissions
 * can be compared whatever their names, comments and layout.
 */
#ifndef STATEMENTS_H
#define STATEMENTS_H

#include "labs/submission/submission.h"

/* All lines of a lab's files, each after the hashes of the statements that begin in it:
 *   1a2b3c4d,5e6f7a8b float nDotL = max(dot(n, l), 0.0); v_Color = vec4(nDotL);
 *   - }
 * Two statements have one hash if they have the same words and marks in any order; names that the
 * starter does not have count as one word. Statements of the starter have none. For free(). */
char *statements_text(const Lab *lab, const SubmissionFiles *files);

#endif
