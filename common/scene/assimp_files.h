/*
 * assimp_files: the files that Assimp may open: the one that was asked for, and others in its
 * folder.
 */
#ifndef ASSIMP_FILES_H
#define ASSIMP_FILES_H

#include "base/message.h"

#include <assimp/cfileio.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct Folder {
    const char *path;
    size_t length; /* of the folder's name in the path, with its slash */
    char refused[256];
} Folder;

struct aiFileIO assimp_files(Folder *folder);

/* The bytes of a texture's image, in the scene or in the folder, to be freed; NULL, with why.
 */
char *assimp_texture(const struct aiScene *scene, const Folder *folder, const char *path,
                     size_t *size, Message *why);

#endif
