/*
 * A file is written under no name at all (O_TMPFILE), or where the file system has no such files
 * under a temporary one in the same folder, and gets its own by rename, which replaces a file in
 * one step: a reader sees the old file or the new one, never a part. rename would also replace a
 * link, or a device by a file, so links are followed by hand first and devices written through.
 * Temporary names stand in a table that a signal handler can read without locks: each entry changes
 * its state atomically.
 */
#include "base/output.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* How a path is written. */
typedef struct Target {
    bool through;          /* write directly; else to a temporary file, then rename */
    char path[PATH_MAX];   /* links resolved */
    char folder[PATH_MAX]; /* of `path`, with its slash */
    bool replaces;         /* the file exists */
    mode_t mode;           /* of the existing file */
} Target;

static bool starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

/* Where /dev/stdout and the like lead: links to be opened, not resolved by name. */
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

/* Resolves links by hand: realpath fails if the last one points to a file that does not exist. */
static bool follow_links(const char *path, Target *target, Message *message)
{
    enum { MAX_LINKS = 40 }; /* Linux's limit */
    if (snprintf(target->path, sizeof target->path, "%s", path) >= (int)sizeof target->path)
        return message_set(message, "%s: %s", path, strerror(ENAMETOOLONG));
    for (int i = 0; i <= MAX_LINKS; i++) {
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

bool output_append(int file, const void *bytes, size_t size)
{
    const char *next = bytes;
    while (size > 0) {
        const ssize_t written = write(file, next, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0 && errno == EAGAIN) { /* inherited as non-blocking */
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

bool output_failed(const char *path, int error, Message *message)
{
    const char *advice = error == ENOSPC || error == EDQUOT ? "; make room and run again" : "";
    return message_set(message, "%s: cannot write: %s%s", path, strerror(error), advice);
}

/* The descriptor in /dev/fd/3 or /proc/self/fd/3; -1: another path. */
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
    /* A duplicate keeps position and mode; opening it again would truncate it. */
    const int number = open_file_number(target->path);
    const int file = number >= 0 ? fcntl(number, F_DUPFD_CLOEXEC, 3)
                                 : open(target->path, O_WRONLY | O_CLOEXEC | O_TRUNC);
    if (file < 0)
        return output_failed(path, errno, message);
    const bool written = output_append(file, bytes, size);
    const int error = errno;
    const bool closed = close(file) == 0;
    if (!written || !closed)
        return output_failed(path, written ? errno : error, message);
    return true;
}

/* Names of temporary files, to be removed by what ends the process: a signal, lack of memory. A
 * thread that creates one blocks signals, so that the thread which handles the signal can wait for
 * it. A child process leaves its parent's alone. */
enum { MAX_NAMES = 16, NAME_FREE = 0 };

typedef struct Name {
    atomic_int state; /* NAME_FREE; P: the file of process P stands; -P: P changes it */
    char path[PATH_MAX + 32];
} Name;

static Name names[MAX_NAMES];
static atomic_bool ending;

/* Waits forever if another thread is ending the process: otherwise this one would report as missing
 * the temporary file that the other has removed, and exit with another code. */
static void leave_the_end_to_others(void)
{
    while (atomic_load(&ending))
        pause();
}

static Name *name_claim(sigset_t *before)
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, before);
    for (int i = 0; i < MAX_NAMES; i++) {
        int expected = NAME_FREE;
        if (!atomic_compare_exchange_strong(&names[i].state, &expected, -getpid()))
            continue;
        if (!atomic_load(&ending))
            return &names[i];
        atomic_store(&names[i].state, NAME_FREE);
        leave_the_end_to_others();
    }
    pthread_sigmask(SIG_SETMASK, before, NULL);
    errno = EMFILE;
    return NULL;
}

static void name_settle(Name *name, bool stands, const sigset_t *before)
{
    const int error = errno;
    atomic_store(&name->state, stands ? getpid() : NAME_FREE);
    pthread_sigmask(SIG_SETMASK, before, NULL);
    errno = error;
}

void output_unlink_temporaries(void)
{
    static const struct timespec moment = {.tv_nsec = 1000000};
    const int error = errno;
    atomic_store(&ending, true);
    for (int i = 0; i < MAX_NAMES; i++) {
        while (atomic_load(&names[i].state) == -getpid())
            nanosleep(&moment, NULL);
        if (atomic_load(&names[i].state) == getpid())
            unlink(names[i].path);
    }
    errno = error;
}

struct Output {
    const char *path; /* as given, for messages */
    Target target;
    int file;
    Name *name; /* of the temporary file; NULL: none yet */
};

/* Gives the temporary file an unused name beside the target: links the open file, or creates it. */
static bool output_name(Output *output)
{
    enum { MAX_TRIES = 1000 };
    errno = EEXIST;
    for (int i = 0; i < MAX_TRIES && !output->name && errno == EEXIST; i++) {
        char self[64];
        sigset_t before;
        Name *name = name_claim(&before);
        if (!name)
            return false;
        snprintf(name->path, sizeof name->path, "%s.lighting-%ld-%d", output->target.folder,
                 (long)getpid(), i);
        snprintf(self, sizeof self, "/proc/self/fd/%d", output->file);
        if (output->file < 0)
            output->file = open(name->path, O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
        else if (linkat(AT_FDCWD, self, AT_FDCWD, name->path, AT_SYMLINK_FOLLOW) != 0) {
            name_settle(name, false, &before);
            continue;
        }
        name_settle(name, output->file >= 0, &before);
        output->name = output->file < 0 ? NULL : name;
    }
    return output->name != NULL;
}

/* Without a name if the file system supports it (O_TMPFILE), so that even a crash leaves nothing.
 * The umask sets the permissions, as for any new file. */
static bool output_open(Output *output)
{
    if (output->target.through) {
        output->file = memfd_create("output", MFD_CLOEXEC);
        return output->file >= 0;
    }
    /* output_name needs /proc. */
    output->file = access("/proc/self/fd", X_OK) == 0
                       ? open(output->target.folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666)
                       : -1;
    return output->file >= 0 || output_name(output);
}

static void output_free(Output *output)
{
    if (output->file >= 0)
        close(output->file);
    if (output->name) {
        unlink(output->name->path);
        atomic_store(&output->name->state, NAME_FREE);
    }
    free(output);
}

static Output *begin(const char *path, const Target *target, Message *message)
{
    Output *output = malloc(sizeof *output); /* memory.h needs this module */
    if (!output) {
        message_set(message, "%s: not enough memory", path);
        return NULL;
    }
    *output = (Output){.path = path, .target = *target, .file = -1};
    if (output_open(output))
        return output;
    output_failed(path, errno, message);
    output_free(output);
    return NULL;
}

Output *output_begin(const char *path, Message *message)
{
    Target target;
    return find_target(path, &target, message) ? begin(path, &target, message) : NULL;
}

int output_file(const Output *output)
{
    return output->file;
}

/* Copies what was collected in memory to its device or pipe. */
static bool copy_through(const Output *output, Message *message)
{
    struct stat status;
    if (fstat(output->file, &status) != 0)
        return output_failed(output->path, errno, message);
    const size_t size = (size_t)status.st_size;
    void *bytes = size ? mmap(NULL, size, PROT_READ, MAP_SHARED, output->file, 0) : NULL;
    if (bytes == MAP_FAILED)
        return output_failed(output->path, errno, message);
    const bool done = write_through(output->path, &output->target, bytes, size, message);
    if (bytes)
        munmap(bytes, size);
    return done;
}

/* linkat cannot replace a file and rename needs a name, so the file is named first. */
static bool replace(Output *output, Message *message)
{
    if (!output->name && !output_name(output))
        return output_failed(output->path, errno, message);
    /* A file system that does not keep modes is no reason to fail. */
    if (output->target.replaces)
        (void)!fchmod(output->file, output->target.mode);
    const bool closed = close(output->file) == 0; /* may report a full disk */
    output->file = -1;
    if (!closed || rename(output->name->path, output->target.path) != 0) {
        const int error = errno;
        leave_the_end_to_others();
        return output_failed(output->path, error, message);
    }
    atomic_store(&output->name->state, NAME_FREE);
    output->name = NULL;
    return true;
}

bool output_commit(Output *output, Message *message)
{
    const bool done =
        output->target.through ? copy_through(output, message) : replace(output, message);
    output_free(output);
    return done;
}

void output_abort(Output *output)
{
    if (output)
        output_free(output);
}

bool output_write(const char *path, const void *bytes, size_t size, Message *message)
{
    if (strcmp(path, "-") == 0) {
        return output_append(STDOUT_FILENO, bytes, size) ||
               output_failed("standard output", errno, message);
    }
    Target target;
    if (!find_target(path, &target, message))
        return false;
    if (target.through)
        return write_through(path, &target, bytes, size, message);
    Output *output = begin(path, &target, message);
    if (!output)
        return false;
    if (output_append(output->file, bytes, size))
        return output_commit(output, message);
    output_failed(path, errno, message);
    output_abort(output);
    return false;
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
                           "picture%%03d.png, or a file that holds them all: .gif, .webp, .apng, "
                           ".mp4, .webm",
                           pattern);
    return true;
}

bool output_path(char path[PATH_MAX], const char *folder, const char *name, Message *message)
{
    if (snprintf(path, PATH_MAX, "%s/%s", folder, name) < PATH_MAX)
        return true;
    path[0] = '\0';
    return message_set(message, "%s: %s", folder, strerror(ENAMETOOLONG));
}

bool output_folder(const char *path, Message *message)
{
    struct stat status;
    if (strlen(path) > PATH_MAX - 128)
        return message_set(message, "%s: %s", path, strerror(ENAMETOOLONG));
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        return message_set(message, "%s: cannot create the folder: %s", path, strerror(errno));
    if (stat(path, &status) != 0 || !S_ISDIR(status.st_mode))
        return message_set(message, "%s: exists and is not a folder", path);
    return true;
}
