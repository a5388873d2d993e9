/* Programs are started by posix_spawn, with their signals and open files reset; answers of a fork
 * come back through a pipe. */
#include "base/process.h"

#include "base/clock.h"
#include "base/sanitized.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

int process_start(pid_t *process, const char *const *arguments, const int files[4])
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    int error = posix_spawn_file_actions_init(&actions);
    if (error)
        return error;
    for (int i = 0; i < 4 && !error; i++)
        error = files[i] < 0 ? posix_spawn_file_actions_addopen(&actions, i, "/dev/null", O_RDWR, 0)
                             : posix_spawn_file_actions_adddup2(&actions, files[i], i);
    if (!error)
        error = posix_spawnattr_init(&attributes);
    if (!error) {
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        error = posix_spawnp(process, arguments[0], &actions, &attributes, (char *const *)arguments,
                             environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

bool process_has(const char *setting)
{
    char **at = environ;
    while (*at && strcmp(*at, setting) != 0)
        at++;
    return *at != NULL;
}

bool process_restart(char *const *arguments, const char *const *settings, Message *message)
{
    bool there = true;
    for (; *settings; settings++) {
        if (process_has(*settings))
            continue;
        there = false;
        if (putenv((char *)*settings) != 0) /* which no one changes */
            return message_set(message, "%s: %s", *settings, strerror(errno));
    }
    if (there)
        return true;
    execv("/proc/self/exe", arguments);
    execvp(program_invocation_name, arguments); /* without /proc */
    return message_set(message, "this program cannot be started again: %s", strerror(errno));
}

pid_t process_fork(int *end, Message *message)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        message_set(message, "a pipe: %s", strerror(errno));
        return -1;
    }
    const pid_t child = fork();
    if (child < 0)
        message_set(message, "a second process: %s", strerror(errno));
    close(ends[child == 0 ? 0 : 1]);
    *end = ends[child == 0 ? 1 : 0];
    if (child < 0)
        close(*end);
    return child;
}

size_t process_read(int file, void *bytes, size_t size, double deadline)
{
    size_t got = 0;
    while (got < size) {
        struct pollfd ready = {.fd = file, .events = POLLIN};
        const double left = deadline - clock_now();
        if (left <= 0)
            break;
        const int count = poll(&ready, 1, (int)fmin(ceil(1e3 * left), 1e6));
        if (count == 0 || (count < 0 && errno == EINTR))
            continue;
        const ssize_t part = count < 0 ? -1 : read(file, (char *)bytes + got, size - got);
        if (part < 0 && errno == EINTR)
            continue;
        if (part <= 0)
            break;
        got += (size_t)part;
    }
    return got;
}

int process_wait(pid_t process)
{
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        continue;
    return status;
}

bool process_last_line(int file, char *line, size_t size)
{
    char text[4096];
    struct stat status;
    const off_t max = sizeof text - 1;
    if (fstat(file, &status) != 0)
        return false;
    ssize_t length =
        pread(file, text, (size_t)max, status.st_size > max ? status.st_size - max : 0);
    while (length > 0 && (unsigned char)text[length - 1] <= ' ')
        length--;
    if (length <= 0)
        return false;
    text[length] = '\0';
    char *newline = strrchr(text, '\n');
    /* ffmpeg's last line may end in a dash after which nothing comes: the line before has the
     * reason. */
    if (newline && length > 2 && strcmp(text + length - 2, "--") == 0) {
        *newline = '\0';
        newline = strrchr(text, '\n');
    }
    snprintf(line, size, "%s", newline ? newline + 1 : text);
    for (char *c = line; *c; c++)
        *c = (unsigned char)*c < ' ' ? ' ' : *c;
    return true;
}

void process_limit(rlim_t seconds, rlim_t memory)
{
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    if (!ADDRESS_SANITIZER && memory != RLIM_INFINITY)
        setrlimit(RLIMIT_AS, &(struct rlimit){memory, memory});
}

void process_null(int first, int last)
{
    const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int i = first; i <= last; i++)
        dup2(null, i);
}
