/*
 * output: bytes to a file, whole or not at all.
 */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "message.h"

#include <stddef.h>

/* Writes `size` bytes to `path`.
 *   a regular file, or a name that is not there yet: written to a temporary file in the same
 * folder, then renamed; on failure an existing file stays as it was and nothing is left behind; a
 * symbolic link: the file it points to is replaced in the same way, the link stays; a device, a
 * pipe, or anything below /dev or /proc: written through;
 *   "-": standard output.
 * An existing file that may not be written is refused, though its folder would allow replacing it.
 */
bool output_write(const char *path, const void *bytes, size_t size, Message *message);

/* Whether output_write has a chance, before the work is done: the folder is there and may be
 * written, the path is no folder. Writes nothing. */
bool output_check(const char *path, Message *message);

/* Makes a folder if it is not there. Its path is short enough for what will stand in it. */
bool output_folder(const char *path, Message *message);

/* The path of picture `number`: `pattern` has one conversion of the form %d, %4d or %04d, and "%%"
 * for a percent sign. False where it has none, several or another, or the result is too long. */
bool output_numbered(const char *pattern, int number, char *path, size_t path_size,
                     Message *message);

#endif
