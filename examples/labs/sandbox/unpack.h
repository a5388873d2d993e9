/*
 * unpack: reads the source files of an archive into memory.
 *
 * Runs in a sandbox, because it parses untrusted input. It writes nothing to disk, so paths, links
 * and devices in the archive are harmless.
 */
#ifndef UNPACK_H
#define UNPACK_H

#include "labs/sandbox/bundle.h"

enum {
    UNPACK_ENTRIES_MAX = 4096,
    UNPACK_BYTES_MAX = 256 << 20, /* of all contents */
};

/* Whether a file's name is that of an archive: .zip, .tar, .tgz, .tar.gz, .tar.xz, .tar.bz2,
 * .tar.zst, .7z. */
bool unpack_is_archive(const char *name);

/* Adds the source files (source_is_wanted) of the archive open as `file`. Refused, with one
 * sentence: absolute paths and paths out of the folder, links and devices instead of source files,
 * too large or too many files, and contents of more than UNPACK_BYTES_MAX. */
bool unpack_sources(Bundle *bundle, int file, Message *message);

#endif
