/*
 * code: builds and calls a submission's C file.
 *
 * To be called inside the sandbox (sandbox/sandbox.h), where the compiler finds nothing but itself,
 * the headers and the lab's files. The compiler runs with limits on time, memory and file size; the
 * result is loaded and called in a process that can only compute and sends back only
 * numbers.
 */
#ifndef CODE_H
#define CODE_H

#include "base/message.h"
#include "labs/program/lab.h"
#include "labs/program/lab_code.h"
#include "labs/submission/verdict.h"

/* Called by a process before it loads untrusted machine code. From then on it can use memory, read
 * files while `loading`, write to open files, and end. It cannot start processes or threads, run
 * programs, create, change or remove files, use the network, or signal or trace other processes:
 * those calls fail with EPERM, for root too (seccomp(2)). Called again without `loading` it can
 * open nothing. Close first what must stay out of its reach. False if the kernel does not support
 * it: then load nothing. */
bool confine_process(bool loading, Message *message);

/* Lab 3's result for one time. */
typedef struct CodeMatrices {
    Mat4 world_from_model, normal_matrix;
} CodeMatrices;

/* A submission's C. */
typedef struct Code {
    const Lab *lab;     /* of which it is lab->code */
    const char *text;   /* of it */
    const char *folder; /* an existing empty one */
    Verdict *verdict;
} Code;

/* Both build it in its folder. True: there are numbers, finite and in range. False with a verdict
 * and no message: the submission is at fault; with a message: this machine is. */
bool code_matrices(const Code *code, const double *seconds, int count, CodeMatrices *matrices,
                   Message *message);
bool code_budget(const Code *code, LabBudget *budget, Message *message);

#endif
