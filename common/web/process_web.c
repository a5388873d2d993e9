/*
 * A page starts no processes. But it reads models in a worker: there, where PROCESS_FILE is empty,
 * a fork goes on as the child, whose answer is written to it; in the page, which gets that file, as
 * the parent. So what is read is checked as natively.
 */
#include "base/process.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#define PROCESS_FILE "/answer"

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
    struct stat status;
    *end = open(PROCESS_FILE, O_RDWR);
    if (*end >= 0 && fstat(*end, &status) == 0)
        return status.st_size > 0;
    message_set(message, "processes: not in the browser");
    return -1;
}

size_t process_read(int file, void *bytes, size_t size, double deadline)
{
    (void)deadline;
    const ssize_t got = read(file, bytes, size);
    return got < 0 ? 0 : (size_t)got;
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
