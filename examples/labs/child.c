#include "child.h"

#include <errno.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

pid_t child_start(int *end, Message *message)
{
    int ends[2];
    if (pipe(ends) != 0) {
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

int child_wait(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}
