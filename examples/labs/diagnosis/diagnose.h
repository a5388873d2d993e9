/*
 * diagnose: says what is wrong with a submission: by its outline, by its matrices (lab 3), and by
 * the change of its text or of a right program's that explains it.
 */
#ifndef DIAGNOSE_H
#define DIAGNOSE_H

#include "labs/submission/lab_pictures.h"
#include "labs/submission/verdict.h"

/* Draws all scenes with the submission and with shaders/labs/outline. */
bool outline_check(const LabPictures *pictures, const Painter *painter, Canvas *canvas, bool *wrong,
                   Message *message);

/* Lab 3's numbers against those of its task. No GL. */

/* The largest difference of a right model matrix's element, and of a right normal's coordinate: a
 * tenth of 0.01, the least that mistyping a number of the task changes. Computing in floats or with
 * pi as 3.14159 makes less than 0.0001. */
#define MATRICES_TOLERANCE 0.001

/* Whether the model matrices of all scenes and the directions of the faces' normals are right. If
 * not, *said is a sentence with the first wrong number. */
bool matrices_are_right(const LabPictures *pictures, char said[VERDICT_SENTENCE_SIZE]);

/* Fills in the message, and the mistakes if the matrices are those of another formula, or a product
 * of the task's form in which one part has wrong numbers. `code`: the submission's, or NULL. */
void matrices_name(const LabPictures *pictures, const char *code, Verdict *verdict);

/* A wrong picture in words. */

/* Adds the symptoms to the verdict. `moved`: the outline is wrong. */
void symptoms_describe(const LabPictures *pictures, bool moved, Verdict *verdict);

/* The first wrong value of a submission that one change makes right: its name, and the stage's
 * shader with the change, for free(). NULL: none is known. */
typedef struct FirstWrong {
    char name[64];
    int stage;
    char *right;
    Image value; /* see judge_value */
} FirstWrong;

/* Fills in the message and mistakes of a wrong submission that has shaders, and of one without a
 * name the part that is wrong. What is said to mend it is drawn on the canvas; NULL: it is not.
 * False, with a message: the driver failed. */
bool diagnose(const LabPictures *pictures, Canvas *canvas, const SubmissionFiles *files,
              Verdict *verdict, FirstWrong *first, Message *message);

/* Lists the values of a lab's solution that no scene tells from ones that are computed at the
 * vertices and interpolated. */
void at_vertices_report(const LabPictures *pictures, FILE *file, Message *message);

/* Says of a wrong submission which of its parts (verdict.h) are right. False, with a message: the
 * driver failed. */
bool parts_judge(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                 Message *message);

/* Adds a symptom to a right submission that is right by chance: where it takes a power of a
 * negative number, or another number that is undefined. *wrong: a mistake is added, because it
 * reads beyond an array. */
bool undefined_warn(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                    bool *wrong, Message *message);

#endif
