/* What a file is, is asked once it is open, so that it cannot be exchanged in between. */
#include "base/input.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool check_file(int file, const char *name, size_t max, size_t *size, Message *message)
{
    struct stat status;
    if (fstat(file, &status) != 0)
        return message_set(message, "%s: %s", name, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return message_set(message, "%s: is %s; submit the file itself", name,
                           S_ISDIR(status.st_mode)    ? "a folder"
                           : S_ISFIFO(status.st_mode) ? "a pipe"
                                                      : "a device");
    if (status.st_size > (off_t)max)
        return message_set(message, "%s: has %lld bytes; at most %zu are read", name,
                           (long long)status.st_size, max);
    *size = (size_t)status.st_size;
    return true;
}

ssize_t input_bytes(int file, void *bytes, size_t size)
{
    size_t have = 0;
    ssize_t more = 1;
    while (have < size && more != 0) {
        more = read(file, (char *)bytes + have, size - have);
        if (more < 0 && errno != EINTR)
            return -1;
        have += more > 0 ? (size_t)more : 0;
    }
    return (ssize_t)have;
}

/* As openat, but of a folder nothing is opened through a link. */
static int open_below(int folder, const char *path, int flags)
{
    const char *slash = folder == AT_FDCWD ? NULL : strchr(path, '/');
    if (!slash)
        return openat(folder, path, flags);
    char *name = memory_copy(path, (size_t)(slash - path));
    const int inner = openat(folder, name, O_PATH | O_NOFOLLOW | O_CLOEXEC);
    struct stat status;
    const bool link = inner >= 0 && fstat(inner, &status) == 0 && S_ISLNK(status.st_mode);
    const int file = inner < 0 || link ? -1 : open_below(inner, slash + 1, flags);
    const int error = link ? ELOOP : errno;
    free(name);
    if (inner >= 0)
        close(inner);
    errno = error;
    return file;
}

char *input_read(int folder, const char *path, const char *name, size_t max, size_t *size,
                 Message *message)
{
    const int file = open_below(folder, path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        message_set(message, "%s: %s%s", name,
                    errno == ELOOP   ? "is a link"
                    : errno == ENXIO ? "is a socket"
                                     : strerror(errno),
                    errno == ELOOP || errno == ENXIO ? "; submit the file itself" : "");
        return NULL;
    }
    size_t room = 0;
    char *bytes = check_file(file, name, max, &room, message) ? malloc(room + 1) : NULL;
    const ssize_t got = bytes ? input_bytes(file, bytes, room) : -1;
    *size = got < 0 ? 0 : (size_t)got;
    if (got < 0) {
        message_set(message, "%s: %s", name, strerror(errno));
        free(bytes);
        bytes = NULL;
    }
    close(file);
    if (bytes)
        bytes[*size] = '\0';
    return bytes;
}

char *input_whole(const char *path, size_t *size, Message *message)
{
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    /* To read nothing fails of a folder, which may have a size. */
    const off_t room = file < 0 || read(file, NULL, 0) < 0 ? -1 : lseek(file, 0, SEEK_END);
    char *bytes = room < 0 || lseek(file, 0, SEEK_SET) != 0 ? NULL : malloc((size_t)room + 1);
    const ssize_t got = bytes ? input_bytes(file, bytes, (size_t)room) : -1;
    if (got >= 0) {
        *size = (size_t)got;
        bytes[got] = '\0';
    } else {
        message_set(message, "%s", bytes || room < 0 ? strerror(errno) : "not enough memory");
        free(bytes);
        bytes = NULL;
    }
    if (file >= 0)
        close(file);
    return bytes;
}

bool input_leaves(const char *path)
{
    for (const char *part = path; part; part = strpbrk(part, "/\\"), part = part ? part + 1 : NULL)
        if (strncmp(part, "..", 2) == 0 && (!part[2] || strchr("/\\", part[2])))
            return true;
    return path[0] == '/' || path[0] == '\\' || path[0] == '\0';
}
