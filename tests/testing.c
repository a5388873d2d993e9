#include "testing.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char testing_folder[] = "/tmp/lighting_test-XXXXXX";

void require(bool done, const Message *message)
{
    if (!done)
        fail_msg("%s", message->text);
}

int testing_enter_folder(void **state)
{
    (void)state;
    memcpy(testing_folder + sizeof testing_folder - 7, "XXXXXX", 6);
    return mkdtemp(testing_folder) && chdir(testing_folder) == 0 ? 0 : -1;
}

int testing_leave_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", testing_folder);
    return chdir("/") == 0 ? system(command) : -1;
}

int testing_entries(const char *folder)
{
    int count = -2; /* . and .. */
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    while (readdir(listing))
        count++;
    closedir(listing);
    return count;
}

int testing_open_files(void)
{
    return testing_entries("/proc/self/fd");
}

long testing_resident_kib(void)
{
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%*d %ld", &pages), 1);
    fclose(file);
    return pages * (sysconf(_SC_PAGESIZE) / 1024);
}
