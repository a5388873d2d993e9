/*
 * shader_files: what loading shaders found on disk, kept.
 *
 * A file is read when it is first asked for, and is the same from then on, whatever becomes of it;
 * so is the absence of one. Programs can then be made again from what they were made of, while
 * somebody edits the files, and what has changed since can be told.
 */
#ifndef SHADER_FILES_H
#define SHADER_FILES_H

#include "message.h"

#include <stddef.h>
#include <sys/types.h>

/* Files larger than this are refused: no shader is. */
enum { SHADER_FILE_MOST = 999999 };

/* A path, and what was there. */
typedef struct ShaderFile {
    char *path;
    char *text;    /* its bytes and a zero; NULL: there was no file, or it could not be read */
    size_t size;   /* without the terminating zero */
    char *problem; /* why it could not be read, as a message says it; NULL: it could */
    dev_t device;  /* which file this is, however it is named */
    ino_t inode;
} ShaderFile;

/* Zeroed, there are none yet. */
typedef struct ShaderFiles {
    ShaderFile *files; /* in the order in which they were asked for */
    int count;
} ShaderFiles;

/* What was at `path` when it was first asked for. NULL where there is not enough memory. Valid
 * until the next call. */
const ShaderFile *shader_files_get(ShaderFiles *files, const char *path, Message *message);

/* Whether both paths, which have been asked for, named the same file. */
bool shader_files_same(const ShaderFiles *files, const char *a, const char *b);

/* The first path that now has something else than what was found there; NULL: none. */
const char *shader_files_changed(const ShaderFiles *files);

/* NULL or zeroed is fine. */
void shader_files_close(ShaderFiles *files);

#endif
