/*
 * scratch: a temporary folder, for one run.
 */
#ifndef SCRATCH_H
#define SCRATCH_H

#include "message.h"

#include <limits.h>

/* Makes one in $TMPDIR, or /tmp, that is its user's alone. The name is empty where it fails. */
bool scratch_open(char folder[PATH_MAX], Message *message);

/* Removes it and what is in it, on its file system; follows no link. Of an empty name, nothing. */
void scratch_close(const char *folder);

#endif
