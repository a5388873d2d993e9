/* What a file is, is asked once it is open, so that it cannot be exchanged in between. */
#include "base/input.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *kind_of(mode_t mode)
{
    return S_ISDIR(mode) ? "a folder" : S_ISFIFO(mode) ? "a pipe" : "a device";
}

static bool check_file(int file, const char *name, size_t max, size_t *size, Message *message)
{
    struct stat status;
    if (fstat(file, &status) != 0)
        return message_set(message, "%s: %s", name, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return message_set(message, "%s: is %s; submit the file itself", name,
                           kind_of(status.st_mode));
    if (status.st_size > (off_t)max)
        return message_set(message, "%s: has %lld bytes; at most %zu are read", name,
                           (long long)status.st_size, max);
    *size = (size_t)status.st_size;
    return true;
}

char *input_read(int folder, const char *path, const char *name, size_t max, size_t *size,
                 Message *message)
{
    const int file = openat(folder, path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
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
    ssize_t got = bytes ? 1 : -1;
    for (*size = 0; got > 0 && *size<room; *size += got> 0 ? (size_t)got : 0)
        got = read(file, bytes + *size, room - *size);
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
