/*
 * clock: monotonic time and processor time, for measuring durations, and quantiles of what was
 * measured.
 */
#ifndef CLOCK_H
#define CLOCK_H

#include <math.h>
#include <stdlib.h>
#include <time.h>

/* Seconds since an arbitrary fixed moment. */
static inline double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds that this process has computed, in all its threads: other processes do not add to it. */
static inline double clock_processor(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline int clock_compare(const void *a, const void *b)
{
    const double *x = (const double *)a, *y = (const double *)b;
    return (*x > *y) - (*x < *y);
}

/* Sorts the values and interpolates a quantile; NaN if there are none. */
static inline double clock_quantile(double *values, int count, double share)
{
    if (count == 0)
        return (double)NAN;
    qsort(values, (size_t)count, sizeof *values, clock_compare);
    const double at = share * (count - 1);
    const int below = (int)at;
    const int above = below + 1 < count ? below + 1 : below;
    return values[below] + (at - below) * (values[above] - values[below]);
}

static inline double clock_median(double *values, int count)
{
    return clock_quantile(values, count, 0.5);
}

#endif
