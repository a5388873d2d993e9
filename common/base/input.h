/*
 * input: whole files, and one from a folder that is not trusted.
 */
#ifndef INPUT_H
#define INPUT_H

#include "base/message.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* Reads `size` bytes of an open file, or all that are left; how many. -1, with errno: it fails. */
ssize_t input_bytes(int file, void *bytes, size_t size);

/* The bytes of a regular file of at most `max`, with a zero byte after them, to be freed. `path` is
 * taken from the open folder (AT_FDCWD: the current one); no link is followed, and no pipe waited
 * for. NULL, with a message that begins with `name`: it cannot be read. */
char *input_read(int folder, const char *path, const char *name, size_t max, size_t *size,
                 Message *message);

/* The same of any file that the user names. */
char *input_whole(const char *path, size_t *size, Message *message);

/* Whether a path that a file names leads out of the file's folder: it begins with a slash or has a
 * part "..". Backslashes are slashes. */
bool input_leaves(const char *path);

#endif
