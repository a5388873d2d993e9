/*
 * unpack: the source files in an archive, read into memory.
 *
 * Runs inside a sandbox, for it parses what strangers wrote. Nothing is written to disk: a path, a
 * link or a device in the archive has nothing to reach.
 */
#ifndef UNPACK_H
#define UNPACK_H

#include "bundle.h"

enum {
    UNPACK_ENTRIES_MOST = 4096,
    UNPACK_BYTES_MOST = 256 << 20, /* bytes of everything in it */
};

/* Whether a file's name is that of an archive: .zip, .tar, .tgz, .tar.gz, .tar.xz, .tar.bz2,
 * .tar.zst, .7z. */
bool unpack_is_archive(const char *name);

/* Adds the source files (source_is_wanted) of the archive that is open as `file`. Refused, in one
 * sentence: entries whose path is absolute or leaves the folder, links and devices in the place of
 * source files, files too large or too many, and whatever unpacks to more than
 * UNPACK_BYTES_MOST. */
bool unpack_sources(Bundle *bundle, int file, Message *message);

#endif
