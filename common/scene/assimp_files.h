/*
 * assimp_files: the files that Assimp may open: the one that was asked for, and others in its
 * folder.
 */
#ifndef ASSIMP_FILES_H
#define ASSIMP_FILES_H

#include <assimp/cfileio.h>
#include <stddef.h>

typedef struct Folder {
    const char *path;
    size_t length; /* of the folder's name in the path, with its slash */
    char refused[256];
} Folder;

struct aiFileIO assimp_files(Folder *folder);

#endif
