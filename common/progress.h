/*
 * progress: a bar on standard error while something takes long; nothing where that is no terminal.
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

/* `done` of `total` are done. Draws at most ten times a second, and nothing in the first second. */
void progress_update(Progress *progress, int done, int total);

/* Clears the bar. */
void progress_end(Progress *progress);

/* Seconds from some fixed moment, for measuring how long a thing takes. */
double progress_now(void);

#endif
