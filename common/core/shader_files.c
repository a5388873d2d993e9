/* A list, searched linearly: a program reads some ten files. */
#include "core/shader_files.h"

#include "base/input.h"
#include "base/memory.h"
#include "base/text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void close_file(ShaderFile *file)
{
    free(file->path);
    free(file->text);
    free(file->problem);
    *file = (ShaderFile){0};
}

/* Reads an open file; false if it is not a shader file or cannot be read. */
static bool read_text(ShaderFile *file, int from, Message *message)
{
    struct stat status;
    if (fstat(from, &status) != 0)
        return message_set(message, "%s: %s", file->path, strerror(errno));
    file->device = status.st_dev;
    file->inode = status.st_ino;
    if (!S_ISREG(status.st_mode))
        return message_set(message, "%s: is not a regular file", file->path);
    if (status.st_size > SHADER_FILE_MAX)
        return message_set(message, "%s: has %lld bytes; at most %d are read", file->path,
                           (long long)status.st_size, SHADER_FILE_MAX);
    const size_t max = (size_t)status.st_size;
    file->text = memory_new(max + 1, 1);
    const ssize_t got = input_bytes(from, file->text, max);
    if (got < 0)
        return message_set(message, "%s: %s", file->path, strerror(errno));
    file->size = (size_t)got;
    file->text[file->size] = '\0';
    return true;
}

/* What is on disk. */
static ShaderFile open_file(const char *path)
{
    Message problem = {0};
    ShaderFile file = {.path = memory_text(path)};
    /* O_NONBLOCK: do not wait for the writer of a pipe. */
    const int from = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (from >= 0) {
        if (!read_text(&file, from, &problem)) {
            free(file.text);
            file.text = NULL;
            file.size = 0;
        }
        close(from);
    } else if (errno != ENOENT && errno != ENOTDIR) {
        message_set(&problem, "%s: %s", path, strerror(errno));
    }
    if (problem.text[0])
        file.problem = memory_text(problem.text);
    return file;
}

static ShaderFile *find(const ShaderFiles *files, const char *path)
{
    for (int i = 0; i < files->count; i++)
        if (strcmp(files->files[i].path, path) == 0)
            return &files->files[i];
    return NULL;
}

const ShaderFile *shader_files_get(ShaderFiles *files, const char *path)
{
    ShaderFile *known = find(files, path);
    if (known)
        return known;
    files->files = memory_grow(files->files, (size_t)files->count + 1, sizeof *files->files);
    files->files[files->count] = open_file(path);
    return &files->files[files->count++];
}

bool shader_files_same(const ShaderFiles *files, const char *a, const char *b)
{
    const ShaderFile *first = find(files, a), *second = find(files, b);
    return first && second && first->text && second->text && first->device == second->device &&
           first->inode == second->inode;
}

static bool text_equal(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

static bool file_equal(const ShaderFile *a, const ShaderFile *b)
{
    return !a->text == !b->text && a->size == b->size &&
           (!a->text || memcmp(a->text, b->text, a->size) == 0) &&
           text_equal(a->problem, b->problem);
}

const char *shader_files_changed(const ShaderFiles *files)
{
    for (int i = 0; i < files->count; i++) {
        ShaderFile now = open_file(files->files[i].path);
        const bool equal = file_equal(&now, &files->files[i]);
        close_file(&now);
        if (!equal)
            return files->files[i].path;
    }
    return NULL;
}

static bool is_in(const ShaderFile *file, const char *folder)
{
    const size_t length = strlen(folder);
    return strncmp(file->path, folder, length) == 0 && file->path[length] == '/';
}

static const char *name_of(const char *path)
{
    return strrchr(path, '/') + 1;
}

/* Whether a file of this name was read from the folder. */
static bool was_read(const ShaderFiles *files, const char *folder, const char *name)
{
    for (int i = 0; i < files->count; i++)
        if (files->files[i].text && is_in(&files->files[i], folder) &&
            strcmp(name_of(files->files[i].path), name) == 0)
            return true;
    return false;
}

/* Of a stage's file that was looked for and was not there: another of that stage beside it that
 * was probably meant to be it, as LightedCube.frag.txt. */
static void find_misnamed(const ShaderFiles *files, const char *folder, const char *path,
                          Message *message)
{
    const char *name = name_of(path), *ending = strrchr(name, '.');
    char beside[PATH_MAX];
    snprintf(beside, sizeof beside, "%.*s", (int)(name - 1 - path), path);
    DIR *entries = opendir(beside);
    for (struct dirent *entry; entries && (entry = readdir(entries));) {
        const char *const there[] = {entry->d_name, NULL};
        if (strcasestr(entry->d_name, ending) && !was_read(files, folder, entry->d_name) &&
            text_nearest(name, there))
            message_add(message, "%s%s/%s: ignored: the file looked for is %s",
                        message->text[0] ? "\n" : "", beside, entry->d_name, name);
    }
    if (entries)
        closedir(entries);
}

void shader_files_unused(const ShaderFiles *files, const char *folder, Message *message)
{
    bool any = false;
    for (int i = 0; i < files->count; i++) {
        const ShaderFile *file = &files->files[i];
        const char *ending = strrchr(file->path, '.');
        if (!is_in(file, folder))
            continue;
        any = any || file->text;
        if (!file->text && ending && (!strcmp(ending, ".vert") || !strcmp(ending, ".frag")) &&
            !was_read(files, folder, name_of(file->path)))
            find_misnamed(files, folder, file->path, message);
    }
    if (!any)
        message_set(message, "%s: ignored: no shader file of this program is there", folder);
}

void shader_files_close(ShaderFiles *files)
{
    if (!files)
        return;
    for (int i = 0; i < files->count; i++)
        close_file(&files->files[i]);
    free(files->files);
    *files = (ShaderFiles){0};
}
