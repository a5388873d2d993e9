/*
 * output: atomic file output: a file is written completely or not at all.
 */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "base/message.h"

#include <limits.h>
#include <stddef.h>

/* Writes `size` bytes to `path`:
 *   a regular or a new file: to a temporary file in the same folder, then renamed; on failure an
 *     existing file stays as it was and no temporary file remains;
 *   a symbolic link: the same for its target; the link stays;
 *   a device, a pipe, anything below /dev/fd or /proc: directly;
 *   "-": to standard output.
 * Fails if an existing file is not writable, even if its folder would allow replacing it. */
bool output_write(const char *path, const void *bytes, size_t size, Message *message);

/* The same for a file that is made in pieces or by another process: what was written to the
 * descriptor output_file(), which can be read and seeked, becomes the file on commit. output_begin
 * returns NULL, with a message, if output_write would fail; `path` must not be "-" and must outlive
 * the output. output_commit closes the output, whatever it returns; output_abort accepts NULL. */
typedef struct Output Output;
Output *output_begin(const char *path, Message *message);
int output_file(const Output *output);
bool output_commit(Output *output, Message *message);
void output_abort(Output *output);

/* Removes all named temporary files of this process. For what ends it, in a signal handler too: no
 * output is committed after this. */
void output_unlink_temporaries(void);

/* Writes all bytes to an open file; on failure sets errno. */
bool output_append(int file, const void *bytes, size_t size);

/* Sets the message that `path` cannot be written because of `error`, an errno. Returns false. */
bool output_failed(const char *path, int error, Message *message);

/* Whether output_write can succeed, for a check before long work: the folder exists and is
 * writable, `path` is not a folder. Writes nothing. */
bool output_check(const char *path, Message *message);

/* Creates a folder unless it exists. Fails if its path is too long for the files in it. */
bool output_folder(const char *path, Message *message);

/* FOLDER/NAME. False: too long, and the path is empty. */
bool output_path(char path[PATH_MAX], const char *folder, const char *name, Message *message);

/* The path of picture `number`: `pattern` must have exactly one conversion, of the form %d, %4d or
 * %04d; "%%" is a percent sign. Fails otherwise, or if the result is too long. */
bool output_numbered(const char *pattern, int number, char *path, size_t path_size,
                     Message *message);

#endif
