/* A reader of shader files records each path that it tried. So what --shaders was of no use for is
 * known afterwards: a folder of which nothing was read, or a file that is named almost as one that
 * was looked for there. */
#include "app/unused_shaders.h"

#include "base/text.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

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
 * was probably meant to be it. */
static void tell_misnamed(const char *program, const char *folder, const ShaderFiles *files,
                          const char *path)
{
    const char *name = name_of(path), *ending = strrchr(name, '.');
    char beside[PATH_MAX];
    snprintf(beside, sizeof beside, "%.*s", (int)(name - 1 - path), path);
    DIR *entries = opendir(beside);
    for (struct dirent *entry; entries && (entry = readdir(entries));) {
        const char *const there[] = {entry->d_name, NULL}, *dot = strrchr(entry->d_name, '.');
        if (dot && strcmp(dot, ending) == 0 && !was_read(files, folder, entry->d_name) &&
            text_nearest(name, there))
            fprintf(stderr, "%s: %s/%s: ignored: the file looked for is %s\n", program, beside,
                    entry->d_name, name);
    }
    if (entries)
        closedir(entries);
}

void unused_shaders_tell(const char *program, const char *folder, const ShaderFiles *files)
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
            tell_misnamed(program, folder, files, file->path);
    }
    if (!any)
        fprintf(stderr, "%s: --shaders %s: ignored: no shader file of this program is there\n",
                program, folder);
}
