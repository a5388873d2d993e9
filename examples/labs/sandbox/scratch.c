/* A folder from mkdtemp(3), removed by nftw(3). */
#include "labs/sandbox/scratch.h"

#include <errno.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool scratch_open(char folder[PATH_MAX], Message *message)
{
    const char *place = getenv("TMPDIR");
    const int length =
        snprintf(folder, PATH_MAX, "%s/check-XXXXXX", place && place[0] ? place : "/tmp");
    if (length < PATH_MAX && mkdtemp(folder))
        return true;
    message_set(message, "a temporary folder in %s: %s", place && place[0] ? place : "/tmp",
                strerror(length < PATH_MAX ? errno : ENAMETOOLONG));
    folder[0] = '\0';
    return false;
}

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *walk)
{
    (void)status;
    (void)kind;
    (void)walk;
    remove(path);
    return 0;
}

void scratch_close(const char *folder)
{
    if (folder[0])
        nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
}
