/*
 * watch: tells when something happens to files, without reading them.
 *
 * Their folders are watched with inotify, and so are the folders above them and those that symbolic
 * links lead through: an editor may replace a file, a whole folder may be renamed, a link may be
 * made to point elsewhere, and a file may come where there was none. Where inotify cannot be had,
 * or does not tell everything (a file system of another machine), the paths are looked at ten times
 * a second.
 *
 * What an editor does in several steps is told once, a moment after the last of them; and it may be
 * told that nothing has changed. Whoever wants to know what has changed looks.
 */
#ifndef WATCH_H
#define WATCH_H

#include "message.h"

typedef struct Watch Watch;

/* Of no path yet. Fails only without memory. */
bool watch_open(Watch **watch, Message *message);

/* These paths from now on; copied. A path need not exist. The next watch_changed is true: what
 * happened before is not known. */
bool watch_set(Watch *watch, const char *const *paths, int count, Message *message);

/* Whether something has happened since the last time that this was true. Does not wait. */
bool watch_changed(Watch *watch);

/* Waits for watch_changed, at most so many seconds; HUGE_VAL: for ever. */
bool watch_wait(Watch *watch, double seconds);

/* NULL, or why the paths are looked at ten times a second. Known after the first watch_changed. */
const char *watch_polls(const Watch *watch);

/* NULL is fine. */
void watch_close(Watch *watch);

#endif
