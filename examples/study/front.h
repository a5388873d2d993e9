/*
 * front: the efficient settings: those that no other beats in both error and time.
 */
#ifndef FRONT_H
#define FRONT_H

#include "results.h"

/* Which error counts. */
typedef enum ErrorKind { ERROR_INTERIOR_MAXIMUM, ERROR_INTERIOR_RMS, ERROR_ALL_RMS } ErrorKind;

double row_error(const ResultRow *row, ErrorKind kind);

/* Rows whose errors lie closer than this, in steps of 1/255, count as equally exact. */
#define FRONT_EQUAL_ERROR 0.01

/* Whether a is faster than b, as far as was measured: b's time is longer than a's by more than the
 * larger noise of the two,
 *   b->time > a->time * (1 + max(a->noise, b->noise)),
 * and a was the faster one in each of the runs. Where any of these numbers is not known: no. Where
 * neither is faster than the other, they are tied: no one may call one of them faster. (From a
 * faster than b and b faster than c follows a faster than c; from two ties nothing follows.)
 * The rows are of one scene, size, renderer and number of threads, as results_read leaves them. */
bool row_faster(const ResultRow *a, const ResultRow *b);

/* Whether a makes b superfluous: b is not faster than a, and a's error is less than b's plus
 * FRONT_EQUAL_ERROR. Of two that are tied and equally exact each beats the other. */
bool row_beats(const ResultRow *a, const ResultRow *b, ErrorKind kind);

/* The efficient ones among the rows of `scene`, from the cheapest (and most wrong) to the dearest
 * (and most exact). Each is faster than all that follow, and less exact than they are by
 * FRONT_EQUAL_ERROR or more: no two that are tied are among them. Every other row is beaten by one
 * of them; among tied rows that is the most exact one, and among those that are tied and equally
 * exact the one with the fewest choices that are not usual. Rows whose time or error is not known
 * do not take part; of several with one setting the latest does.
 *
 * Tied are the others that the medians of their times, taken at their word, would make efficient:
 * what is measured does not tell whether they are. */
typedef struct Front {
    const ResultRow **rows, **tied;
    int count, tied_count;
} Front;

bool front_open(Front *front, const Results *results, const char *scene, ErrorKind kind,
                Message *message);

/* Whether a row is one of the efficient ones; whether it is one of the tied. */
bool front_has(const Front *front, const ResultRow *row);
bool front_ties(const Front *front, const ResultRow *row);

/* The cheapest row whose error is at most `error`; NULL where none is. The most exact row whose
 * time is at most `time` milliseconds; NULL where none is. */
const ResultRow *front_cheapest(const Front *front, ErrorKind kind, double error);
const ResultRow *front_most_exact(const Front *front, double time);

void front_close(Front *front);

#endif
