/* Three places, by the program's own path: it lies in a build folder or in an installation. No path
 * is compiled in but the prefix: an installed program knows nothing of the source tree. A program
 * of a build finds it by the file that meson writes into the build folder. */
#include "base/paths.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool paths_program(char path[PATH_MAX], Message *message)
{
    const ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    path[length > 0 ? length : 0] = '\0';
    /* Where /proc is not mounted, as in a plain chroot: as it was started. */
    return length > 0 || realpath(program_invocation_name, path) ||
           message_set(message, "/proc/self/exe: %s", strerror(errno));
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

static bool installed_data(char path[PATH_MAX], const char *file)
{
    char prefix[PATH_MAX];
    return own_prefix(prefix) && join(path, prefix, DATA_FOLDER, file);
}

bool paths_build(char build[PATH_MAX], char source[PATH_MAX])
{
    char path[PATH_MAX];
    bool found =
        paths_program(build, NULL) && !(installed_data(path, "") && access(path, F_OK) == 0);
    /* BUILD/examples/NAME, BUILD/tests/fuzz/NAME */
    for (int above = 0; above < 3 && found; above++) {
        char *slash = strrchr(build, '/');
        *(slash ? slash : build) = '\0';
        FILE *file = join(path, build, "", "source_root") ? fopen(path, "r") : NULL;
        const bool read = file && fgets(source, PATH_MAX, file);
        if (file)
            fclose(file);
        if (read) {
            source[strcspn(source, "\n")] = '\0';
            return true;
        }
    }
    return false;
}

bool paths_data(PathsPlace place, const char *source, const char *installed, char path[PATH_MAX])
{
    char build[PATH_MAX], root[PATH_MAX];
    if (place == PATHS_SOURCE)
        return paths_build(build, root) && join(path, root, source, "");
    if (place == PATHS_BESIDE)
        return installed_data(path, installed);
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
    char root[PATH_MAX], source[PATH_MAX];
    const bool built = paths_build(root, source);
    if (built != (place == PATHS_SOURCE))
        return false;
    if (place == PATHS_SOURCE)
        return join(path, root, "common", file);
    if (place == PATHS_BESIDE)
        return own_prefix(root) && join(path, root, PLUGIN_FOLDER, file);
    return join(path, PLUGINS_INSTALLED, file, "");
}
