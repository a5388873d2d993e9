/*
 * source: the files of one submission, as somebody handed them in.
 */
#ifndef SOURCE_H
#define SOURCE_H

#include "bundle.h"

#include <stdint.h>

enum { SOURCE_FILE_MOST = 256 << 10 }; /* bytes; the largest of the labs' own has 4000 */

/* Whether a path is that of a file to be judged: .vert, .frag, .glsl, .vs, .fs, .c or .h, in any
 * case, and no part of it hidden or of what macOS packs along ("__MACOSX", "._lab05.frag"). */
bool source_is_wanted(const char *path);

/* Adds the source files of a folder and of those in it. No link is followed. Refused, in one
 * sentence: a source file that is a link, a device, too large, and too many of them. */
bool source_read_folder(Bundle *bundle, const char *folder, Message *message);

/* Adds one file under the name `name`. */
bool source_read_file(Bundle *bundle, const char *path, const char *name, Message *message);

/* A number that changes when any name or byte does: FNV-1a (Fowler, Noll, Vo), 64 bits. Against
 * change, not against attack: who makes two submissions of one number keeps the result of the
 * first.
 */
uint64_t source_hash(const Bundle *bundle);
uint64_t source_hash_bytes(uint64_t hash, const void *bytes, size_t size);
#define SOURCE_HASH_START 14695981039346656037ULL

/* Keeps the files of the folder in which the submission is, and leaves its path out of their names:
 * the one nearest to the top that has source files. Of several equally near, the one whose name
 * begins as the lab's: "lab05"; false, with a message, where that decides nothing. */
bool source_choose(Bundle *bundle, int lab, Message *message);

#endif
