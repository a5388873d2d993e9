/* Every guarantee is tried, not assumed: kernels, containers and settings differ. */
#include "labs/sandbox/sandbox.h"

#include "base/paths.h"
#include "base/sanitized.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Starts up to SANDBOX_PROCESSES and a few processes, ends them, and returns how many started. */
static int count_processes(void)
{
    enum { TRIED = SANDBOX_PROCESSES + 16 };
    pid_t children[TRIED];
    int count = 0;
    while (count < TRIED && (children[count] = fork()) >= 0) {
        if (children[count] == 0) {
            pause();
            _exit(0);
        }
        count++;
    }
    for (int i = 0; i < count; i++)
        kill(children[i], SIGKILL);
    for (int i = 0; i < count; i++)
        waitpid(children[i], NULL, 0);
    return count;
}

static bool memory_is_limited(void)
{
    if (ADDRESS_SANITIZER)
        return true; /* cannot be limited in such a build */
    const size_t size = ((size_t)SANDBOX_MEMORY + 1) << 20;
    void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory != MAP_FAILED)
        munmap(memory, size);
    return memory == MAP_FAILED;
}

static bool files_are_limited(void)
{
    static const char byte = 0;
    const int file = open("large", O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0)
        return false;
    const bool limited = pwrite(file, &byte, 1, (off_t)SANDBOX_FILE << 20) < 0;
    const bool works = pwrite(file, &byte, 1, 0) == 1;
    close(file);
    unlink("large");
    return limited && works;
}

static bool reaches(int port)
{
    const struct sockaddr_in address = {.sin_family = AF_INET,
                                        .sin_port = htons((uint16_t)port),
                                        .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool reached =
        file >= 0 && connect(file, (const struct sockaddr *)&address, sizeof address) == 0;
    if (file >= 0)
        close(file);
    return reached;
}

static bool can_write(const char *folder)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/check-XXXXXX", folder);
    const int file = mkostemp(path, O_CLOEXEC);
    if (file < 0)
        return false;
    unlink(path);
    close(file);
    return true;
}

/* False, with a message that names the closed folder, if other users may not use the path. */
static bool may_use(const char *path, int mode, Message *message)
{
    char closed[PATH_MAX];
    if (access(path, mode) == 0 || errno != EACCES)
        return true;
    snprintf(closed, sizeof closed, "%s", path);
    for (char *slash = strchr(closed + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (access(closed, X_OK) != 0)
            break;
        *slash = '/';
    }
    return message_set(
        message,
        "%s: is closed to other users, but submissions are judged as user %ld instead "
        "of root; open it (chmod o+rx), or install the package bubblewrap",
        closed, (long)getuid());
}

bool breakout_try(const char *hidden, int port, const char *labs, unsigned *failed,
                  Message *message)
{
    char program[PATH_MAX];
    struct stat status;
    if (!paths_program(program, message) || !may_use(program, X_OK, message) ||
        !may_use(labs, R_OK | X_OK, message))
        return false;
    const int processes = count_processes();
    if (processes < 5)
        return message_set(message,
                           "only %d processes can be started; before Linux 5.14 other "
                           "programs of this user count",
                           processes);
    *failed = 0;
    if (stat(hidden, &status) != 0 && !can_write("/") && !can_write("/usr") &&
        !can_write("/var/tmp") && !can_write("/dev/shm"))
        *failed |= SANDBOX_NO_FILES;
    if (!reaches(port))
        *failed |= SANDBOX_NO_NETWORK;
    if (processes <= SANDBOX_PROCESSES && memory_is_limited() && files_are_limited())
        *failed |= SANDBOX_LIMITS;
    return true;
}
