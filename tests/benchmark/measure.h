/*
 * measure: timings that can be compared on a noisy machine. Things to compare run in turn, round
 * after round, so that each round's ratios see the same machine; of those, medians and quartiles.
 */
#ifndef MEASURE_H
#define MEASURE_H

#include <stdbool.h>

/* One of the things that are compared. */
typedef struct Measured {
    const char *name;
    bool (*run)(void *argument); /* what is timed; false: it failed */
    void *argument;
    double *seconds; /* of each round; filled by measure_rounds */
} Measured;

/* Runs each once to warm up, then `rounds` times in turn. False where one failed, having said
 * which. Frees with measure_finish. */
bool measure_rounds(Measured *measured, int count, int rounds);
void measure_finish(Measured *measured, int count);

typedef struct Summary {
    double median, lower, upper; /* the middle and the quartiles */
} Summary;

Summary measure_summary(const double *values, int count);

/* Of the rounds' ratios a / b, each scaled. */
Summary measure_ratio(const Measured *a, const Measured *b, double scale, int rounds);

/* The machine in one line: processor, cores; and what every result is read with. */
void measure_print_machine(void);

#endif
