#include "output.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* How a path is written. */
typedef struct Target {
    bool through;          /* open and write; else temporary file and rename */
    char path[PATH_MAX];   /* with links followed */
    char folder[PATH_MAX]; /* of `path` */
    bool replaces;         /* a file that is there */
    mode_t mode;           /* of that file */
} Target;

static bool starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

/* /dev/stdout and its like lead here: links that are not followed by name, but opened. */
static bool stands_for_open_file(const char *path)
{
    return starts_with(path, "/proc/") || starts_with(path, "/dev/fd/");
}

static bool set_folder(Target *target)
{
    const char *slash = strrchr(target->path, '/');
    const size_t length = slash ? (size_t)(slash - target->path) + 1 : 0;
    if (length + 1 > sizeof target->folder)
        return false;
    memcpy(target->folder, target->path, length);
    target->folder[length] = '\0';
    if (!length)
        memcpy(target->folder, "./", 3);
    return true;
}

/* Follows symbolic links by hand, for the last of them may point at a file that is not there. */
static bool follow_links(const char *path, Target *target, Message *message)
{
    enum { MOST_LINKS = 40 }; /* as Linux has it */
    if (snprintf(target->path, sizeof target->path, "%s", path) >= (int)sizeof target->path)
        return message_set(message, "%s: %s", path, strerror(ENAMETOOLONG));
    for (int i = 0; i <= MOST_LINKS; i++) {
        char link[PATH_MAX];
        if (stands_for_open_file(target->path))
            return true;
        const ssize_t length = readlink(target->path, link, sizeof link - 1);
        if (!set_folder(target))
            return message_set(message, "%s: %s", path, strerror(ENAMETOOLONG));
        if (length < 0)
            return true;
        link[length] = '\0';
        char joined[2 * PATH_MAX];
        snprintf(joined, sizeof joined, "%s%s", link[0] == '/' ? "" : target->folder, link);
        if (strlen(joined) >= sizeof target->path)
            return message_set(message, "%s: %s", path, strerror(ENAMETOOLONG));
        memcpy(target->path, joined, strlen(joined) + 1);
    }
    return message_set(message, "%s: %s", path, strerror(ELOOP));
}

static bool find_target(const char *path, Target *target, Message *message)
{
    struct stat status;
    *target = (Target){.mode = 0};
    if (!path[0])
        return message_set(message, "the output's name is empty");
    if (!follow_links(path, target, message))
        return false;
    const bool exists = stat(target->path, &status) == 0;
    if (!exists && errno != ENOENT)
        return message_set(message, "%s: %s", path, strerror(errno));
    if (exists && S_ISDIR(status.st_mode))
        return message_set(message, "%s: is a folder; name a file in it", path);
    target->through = (exists && !S_ISREG(status.st_mode)) || stands_for_open_file(target->path);
    target->replaces = exists;
    target->mode = exists ? status.st_mode & 0777 : 0;
    if (exists && access(target->path, W_OK) != 0)
        return message_set(message, "%s: %s", path, strerror(errno));
    if (target->through)
        return true;
    if (stat(target->folder, &status) != 0 || !S_ISDIR(status.st_mode))
        return message_set(message, "%s: the folder %s does not exist; make it first", path,
                           target->folder);
    if (access(target->folder, W_OK | X_OK) != 0)
        return message_set(message, "%s: cannot write to the folder %s: %s", path, target->folder,
                           strerror(errno));
    return true;
}

static bool write_all(int file, const void *bytes, size_t size)
{
    const char *next = bytes;
    while (size > 0) {
        const ssize_t written = write(file, next, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0 && errno == EAGAIN) { /* somebody set it not to wait */
            struct pollfd ready = {.fd = file, .events = POLLOUT};
            poll(&ready, 1, -1);
            continue;
        }
        if (written < 0)
            return false;
        next += written;
        size -= (size_t)written;
    }
    return true;
}

static bool fail(const char *path, int error, Message *message)
{
    const char *advice = error == ENOSPC || error == EDQUOT ? "; make room and run again" : "";
    return message_set(message, "%s: cannot write: %s%s", path, strerror(error), advice);
}

/* The number of the open file that a name stands for: /dev/fd/3, /proc/self/fd/3; or -1. */
static int open_file_number(const char *path)
{
    static const char *const starts[] = {"/proc/self/fd/", "/dev/fd/"};
    for (size_t i = 0; i < 2; i++) {
        const size_t length = strlen(starts[i]);
        char *end;
        if (strncmp(path, starts[i], length) != 0 || !isdigit((unsigned char)path[length]))
            continue;
        const long number = strtol(path + length, &end, 10);
        return *end || number > INT_MAX ? -1 : (int)number;
    }
    return -1;
}

static bool write_through(const char *path, const Target *target, const void *bytes, size_t size,
                          Message *message)
{
    /* An open file keeps its place and mode; opening it anew would cut it off. */
    const int number = open_file_number(target->path);
    const int file = number >= 0 ? fcntl(number, F_DUPFD_CLOEXEC, 3)
                                 : open(target->path, O_WRONLY | O_CLOEXEC | O_TRUNC);
    if (file < 0)
        return fail(path, errno, message);
    const bool written = write_all(file, bytes, size);
    const int error = errno;
    const bool closed = close(file) == 0;
    if (!written || !closed)
        return fail(path, written ? errno : error, message);
    return true;
}

/* A file that gets its name only when it is whole. */
typedef struct Temporary {
    int file;
    bool named;
    char name[PATH_MAX + 32];
} Temporary;

/* A name beside the target that nothing else has. */
static void temporary_try(Temporary *temporary, const char *folder, int number)
{
    snprintf(temporary->name, sizeof temporary->name, "%s.lighting-%ld-%d", folder, (long)getpid(),
             number);
}

enum { MOST_TRIES = 1000 };

/* Without any name where the file system has such files, so that not even a crash leaves one. The
 * process's mask decides on the permissions, as for any new file. */
static bool temporary_open(Temporary *temporary, const char *folder)
{
    /* It is named through /proc. */
    temporary->file = access("/proc/self/fd", X_OK) == 0
                          ? open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666)
                          : -1;
    temporary->named = temporary->file < 0;
    for (int i = 0; i < MOST_TRIES && temporary->file < 0; i++) {
        temporary_try(temporary, folder, i);
        temporary->file = open(temporary->name, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (temporary->file < 0 && errno != EEXIST)
            break;
    }
    return temporary->file >= 0;
}

/* linkat cannot replace a file and rename needs a name: give one first, beside the target. */
static bool temporary_name(Temporary *temporary, const char *folder)
{
    char self[64];
    if (temporary->named)
        return true;
    snprintf(self, sizeof self, "/proc/self/fd/%d", temporary->file);
    for (int i = 0; i < MOST_TRIES && !temporary->named; i++) {
        temporary_try(temporary, folder, i);
        temporary->named =
            linkat(AT_FDCWD, self, AT_FDCWD, temporary->name, AT_SYMLINK_FOLLOW) == 0;
        if (!temporary->named && errno != EEXIST)
            break;
    }
    return temporary->named;
}

static bool replace(const char *path, const Target *target, const void *bytes, size_t size,
                    Message *message)
{
    Temporary temporary;
    if (!temporary_open(&temporary, target->folder))
        return fail(path, errno, message);
    bool done =
        write_all(temporary.file, bytes, size) && temporary_name(&temporary, target->folder);
    int error = errno;
    /* Where a file system does not let the mode be kept, the picture is worth more than the mode.
     */
    if (done && target->replaces)
        (void)!fchmod(temporary.file, target->mode);
    if (close(temporary.file) != 0 && done) { /* some file systems report a full disk only here */
        done = false;
        error = errno;
    }
    if (done && rename(temporary.name, target->path) != 0) {
        done = false;
        error = errno;
    }
    if (!done && temporary.named)
        unlink(temporary.name);
    return done ? true : fail(path, error, message);
}

bool output_write(const char *path, const void *bytes, size_t size, Message *message)
{
    if (strcmp(path, "-") == 0) {
        if (write_all(STDOUT_FILENO, bytes, size))
            return true;
        return fail("standard output", errno, message);
    }
    Target target;
    if (!find_target(path, &target, message))
        return false;
    return target.through ? write_through(path, &target, bytes, size, message)
                          : replace(path, &target, bytes, size, message);
}

bool output_check(const char *path, Message *message)
{
    Target target;
    return strcmp(path, "-") == 0 || find_target(path, &target, message);
}

bool output_numbered(const char *pattern, int number, char *path, size_t path_size,
                     Message *message)
{
    bool found = false;
    size_t used = 0;
    for (const char *p = pattern; *p; p++) {
        char piece[64] = {*p, '\0'};
        if (*p == '%' && p[1] == '%') {
            p++;
        } else if (*p == '%') {
            const bool zeros = p[1] == '0';
            const char *digits = p + 1 + zeros;
            const char *end = digits;
            while (*end >= '0' && *end <= '9')
                end++;
            const int width = end > digits ? atoi(digits) : 0;
            if (*end != 'd' || end - digits > 2 || width > 20 || found)
                return message_set(message,
                                   "%s: one number is needed in the name, as %%d or %%03d, and "
                                   "%%%% for a percent sign",
                                   pattern);
            snprintf(piece, sizeof piece, zeros ? "%0*d" : "%*d", width, number);
            found = true;
            p = end;
        }
        const size_t length = strlen(piece);
        if (used + length + 1 > path_size)
            return message_set(message, "%s: %s", pattern, strerror(ENAMETOOLONG));
        memcpy(path + used, piece, length + 1);
        used += length;
    }
    if (!found)
        return message_set(message,
                           "%s: several pictures need a number in the name, as in "
                           "picture%%03d.png",
                           pattern);
    return true;
}

bool output_folder(const char *path, Message *message)
{
    struct stat status;
    if (strlen(path) > PATH_MAX - 128)
        return message_set(message, "%s: %s", path, strerror(ENAMETOOLONG));
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        return message_set(message, "%s: cannot make the folder: %s", path, strerror(errno));
    if (stat(path, &status) != 0 || !S_ISDIR(status.st_mode))
        return message_set(message, "%s: is there already and no folder", path);
    return true;
}
