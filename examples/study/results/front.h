/*
 * front: the efficient settings (the Pareto front): no other beats them in both error and time.
 */
#ifndef FRONT_H
#define FRONT_H

#include "study/results/results.h"

/* Which error counts. */
typedef enum ErrorKind { ERROR_INTERIOR_MAXIMUM, ERROR_INTERIOR_RMS, ERROR_ALL_RMS } ErrorKind;

double row_error(const ResultRow *row, ErrorKind kind);

/* Rows whose errors lie closer than this, in steps of 1/255, count as equally exact. */
#define FRONT_EQUAL_ERROR 0.01

/* Whether a is significantly faster than b: the difference exceeds the larger noise of the two,
 *   b->time > a->time * (1 + max(a->noise, b->noise)),
 * and a was faster in each run. False if any of these numbers is unknown. If neither is faster than
 * the other, they are tied. ("Faster" is transitive, "tied" is not.) Rows of one scene, size,
 * renderer and number of threads, as results_read leaves them. */
bool row_faster(const ResultRow *a, const ResultRow *b);

/* Whether b is not faster than a and a's error is less than b's plus FRONT_EQUAL_ERROR. Two that
 * are tied and equally exact beat each other. */
bool row_beats(const ResultRow *a, const ResultRow *b, ErrorKind kind);

/* With a median noise above this the machine was busy, and times are not compared. */
#define FRONT_NOISE_BOUND 0.1

/* The median noise of a scene's rows, or of all (NULL); NAN: not known. And whether it is above the
 * bound. */
double front_noise(const Results *results, const char *scene);
bool front_busy(const Results *results, const char *scene);

/* The efficient rows of a scene, from the cheapest (least exact) to the most expensive (most
 * exact). Each is faster than all that follow, and less exact by at least FRONT_EQUAL_ERROR: no two
 * are tied. Every other row is beaten by one of them. Of tied rows the most exact one is chosen,
 * and of equally exact ones the one with the fewest unusual choices. Rows of unknown time or error
 * are ignored; of several rows with one setting the latest counts.
 *
 * `tied` has the rows that would be efficient by their median times alone. */
typedef struct Front {
    const ResultRow **rows, **tied;
    int count, tied_count;
} Front;

void front_open(Front *front, const Results *results, const char *scene, ErrorKind kind);

/* Whether a row is efficient; whether it is tied. */
bool front_has(const Front *front, const ResultRow *row);
bool front_ties(const Front *front, const ResultRow *row);

void front_close(Front *front);

#endif
