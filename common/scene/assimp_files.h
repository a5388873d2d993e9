/*
 * assimp_files: the files that Assimp may open: the one that was asked for, and others in its
 * folder.
 */
#ifndef ASSIMP_FILES_H
#define ASSIMP_FILES_H

#include <assimp/cfileio.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct Folder {
    const char *path;
    size_t length; /* of the folder's name in the path, with its slash */
    char refused[256];
} Folder;

struct aiFileIO assimp_files(Folder *folder);

/* Whether a PLY file was cut. */

/* False, with the reason, if the file ends before the rows that its header names; true of anything
 * that is no PLY file. */
bool model_ply_is_whole(const char *path, char *reason, size_t reason_size);

#endif
