/*
 * progress: a progress bar on standard error, if that is a terminal.
 */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>

typedef struct Progress {
    const char *title;
    double start, last; /* seconds */
    bool shown;
} Progress;

Progress progress_start(const char *title);

/* Draws at most ten times a second, and nothing in the first second. */
void progress_update(Progress *progress, int done, int total);

/* Clears the bar. */
void progress_end(Progress *progress);

#endif
