/*
 * paths: where the project's own files are: in the source tree and build folder, in an installation
 * that was moved together with the program, or in the configured prefix. Searched in that order.
 */
#ifndef PATHS_H
#define PATHS_H

#include "base/message.h"

#include <limits.h>

typedef enum PathsPlace {
    PATHS_SOURCE,
    PATHS_BESIDE, /* PREFIX/share/lighting, if the program is PREFIX/bin/NAME */
    PATHS_INSTALLED,
    PATHS_PLACE_COUNT,
} PathsPlace;

/* The running executable. */
bool paths_program(char path[PATH_MAX], Message *message);

/* The build folder that the running executable lies in, and its source tree; false: none. */
bool paths_build(char build[PATH_MAX], char source[PATH_MAX]);

/* A data file or folder by its path below the source tree and below share/lighting ("": that folder
 * itself). False if the path is too long, or if the program lies in no build folder (PATHS_SOURCE).
 */
bool paths_data(PathsPlace place, const char *source, const char *installed, char path[PATH_MAX]);

/* The first place where it exists; false: nowhere, and `path` is the last one tried. */
bool paths_find_data(const char *source, const char *installed, char path[PATH_MAX]);

/* A plugin's file, or with "" the plugins' folder. A program in the build folder has only the
 * plugins built with it, any other only installed ones: false for the other places. */
bool paths_plugin(PathsPlace place, const char *file, char path[PATH_MAX]);

#endif
