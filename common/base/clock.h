/*
 * clock: monotonic time and processor time, for measuring durations.
 */
#ifndef CLOCK_H
#define CLOCK_H

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

#endif
