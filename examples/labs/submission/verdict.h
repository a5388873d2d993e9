/*
 * verdict: the result of judging one submission, as plain data without pointers, so that the
 * judging process can send it through a pipe.
 *
 * Errors are in steps of 1/255, in pixels without an edge.
 */
#ifndef VERDICT_H
#define VERDICT_H

#include "labs/program/lab.h"

#include <stdint.h>
#include <stdio.h>

typedef enum VerdictKind {
    VERDICT_ERROR, /* does not compile, or could not be drawn */
    VERDICT_RIGHT,
    VERDICT_WRONG,
    VERDICT_REFUSED, /* its files are not allowed */
    VERDICT_TIMEOUT, /* did not end in time */
} VerdictKind;

/* "error", "right", "wrong", "refused", "timeout". */
extern const char *const VERDICT_NAMES[];
extern const char *const PART_NAMES[]; /* "not judged", "right", "wrong", "late" */

enum {
    VERDICT_POINTS_END = 1000,
    VERDICT_MAX_MISTAKES = 6,
    VERDICT_MAX_SYMPTOMS = 8,
    VERDICT_MAX_PROBES = 16,
    VERDICT_SENTENCE_SIZE = 512,
    VERDICT_DETAILS_SIZE = 4096,
};

/* A mistake that explains the pictures. `sure` is 0 to 1. */
typedef struct VerdictMistake {
    char name[128];
    char sentence[VERDICT_SENTENCE_SIZE]; /* what is wrong */
    char look[VERDICT_SENTENCE_SIZE];     /* completes "Look at ..." */
    double sure;
    /* All is right, once the others are mended, with `change` instead of `text`, which is at the
     * line and column of the file. A line of 0: not known. */
    char file[64];
    int line, column;
    char text[VERDICT_SENTENCE_SIZE], change[VERDICT_SENTENCE_SIZE];
} VerdictMistake;

/* The result of one scene. */
typedef struct VerdictProbe {
    char name[8];
    bool known; /* else of the seed */
    int width, height;
    double seconds;
    double maximum, rms;
    bool passed;
} VerdictProbe;

/* A part of the points (lab.h), or, less than 0, what is taken of `most`. */
typedef enum PartState { PART_UNSEEN, PART_RIGHT, PART_WRONG, PART_LATE } PartState;
typedef struct VerdictPart {
    char name[64];
    double points, most;
    PartState state;
} VerdictPart;

/* The cost of lab 10's picture. */
typedef struct VerdictCost {
    bool known;              /* and counted */
    double error;            /* the largest of all scenes */
    double time_ratio;       /* to the chapter's own program in `accuracy`'s usual setting */
    double operations;       /* of all vertices and fragments */
    double operations_ratio; /* to that program's */
} VerdictCost;

typedef struct Verdict {
    VerdictKind kind;
    uint64_t seed;
    double points, most;
    VerdictPart parts[LAB_MAX_PARTS + 1];
    int part_count;
    char message[VERDICT_SENTENCE_SIZE]; /* one sentence */
    char details[VERDICT_DETAILS_SIZE];  /* more lines: from driver or compiler */
    VerdictMistake mistakes[VERDICT_MAX_MISTAKES];
    int mistake_count;
    char symptoms[VERDICT_MAX_SYMPTOMS][VERDICT_SENTENCE_SIZE];
    int symptom_count;
    VerdictProbe probes[VERDICT_MAX_PROBES];
    int probe_count;
    bool undefined;   /* what is drawn is the driver's choice, so that no scene counts */
    char picture[64]; /* in the folder for pictures; empty: none */
    VerdictCost cost;
    double seconds; /* of judging */
} Verdict;

/* Adds text, cut if too long. */
void verdict_add_symptom(Verdict *verdict, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
VerdictMistake *verdict_add_mistake(Verdict *verdict, const char *name, const char *sentence,
                                    const char *look, double sure); /* NULL: there are too many */

/* One that says nothing yet: no points of as many as the lab has. */
void verdict_begin(Verdict *verdict, const Lab *lab, uint64_t seed);

/* The verdict on a submission whose files cannot be judged. */
void verdict_refuse(Verdict *verdict, const Lab *lab, uint64_t seed, const Message *why);

/* Sets the points: all if right; otherwise those for compiling and drawing, for the share of scenes
 * passed, and for the parts that are right. Lab 10: see budget_score. */
void verdict_score(Verdict *verdict, const Lab *lab);

/* Takes what the lab's rule takes for so many days. */
void verdict_late(Verdict *verdict, const Lab *lab, int days);

/* Each as "ambient: right, 2 of 2 points". */
void verdict_parts(const Verdict *verdict, const char *before, const char *after, FILE *file);

/* For a terminal. */
void verdict_print(const Verdict *verdict, const Lab *lab, const char *pictures, FILE *file);

#endif
