/* A name space begins empty; what follows puts into it only what is needed. */
#include "labs/sandbox/bubblewrap.h"

#include "base/memory.h"
#include "base/paths.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void words_add(Words *words, const char *const added[])
{
    for (; *added; added++) {
        words->words = memory_grow(words->words, (size_t)words->count + 2, sizeof *words->words);
        words->words[words->count++] = memory_text(*added);
        words->words[words->count] = NULL;
    }
}

#define ADD(words, ...) words_add(words, (const char *const[]){__VA_ARGS__, NULL})

void words_close(Words *words)
{
    for (int i = 0; i < words->count; i++)
        free(words->words[i]);
    free(words->words);
    *words = (Words){.count = 0};
}

/* Makes the folders above `path` accessible: bubblewrap's own are only for its user. */
static void add_folders_above(Words *words, const char *path)
{
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s", path);
    for (char *slash = strchr(folder + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        ADD(words, "--perms", "0755", "--dir", folder);
        *slash = '/';
    }
}

static void add_readable(Words *words, const char *path)
{
    if (!path[0] || access(path, F_OK) != 0 || strncmp(path, "/usr/", 5) == 0)
        return;
    add_folders_above(words, path);
    ADD(words, "--ro-bind", path, path);
}

/* The system's programs and libraries, in /usr or beside it. */
static void add_system(Words *words)
{
    static const char *const folders[] = {"/bin", "/lib", "/lib32", "/lib64", "/sbin"};
    ADD(words, "--ro-bind", "/usr", "/usr");
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        char target[PATH_MAX];
        const ssize_t length = readlink(folders[i], target, sizeof target - 1);
        target[length > 0 ? length : 0] = '\0';
        if (length > 0)
            ADD(words, "--symlink", target, folders[i]);
        else
            add_readable(words, folders[i]);
    }
    add_readable(words, "/etc/ld.so.cache");
    add_readable(words, "/etc/alternatives"); /* the link "cc" */
}

/* What the program needs to draw and to compile. */
static void add_own(Words *words)
{
    char path[PATH_MAX], source[PATH_MAX];
    if (paths_build(path, source) && strlen(path) + sizeof "/source_root" <= sizeof path)
        add_readable(words, strcat(path, "/source_root"));
    for (int i = 0; i < PATHS_PLACE_COUNT; i++) {
        const PathsPlace place = (PathsPlace)i;
        if (paths_data(place, "shaders", "", path))
            add_readable(words, path);
        if (place == PATHS_SOURCE && paths_data(place, "common", "", path))
            add_readable(words, path);
        if (paths_plugin(place, "", path))
            add_readable(words, path);
    }
}

void bubblewrap_begin(Words *words, const char *const seen[], long bytes)
{
    char size[32];
    snprintf(size, sizeof size, "%ld", bytes);
    ADD(words, "bwrap", "--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts",
        "--die-with-parent");
    /* As root no user namespace, because in it the process limit would not hold. Only the rights to
     * change the user remain, and to read what is bound before that. */
    if (getuid() == 0)
        ADD(words, "--cap-drop", "ALL", "--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID",
            "--cap-add", "CAP_DAC_READ_SEARCH");
    else
        ADD(words, "--unshare-user");
    add_system(words);
    ADD(words, "--proc", "/proc", "--dev", "/dev", "--perms", "1777", "--size", size, "--tmpfs",
        "/tmp");
    for (; *seen; seen++)
        add_readable(words, *seen);
    add_own(words);
}

void bubblewrap_bind(Words *words, const char *path, const char *place)
{
    ADD(words, "--ro-bind", path, place);
}

void bubblewrap_end(Words *words)
{
    /* These folders in memory have no size limit, and are not needed. */
    ADD(words, "--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/tmp", "--");
}
