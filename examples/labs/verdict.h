/*
 * verdict: what `check` found out about one submission, as plain data without pointers, so that the
 * process that judges can send it whole to the one that started it.
 *
 * Errors are in steps of 1/255, in the pixels through which no edge runs.
 */
#ifndef VERDICT_H
#define VERDICT_H

#include "lab.h"

#include <stdint.h>
#include <stdio.h>

typedef enum VerdictKind {
    VERDICT_ERROR, /* it does not compile, or could not be drawn */
    VERDICT_RIGHT,
    VERDICT_WRONG,
    VERDICT_REFUSED, /* its files are not what a submission may hold */
    VERDICT_TIMEOUT, /* it did not end */
} VerdictKind;

/* "error", "right", "wrong", "refused", "timeout". */
extern const char *const VERDICT_NAMES[];

enum {
    VERDICT_MOST_POINTS = 10,
    VERDICT_MOST_MISTAKES = 4,
    VERDICT_MOST_SYMPTOMS = 8,
    VERDICT_MOST_PROBES = 16,
    VERDICT_SENTENCE_SIZE = 512,
    VERDICT_DETAILS_SIZE = 4096,
};

/* A mistake that explains what was drawn. `sure` is 0 to 1. */
typedef struct VerdictMistake {
    char name[64];
    char sentence[VERDICT_SENTENCE_SIZE]; /* what is wrong */
    char look[VERDICT_SENTENCE_SIZE];     /* where to look for it */
    double sure;
} VerdictMistake;

/* One scene that it was drawn in. */
typedef struct VerdictProbe {
    char name[8];
    bool known; /* else of the seed */
    int width, height;
    double seconds;
    double maximum, rms;
    bool passed;
} VerdictProbe;

/* What a picture of lab 10 costs. */
typedef struct VerdictCost {
    bool known;
    double error;      /* the largest, in any scene */
    double time_ratio; /* over the time of the chapter's own program, `accuracy`'s usual setting */
    long operations;   /* of one picture: vertices and fragments, each times its operations; -1:
                          no tool counts them */
    double operations_ratio; /* over those of that program; -1: not counted */
} VerdictCost;

typedef struct Verdict {
    VerdictKind kind;
    uint64_t seed;
    double points;
    char message[VERDICT_SENTENCE_SIZE]; /* one sentence */
    char details[VERDICT_DETAILS_SIZE];  /* more lines: what the driver or compiler said */
    VerdictMistake mistakes[VERDICT_MOST_MISTAKES];
    int mistake_count;
    bool one_of; /* one of the mistakes, which these scenes cannot tell apart; else all of them */
    char symptoms[VERDICT_MOST_SYMPTOMS][VERDICT_SENTENCE_SIZE];
    int symptom_count;
    VerdictProbe probes[VERDICT_MOST_PROBES];
    int probe_count;
    char picture[64]; /* in the folder for pictures; empty: none */
    VerdictCost cost;
    double seconds; /* that the judging took */
} Verdict;

/* Adds text, cut where it is too long. */
void verdict_add_symptom(Verdict *verdict, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void verdict_add_mistake(Verdict *verdict, const char *name, const char *sentence, const char *look,
                         double sure);

/* Gives points: all for what is right; else one for what compiles and draws, and up to eight for
 * the share of scenes that it passes, in halves. In lab 10, see budget_score. */
void verdict_score(Verdict *verdict);

/* For a terminal. */
void verdict_print(const Verdict *verdict, const Lab *lab, const char *pictures, FILE *file);

#endif
