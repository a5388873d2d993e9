/* A page's files are at its root, beside no program and in no build folder. */
#include "base/paths.h"

#include <stdio.h>
#include <unistd.h>

bool paths_program(char path[PATH_MAX], Message *message)
{
    path[0] = '\0';
    return message_set(message, "a page has no program");
}

bool paths_data(PathsPlace place, const char *source, const char *installed, char path[PATH_MAX])
{
    (void)source;
    return place == PATHS_INSTALLED && snprintf(path, PATH_MAX, "/%s", installed) < PATH_MAX;
}

bool paths_find_data(const char *source, const char *installed, char path[PATH_MAX])
{
    return paths_data(PATHS_INSTALLED, source, installed, path) && access(path, F_OK) == 0;
}
