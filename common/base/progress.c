/* One line, drawn again and again, and only on a terminal. */
#include "base/progress.h"

#include "base/clock.h"

#include <stdio.h>
#include <unistd.h>

Progress progress_start(const char *title)
{
    const double now = clock_now();
    return (Progress){.title = title, .start = now, .last = now};
}

void progress_update(Progress *progress, int done, int total)
{
    enum { CELLS = 30 };
    const double now = clock_now();
    if (now - progress->start < 1 || now - progress->last < 0.1 || !isatty(STDERR_FILENO))
        return;
    const int full = total > 0 ? (int)((long)CELLS * done / total) : 0;
    const double left = done > 0 ? (now - progress->start) * (total - done) / done : 0;
    fprintf(stderr, "\r%s [", progress->title);
    for (int i = 0; i < CELLS; i++)
        fputc(i < full ? '#' : '.', stderr);
    fprintf(stderr, "] %d/%d, %.0f s left\033[K", done, total, left);
    fflush(stderr);
    progress->last = now;
    progress->shown = true;
}

void progress_end(Progress *progress)
{
    if (progress->shown)
        fputs("\r\033[K", stderr);
    progress->shown = false;
}
