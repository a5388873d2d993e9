/*
 * code: the C file of a submission, built and called.
 *
 * Its text is looked at first: it may include only what the labs offer. The compiler runs with
 * limits on time, memory and file size; what it made is loaded and called in a process that can do
 * nothing but compute (confine.h), and only numbers come back.
 */
#ifndef CODE_H
#define CODE_H

#include "lab.h"
#include "lab_code.h"
#include "verdict.h"

/* What lab 3 says of one moment. */
typedef struct CodeMatrices {
    Mat4 world_from_model, normal_matrix;
} CodeMatrices;

/* Both build `text`, whose file is called lab->code, in a folder that is there and empty. True
 * where there are numbers, all finite and in their ranges; false with a verdict, and no message,
 * where the submission is at fault, and with a message where this machine is. */
bool code_matrices(const Lab *lab, const char *text, const char *folder, const double *seconds,
                   int count, CodeMatrices *matrices, Verdict *verdict, Message *message);
bool code_budget(const Lab *lab, const char *text, const char *folder, LabBudget *budget,
                 Verdict *verdict, Message *message);

#endif
