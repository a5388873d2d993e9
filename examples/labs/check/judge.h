/*
 * judge: compares one submission with the exact pictures of a lab's scenes.
 *
 * Submitted shaders may hang or crash the driver: call it in a separate process
 * (sandboxed_check.h).
 */
#ifndef JUDGE_H
#define JUDGE_H

#include "core/canvas.h"
#include "labs/diagnosis/diagnose.h"
#include "labs/submission/lab_pictures.h"
#include "labs/submission/submission.h"
#include "labs/submission/verdict.h"

#include <sys/resource.h>

/* The pictures that go with a verdict. */

/* The submission's picture, the right one and their difference, enlarged, side by side; below, a
 * value of the submission and the right one (`pixels` NULL: none). */
bool judge_sheet(const LabPictures *pictures, int picture, const Image *value, Image *sheet,
                 Message *message);

/* Draws the first wrong value of the submission and, below, the right one in that scene, in the
 * same colours, which a symptom explains. Nothing, if it cannot be drawn. */
void judge_value(const LabPictures *pictures, int picture, const SubmissionFiles *files,
                 FirstWrong *first, Canvas *canvas, Verdict *verdict);

/* The file that judge_worst writes. */
#define JUDGE_WORST "worst.png"

/* Writes that sheet as folder/worst.png (in a page: keeps it, see labs/web). */
bool judge_worst(const LabPictures *pictures, int picture, const Image *value, const char *folder,
                 Message *message);

/* |a - b|, brightened, where `exact` has no edge. */
bool judge_difference(const Image *a, const Image *b, const Reference *exact, Image *difference,
                      Message *message);

typedef struct JudgeOptions {
    const Lab *lab;
    const SubmissionFiles *files; /* the submission's */
    uint64_t seed;
    const CanvasBackend *backend; /* NULL: the default one */
    const char *scratch;          /* an empty folder; NULL if the lab has no C */
    const char *pictures;         /* the folder for the worst scene's picture; NULL: none */
} JudgeOptions;

/* Limits this process's processor time until the submission is drawn; diagnosing it does not count.
 */
void judge_limit(rlim_t seconds);

/* False, with a message, if this machine cannot judge: no driver, out of memory, pictures cannot be
 * written. Any fault of the submission is a verdict. */
bool judge(const JudgeOptions *options, Verdict *verdict, Message *message);

/* Says which changes of a lab's first solution no scene tells from it. False, with a message: it
 * has none, or does not compile. */
bool lab_report(const Lab *lab, FILE *file, Message *message);

/* Writes the exact picture of a lab's usual scene at 1 s, as its task shows. */
bool judge_expected(const Lab *lab, const char *path, Message *message);

#endif
