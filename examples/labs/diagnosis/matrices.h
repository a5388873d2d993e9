/*
 * matrices: lab 3's numbers against those of its task. No GL.
 */
#ifndef MATRICES_H
#define MATRICES_H

#include "labs/submission/lab_pictures.h"
#include "labs/submission/verdict.h"

/* The largest difference of a right model matrix's element, and of a right normal's coordinate: a
 * tenth of 0.01, the least that mistyping a number of the task changes. Computing in floats or with
 * pi as 3.14159 makes less than 0.0001. */
#define MATRICES_TOLERANCE 0.001

/* Whether the model matrices of all scenes and the directions of the faces' normals are right. If
 * not, *said is a sentence with the first wrong number. */
bool matrices_are_right(const LabPictures *pictures, char said[VERDICT_SENTENCE_SIZE]);

/* Adds a mistake if all model matrices are a product of the task's form in which one part has wrong
 * numbers. False: they are not. */
bool matrices_name(const LabPictures *pictures, Verdict *verdict);

#endif
