/* The C library's files as Assimp calls them; none outside the folder, and none to be written. */
#include "scene/assimp_files.h"

#include "base/input.h"
#include "base/memory.h"
#include "scene/scene_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_within(const Folder *folder, const char *path)
{
    const char *rest =
        strncmp(path, folder->path, folder->length) == 0 ? path + folder->length : "/";
    return strcmp(path, folder->path) == 0 ||
           (rest[0] != '/' && rest[0] != '\\' && !strstr(rest, "..") && !strstr(rest, ":"));
}

static size_t file_read(struct aiFile *file, char *bytes, size_t size, size_t count)
{
    return fread(bytes, size, count, (FILE *)file->UserData);
}

static size_t file_write(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file)
{
    return (size_t)ftell((FILE *)file->UserData);
}

static size_t file_size(struct aiFile *file)
{
    FILE *open = (FILE *)file->UserData;
    const long here = ftell(open);
    fseek(open, 0, SEEK_END);
    const long size = ftell(open);
    fseek(open, here, SEEK_SET);
    return size > 0 ? (size_t)size : 0;
}

static enum aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    const int from = origin == aiOrigin_CUR   ? SEEK_CUR
                     : origin == aiOrigin_END ? SEEK_END
                                              : SEEK_SET;
    return fseek((FILE *)file->UserData, (long)offset, from) == 0 ? aiReturn_SUCCESS
                                                                  : aiReturn_FAILURE;
}

static void file_flush(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *file_open(struct aiFileIO *io, const char *path, const char *mode)
{
    Folder *folder = (Folder *)io->UserData;
    FILE *open = NULL;
    if (strchr(mode, 'w') || !is_within(folder, path))
        snprintf(folder->refused, sizeof folder->refused, "%s", path);
    else
        open = fopen(path, "rb");
    struct aiFile *file = open ? malloc(sizeof *file) : NULL;
    if (file)
        *file = (struct aiFile){file_read, file_write, file_tell,   file_size,
                                file_seek, file_flush, (char *)open};
    return file;
}

static void file_close(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose((FILE *)file->UserData);
    free(file);
}

struct aiFileIO assimp_files(Folder *folder)
{
    return (struct aiFileIO){file_open, file_close, (char *)folder};
}

/* Textures */

/* A texture that the file holds: by its number, or by the name it had. */
static const struct aiTexture *find_held(const struct aiScene *scene, const char *path)
{
    for (unsigned i = 0; i < scene->mNumTextures; i++) {
        char number[16];
        snprintf(number, sizeof number, "*%u", i);
        if (strcmp(path, number) == 0 || strcmp(path, scene->mTextures[i]->mFilename.data) == 0)
            return scene->mTextures[i];
    }
    return NULL;
}

/* A file in the folder, or below; of another only the name counts, for files often have the path
 * that was right where they were made. */
static char *read_texture(const Folder *folder, const char *path, size_t *size, Message *why)
{
    char *name = memory_text(path), *bytes = NULL;
    for (char *c = name; *c; c++)
        *c = *c == '\\' ? '/' : *c;
    const char *last = strrchr(name, '/'), *tried = name;
    for (int i = 0; i < 2 && !bytes && tried; i++, tried = last ? last + 1 : NULL) {
        char *whole = memory_format("%.*s%s", (int)folder->length, folder->path, tried);
        if (i == 1 || (!input_leaves(name) && !strchr(name, ':')))
            bytes = input_read(AT_FDCWD, whole, tried, MODEL_BYTES_MAX, size, why);
        free(whole);
    }
    free(name);
    return bytes;
}

char *assimp_texture(const struct aiScene *scene, const Folder *folder, const char *path,
                     size_t *size, Message *why)
{
    const struct aiTexture *held = find_held(scene, path);
    if (!held)
        return read_texture(folder, path, size, why);
    *size = held->mWidth;
    if (held->mHeight == 0)
        return memory_copy(held->pcData, *size);
    message_set(why, "it is not compressed");
    return NULL;
}
