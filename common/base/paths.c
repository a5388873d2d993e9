/* Three places, by the program's own path: it lies in the build folder, or in an installation. */
#include "base/paths.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool paths_program(char path[PATH_MAX], Message *message)
{
    const ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    path[length > 0 ? length : 0] = '\0';
    return length > 0 || message_set(message, "/proc/self/exe: %s", strerror(errno));
}

static bool join(char path[PATH_MAX], const char *root, const char *folder, const char *file)
{
    return snprintf(path, PATH_MAX, "%s%s%s%s%s", root, folder[0] ? "/" : "", folder,
                    file[0] ? "/" : "", file) < PATH_MAX;
}

/* Of a program PREFIX/bin/NAME. */
static bool own_prefix(char prefix[PATH_MAX])
{
    char *slash = NULL;
    bool found = paths_program(prefix, NULL);
    for (int i = 0; i < 2 && found; i++) {
        found = (slash = strrchr(prefix, '/')) != NULL;
        if (found)
            *slash = '\0';
    }
    return found;
}

bool paths_data(PathsPlace place, const char *source, const char *installed, char path[PATH_MAX])
{
    char prefix[PATH_MAX];
    if (place == PATHS_SOURCE)
        return join(path, SOURCE_ROOT, source, "");
    if (place == PATHS_BESIDE)
        return own_prefix(prefix) && join(path, prefix, DATA_FOLDER, installed);
    return join(path, DATA_INSTALLED, installed, "");
}

bool paths_find_data(const char *source, const char *installed, char path[PATH_MAX])
{
    for (int place = 0; place < PATHS_PLACE_COUNT; place++)
        if (paths_data((PathsPlace)place, source, installed, path) && access(path, F_OK) == 0)
            return true;
    return false;
}

bool paths_plugin(PathsPlace place, const char *file, char path[PATH_MAX])
{
    char program[PATH_MAX];
    const bool built =
        paths_program(program, NULL) && strncmp(program, BUILD_ROOT "/", sizeof BUILD_ROOT) == 0;
    if (built != (place == PATHS_SOURCE))
        return false;
    if (place == PATHS_SOURCE)
        return join(path, BUILD_ROOT, "common", file);
    if (place == PATHS_BESIDE)
        return own_prefix(program) && join(path, program, PLUGIN_FOLDER, file);
    return join(path, PLUGINS_INSTALLED, file, "");
}
