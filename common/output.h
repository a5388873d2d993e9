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

/* The same for a file that is made in pieces, or by others: what is written to output_file(), which
 * can be sought in and read, becomes the file when it is committed, and what was to be written
 * through goes there then. NULL, with a message, where output_write would fail; `path`, which is
 * not "-", must last. output_commit closes the output, whatever it returns; to abort NULL is fine.
 */
typedef struct Output Output;
Output *output_begin(const char *path, Message *message);
int output_file(const Output *output);
bool output_commit(Output *output, Message *message);
void output_abort(Output *output);

/* Removes temporary files that have a name, which few have for longer than a moment. For a handler
 * of signals that ends the process: nothing is written whole from then on. */
void output_unlink_temporaries(void);

/* Writes all of the bytes to an open file; false with errno set. */
bool output_append(int file, const void *bytes, size_t size);

/* Leaves the message that `path` cannot be written for the reason that errno gave; false. */
bool output_failed(const char *path, int error, Message *message);

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
