/*
 * source: the source files of one submission.
 */
#ifndef SOURCE_H
#define SOURCE_H

#include "core/shader_files.h"
#include "labs/program/lab.h"
#include "labs/sandbox/bundle.h"
#include "labs/submission/submission.h"

#include <stdint.h>

enum { SOURCE_FILE_MAX = SHADER_FILE_MAX }; /* bytes; the largest of the labs' own has 4000 */

/* Whether a path is that of a source file: .vert, .frag, .glsl, .vs, .fs, .c or .h, in any case,
 * also with ".txt" added, with no part hidden or added by macOS ("__MACOSX", "._lab05.frag"). */
bool source_is_wanted(const char *path);

/* Adds the source files of a folder and its subfolders; follows no link. Refused, with one
 * sentence: a source file that is a link, a device or too large, and too many files. */
bool source_read_folder(Bundle *bundle, const char *folder, Message *message);

/* Adds one file under the name `name`. */
bool source_read_file(Bundle *bundle, const char *path, const char *name, Message *message);

/* Changes with any name or byte: FNV-1a (Fowler, Noll, Vo), 64 bits. Detects changes, not attacks:
 * of two submissions made to collide, the first keeps its result. */
uint64_t source_hash(const Bundle *bundle);
uint64_t source_hash_bytes(uint64_t hash, const void *bytes, size_t size);
/* Of a regular file of at most 64 MiB; messages begin with `name`. */
bool source_hash_file(const char *path, const char *name, uint64_t *hash, Message *message);
#define SOURCE_HASH_START 14695981039346656037ULL

/* Keeps the files of the submission's folder and removes its path from their names. It is the
 * topmost folder with source files; of several the one named like the lab ("lab05"). False, with a
 * message, if that does not decide. A folder with the unchanged starter does not count beside
 * another. */
bool source_choose(Bundle *bundle, const Lab *lab, Message *message);

/* Gives the files the names and the encoding that the lab needs: lower case, without ".txt" at the
 * end, "lab05.vert" for the only vertex shader, UTF-8 for UTF-16. */
void source_normalize(Bundle *bundle, const Lab *lab);

/* Of these the lab's files and those that shaders may include. False, with a message: one of the
 * former is missing, too large or no text. */
bool source_files(const Bundle *bundle, const Lab *lab, SubmissionFiles *files, Message *message);

/* The source files of an archive, in memory. Runs in a sandbox, because it parses untrusted input.
 * It writes nothing to disk, so paths, links and devices in the archive are harmless. */

enum {
    UNPACK_ENTRIES_MAX = 4096,
    UNPACK_BYTES_MAX = 256 << 20, /* of all contents */
};

/* Whether a file's name is that of an archive: .zip, .tar, .tgz, .tar.gz, .tar.xz, .tar.bz2,
 * .tar.zst, .7z. */
bool unpack_is_archive(const char *name);

/* Whether a path stays in the folder it would be unpacked in. */
bool unpack_stays_inside(const char *path);

/* Adds the source files (source_is_wanted) of the archive open as `file`. Refused, with one
 * sentence: absolute paths and paths out of the folder, links and devices instead of source files,
 * too large or too many files, and contents of more than UNPACK_BYTES_MAX. */
bool unpack_sources(Bundle *bundle, int file, Message *message);

#endif
