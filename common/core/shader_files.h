/*
 * shader_files: a cache of the files that loading shaders has read or missed.
 *
 * A file is read on the first request and stays the same from then on, whatever happens on disk; a
 * missing file stays missing. So programs can be rebuilt from the same text while the files are
 * edited, and changes on disk can be detected.
 */
#ifndef SHADER_FILES_H
#define SHADER_FILES_H

#include "base/message.h"

#include <stddef.h>
#include <sys/types.h>

/* Larger files are rejected. */
enum { SHADER_FILE_MAX = 999999 };

/* A path, and what was there. */
typedef struct ShaderFile ShaderFile;
struct ShaderFile {
    char *path;
    char *text;    /* zero-terminated; NULL: no file, or it could not be read */
    size_t size;   /* without the terminating zero */
    char *problem; /* message why it could not be read; NULL: it could */
    dev_t device;  /* identity of the file, independent of its name */
    ino_t inode;
};

/* Zeroed: empty. */
typedef struct ShaderFiles ShaderFiles;
struct ShaderFiles {
    ShaderFile *files; /* in the order of the requests */
    int count;
};

/* What was at `path` when first requested. Valid until the next call. */
const ShaderFile *shader_files_get(ShaderFiles *files, const char *path);

/* Whether two requested paths named the same file. */
bool shader_files_same(const ShaderFiles *files, const char *a, const char *b);

/* The first path whose content on disk differs from the cache; NULL: none. */
const char *shader_files_changed(const ShaderFiles *files);

/* Says, afterwards, what a folder to look in first was of no use for: no file of it was read, or
 * one for a stage is named almost as one that was looked for there, as lightedcube.frag. */
void shader_files_unused(const ShaderFiles *files, const char *folder, Message *message);

/* NULL or zeroed is fine. */
void shader_files_close(ShaderFiles *files);

#endif
