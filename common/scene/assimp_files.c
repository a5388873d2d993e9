/* The C library's files as Assimp calls them; none outside the folder, and none to be written. */
#include "scene/assimp_files.h"

#include <stdbool.h>
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
