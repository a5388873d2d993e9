/*
 * watch: detects changes of files by their metadata; never reads them.
 *
 * Every 20 ms it compares device, inode, size, modification and status change times of each path,
 * following symbolic links. That covers a file written in place, replaced, removed or created, and
 * a link or folder on its way that now leads elsewhere, on any file system.
 *
 * A save in several steps is reported once, after the last step. Reports can be spurious: compare
 * contents to find out what changed.
 */
#ifndef WATCH_H
#define WATCH_H

#include <stdbool.h>

typedef struct Watch Watch;

/* Watches no path yet; the first watch_wait reports a change at once. */
Watch *watch_open(void);

/* Replaces the watched paths with copies of these. A path need not exist. The next watch_wait
 * reports a change, since earlier changes are unknown. */
void watch_set(Watch *watch, const char *const *paths, int count);

/* Waits for a change since the last report, at most `seconds`; 0: does not wait; HUGE_VAL: no
 * limit. */
bool watch_wait(Watch *watch, double seconds);

/* Accepts NULL. */
void watch_close(Watch *watch);

#endif
