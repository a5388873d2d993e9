/*
 * scratch: a temporary folder for one run.
 */
#ifndef SCRATCH_H
#define SCRATCH_H

#include "base/message.h"

#include <limits.h>

/* Makes one in $TMPDIR or /tmp that only its user can enter. The name is empty on failure. */
bool scratch_open(char folder[PATH_MAX], Message *message);

/* Removes it with its contents; follows no link, stays on its file system. An empty name is fine.
 */
void scratch_close(const char *folder);

#endif
