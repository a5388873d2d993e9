/* A page starts no processes. */
#include "base/process.h"

#include <errno.h>

int process_start(pid_t *process, const char *const *arguments, const int files[4])
{
    (void)process, (void)arguments, (void)files;
    return ENOSYS;
}

bool process_restart(char *const *arguments, const char *const *settings, Message *message)
{
    (void)arguments, (void)settings;
    return message_set(message, "processes: not in the browser");
}

pid_t process_fork(int *end, Message *message)
{
    *end = -1;
    message_set(message, "processes: not in the browser");
    return -1;
}

size_t process_read(int file, void *bytes, size_t size, double deadline)
{
    (void)file, (void)bytes, (void)size, (void)deadline;
    return 0;
}

int process_wait(pid_t process)
{
    (void)process;
    return 0;
}

bool process_last_line(int file, char *line, size_t size)
{
    (void)file, (void)line, (void)size;
    return false;
}

void process_limit(rlim_t seconds, rlim_t memory)
{
    (void)seconds, (void)memory;
}

void process_null(int first, int last)
{
    (void)first, (void)last;
}
