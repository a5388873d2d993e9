/*
 * Files are looked at by stat some times a second: notification by the kernel does not work on
 * every file system. Editors write a file in several steps, so a change is reported when all is
 * quiet again, or at last when it goes on for too long.
 */
#include "base/watch.h"

#include "base/clock.h"
#include "base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

/* Seconds between two looks at the paths. */
static const double PERIOD = 0.02;

/* Seconds without a further change before a change is reported. At least a tick of the kernel's
 * clock (10 ms at most), which timestamps are rounded to: a write after the report then always has
 * a later timestamp than the one compared with. */
static const double SETTLE_WHOLE = 0.01;
static const double SETTLE_PART = 0.06; /* a file is missing or empty: another step will follow */
static const double SETTLE_MAX = 0.1;   /* since the first step, however many follow */

typedef struct Stamp {
    int error; /* errno of stat; 0: the rest is valid */
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec modified, changed;
} Stamp;

typedef struct Watched {
    char *path;
    Stamp stamp;
} Watched;

struct Watch {
    Watched *files;
    int count;
    bool pending;   /* a change is not reported yet */
    double settled; /* when to report it */
    double latest;  /* the same, if changes go on */
    double look;    /* when to look next */
};

Watch *watch_open(void)
{
    Watch *watch = memory_new(1, sizeof *watch);
    watch->pending = true;
    return watch;
}

static void close_files(Watch *watch)
{
    for (int i = 0; i < watch->count; i++)
        free(watch->files[i].path);
    free(watch->files);
    watch->files = NULL;
    watch->count = 0;
}

static Stamp stamp_of(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return (Stamp){.error = errno};
    return (Stamp){.device = status.st_dev,
                   .inode = status.st_ino,
                   .size = status.st_size,
                   .modified = status.st_mtim,
                   .changed = status.st_ctim};
}

static bool time_equal(struct timespec a, struct timespec b)
{
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

static bool stamp_equal(const Stamp *a, const Stamp *b)
{
    return a->error == b->error && a->device == b->device && a->inode == b->inode &&
           a->size == b->size && time_equal(a->modified, b->modified) &&
           time_equal(a->changed, b->changed);
}

static void report_after(Watch *watch, double seconds)
{
    const double now = clock_now();
    if (!watch->pending)
        watch->latest = now + SETTLE_MAX;
    watch->pending = true;
    watch->settled = now + seconds;
}

void watch_set(Watch *watch, const char *const *paths, int count)
{
    close_files(watch);
    watch->files = memory_new((size_t)count, sizeof *watch->files);
    watch->count = count;
    for (int i = 0; i < count; i++)
        watch->files[i] = (Watched){memory_text(paths[i]), stamp_of(paths[i])};
    watch->pending = false;
    report_after(watch, SETTLE_WHOLE);
}

static void look(Watch *watch)
{
    for (int i = 0; i < watch->count; i++) {
        const Stamp now = stamp_of(watch->files[i].path);
        if (!stamp_equal(&now, &watch->files[i].stamp))
            report_after(watch, now.error || now.size == 0 ? SETTLE_PART : SETTLE_WHOLE);
        watch->files[i].stamp = now;
    }
    watch->look = clock_now() + PERIOD;
}

static double report_time(const Watch *watch)
{
    return watch->pending ? fmin(watch->settled, watch->latest) : HUGE_VAL;
}

static bool changed(Watch *watch)
{
    /* Before a report too: a last step may have come since the last look. */
    if (clock_now() >= fmin(watch->look, report_time(watch)))
        look(watch);
    const double now = clock_now();
    if (now < report_time(watch))
        return false;
    /* Reported while changes go on: reported again when they end. */
    watch->pending = now < watch->settled;
    watch->latest = now + SETTLE_MAX;
    return true;
}

static void sleep_until(double time)
{
    const double seconds = fmax(time - clock_now(), 0);
    nanosleep(&(struct timespec){.tv_nsec = (long)(1e9 * fmin(seconds, PERIOD))}, NULL);
}

bool watch_wait(Watch *watch, double seconds)
{
    const double end = clock_now() + seconds;
    while (!changed(watch)) {
        if (clock_now() >= end)
            return false;
        sleep_until(fmin(end, fmin(watch->look, report_time(watch))));
    }
    return true;
}

void watch_close(Watch *watch)
{
    if (!watch)
        return;
    close_files(watch);
    free(watch);
}
