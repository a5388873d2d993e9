/*
 * A file's name is the hash of all that its bytes depend on, so nothing is ever out of date: what
 * changes gets another name, and the old file is removed when room is needed. A file begins with a
 * seal, its key and a hash of its bytes, which finds damage. The folder must be the user's and
 * closed to writing by others; openat and fstat on open files leave no moment between a check and
 * its use.
 */
#include "base/cache.h"

#include "base/input.h"
#include "base/memory.h"
#include "base/output.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <pwd.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* False where neither is known, or too long. */
static bool find_folder(char folder[PATH_MAX], bool create)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length;
    if (cache && cache[0] == '/')
        length = snprintf(folder, PATH_MAX, "%s", cache);
    else if (home && home[0] == '/')
        length = snprintf(folder, PATH_MAX, "%s/.cache", home);
    else
        return false;
    if (length > PATH_MAX - 128 || (create && !output_folder(folder, NULL)))
        return false;
    strcat(folder, "/lighting");
    return !create || mkdir(folder, 0700) == 0 || errno == EEXIST;
}

static const char LOCK[] = "lock";

/* The next file of a folder but the lock, and its status; NULL: there is no more. */
static const char *next_file(DIR *folder, struct stat *status)
{
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        if (strcmp(entry->d_name, LOCK) != 0 &&
            fstatat(dirfd(folder), entry->d_name, status, AT_SYMLINK_NOFOLLOW) == 0 &&
            S_ISREG(status->st_mode))
            return entry->d_name;
    return NULL;
}

/* The folder, open, if it is the user's own and no one else could write to it. To write, it is
 * created, or closed to others and emptied: whatever they left there is not trusted. */
static DIR *open_folder(char folder[PATH_MAX], bool write)
{
    struct stat status;
    DIR *all = find_folder(folder, write) ? opendir(folder) : NULL;
    if (!all)
        return NULL;
    bool own = fstat(dirfd(all), &status) == 0 && status.st_uid == geteuid();
    const bool shared = (status.st_mode & (S_IWGRP | S_IWOTH)) != 0;
    if (own && shared && write && (own = fchmod(dirfd(all), 0700) == 0)) {
        for (const char *name; (name = next_file(all, &status)) != NULL;)
            unlinkat(dirfd(all), name, 0);
        rewinddir(all);
    }
    if (own && (write || !shared))
        return all;
    closedir(all);
    return NULL;
}

/* To open a pipe waits for its other end: it is opened as both and removed. */
static void remove_pipes(int at, const char *path, int depth)
{
    const int file = openat(at, path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *folder = file < 0 ? NULL : fdopendir(file);
    if (!folder)
        return;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (depth && entry->d_type == DT_DIR && entry->d_name[0] != '.')
            remove_pipes(file, entry->d_name, depth - 1);
        if (entry->d_type != DT_FIFO)
            continue;
        const int both = openat(file, entry->d_name, O_RDWR | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
        unlinkat(file, entry->d_name, 0);
        if (both >= 0)
            close(both);
    }
    closedir(folder);
}

/* Mesa and fontconfig would wait for ever for a pipe in their folders. To look for one costs time,
 * so that is done once, for a program that runs longer than most. */
static void *remove_pipes_later(void *cache)
{
    enum { SECONDS = 3 };
    sleep(SECONDS);
    const int at = open(cache, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    free(cache);
    if (at < 0)
        return NULL;
    remove_pipes(at, "mesa_shader_cache", 1);
    remove_pipes(at, "mesa_shader_cache_db", 1);
    remove_pipes(at, "fontconfig", 0);
    close(at);
    return NULL;
}

static void guard_against_pipes(const char *cache)
{
    static atomic_flag guarded = ATOMIC_FLAG_INIT;
    sigset_t all, old;
    pthread_t thread;
    char *path = atomic_flag_test_and_set(&guarded) ? NULL : strdup(cache);
    if (!path)
        return;
    sigfillset(&all); /* signals are for the main thread */
    pthread_sigmask(SIG_SETMASK, &all, &old);
    if (pthread_create(&thread, NULL, remove_pipes_later, path) == 0)
        pthread_detach(thread);
    else
        free(path);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
}

void cache_prepare_driver(void)
{
    char folder[PATH_MAX];
    struct stat status;
    const char *own = getenv("MESA_SHADER_CACHE_DIR"),
               *cache = own ? own : getenv("XDG_CACHE_HOME");
    const struct passwd *user = cache ? NULL : getpwuid(getuid()); /* Mesa does not read HOME */
    snprintf(folder, sizeof folder, "%s%s",
             cache  ? cache
             : user ? user->pw_dir
                    : "",
             cache ? "" : "/.cache");
    const bool there = (mkdir(folder, 0700) == 0 || errno == EEXIST) &&
                       stat(folder, &status) == 0 && S_ISDIR(status.st_mode);
    if (!there || access(folder, W_OK | X_OK) != 0)
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
    if (there)
        guard_against_pipes(folder);
}

/* What a file begins with: its key, and a hash of all bytes after this. Damage, and a file that was
 * renamed, are a miss. */
typedef struct Seal {
    CacheKey key, hash;
} Seal;

static Seal seal_of(const CacheKey *key, const void *bytes, size_t size)
{
    Seal seal = {.key = *key};
    cache_key_add(&seal.hash, bytes, size);
    return seal;
}

enum { NAME_SIZE = 80 };

static void name_of(const char *kind, const CacheKey *key, char name[NAME_SIZE])
{
    snprintf(name, NAME_SIZE, "%.32s-%016llx%016llx", kind, (unsigned long long)key->bits[0],
             (unsigned long long)key->bits[1]);
}

/* Of an open file; NULL: it is not a file of the cache, or damaged. */
static void *read_sealed(int file, const CacheKey *key, size_t *size)
{
    struct stat status;
    Seal seal;
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_uid != geteuid() ||
        status.st_size > CACHE_MAX || input_bytes(file, &seal, sizeof seal) != sizeof seal)
        return NULL;
    *size = (size_t)status.st_size - sizeof seal;
    void *bytes = malloc(*size + 1);
    if (bytes && input_bytes(file, bytes, *size) == (ssize_t)*size) {
        const Seal right = seal_of(key, bytes, *size);
        if (memcmp(&seal, &right, sizeof seal) == 0)
            return bytes;
    }
    free(bytes);
    return NULL;
}

void *cache_read(const char *kind, const CacheKey *key, size_t *size)
{
    char folder[PATH_MAX], name[NAME_SIZE];
    DIR *all = open_folder(folder, false);
    if (!all)
        return NULL;
    name_of(kind, key, name);
    /* Neither a link is followed, nor the writer of a pipe waited for. */
    const int file = openat(dirfd(all), name, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    void *bytes = file >= 0 ? read_sealed(file, key, size) : NULL;
    if (bytes)
        futimens(file, NULL); /* used now */
    if (file >= 0)
        close(file);
    closedir(all);
    return bytes;
}

typedef struct Entry {
    char *name;
    size_t size;
    struct timespec used;
} Entry;

static int compare_uses(const void *first, const void *second)
{
    const struct timespec a = ((const Entry *)first)->used, b = ((const Entry *)second)->used;
    return a.tv_sec != b.tv_sec ? (a.tv_sec > b.tv_sec) - (a.tv_sec < b.tv_sec)
                                : (a.tv_nsec > b.tv_nsec) - (a.tv_nsec < b.tv_nsec);
}

/* Removes the least recently used files until at most `max` bytes are left, and returns how many
 * are. */
static uint64_t make_room(DIR *all, uint64_t max)
{
    Entry *entries = NULL;
    struct stat status;
    size_t count = 0;
    uint64_t sum = 0;
    for (const char *name; (name = next_file(all, &status)) != NULL; count++) {
        if ((count & (count - 1)) == 0)
            entries = memory_grow(entries, 2 * count + 1, sizeof *entries);
        entries[count] = (Entry){memory_text(name), (size_t)status.st_size, status.st_mtim};
        sum += entries[count].size;
    }
    if (count)
        qsort(entries, count, sizeof *entries, compare_uses);
    for (size_t i = 0; i < count; i++) {
        if (sum > max && unlinkat(dirfd(all), entries[i].name, 0) == 0)
            sum -= entries[i].size;
        free(entries[i].name);
    }
    free(entries);
    return sum;
}

/* The lock holds the sum of all files, or more: only where that reaches the bound they are counted
 * again. */
static bool reserve(int lock, DIR *all, uint64_t size)
{
    uint64_t sum = 0;
    if (pread(lock, &sum, sizeof sum, 0) != sizeof sum || sum > CACHE_MAX - size)
        sum = make_room(all, CACHE_MAX - size);
    sum += size;
    return pwrite(lock, &sum, sizeof sum, 0) == sizeof sum;
}

/* By rename; what is no file of the user's goes first, because it would be written through. */
static void replace(DIR *all, const char *path, const Seal *seal, const void *bytes, size_t size)
{
    struct stat status;
    const char *name = strrchr(path, '/') + 1;
    if (fstatat(dirfd(all), name, &status, AT_SYMLINK_NOFOLLOW) == 0 &&
        (!S_ISREG(status.st_mode) || status.st_uid != geteuid()))
        unlinkat(dirfd(all), name, 0);
    Output *output = output_begin(path, NULL);
    if (output && output_append(output_file(output), seal, sizeof *seal) &&
        output_append(output_file(output), bytes, size))
        output_commit(output, NULL);
    else
        output_abort(output);
}

void cache_write(const char *kind, const CacheKey *key, const void *bytes, size_t size)
{
    char folder[PATH_MAX], name[NAME_SIZE], path[PATH_MAX + NAME_SIZE];
    const Seal seal = seal_of(key, bytes, size);
    const bool fits = size > 0 && size <= CACHE_MAX - sizeof seal;
    DIR *all = fits ? open_folder(folder, true) : NULL;
    if (!all)
        return;
    name_of(kind, key, name);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    const int lock = openat(dirfd(all), LOCK, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    /* Not waited for: the other process may be stopped. */
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0 && reserve(lock, all, sizeof seal + size))
        replace(all, path, &seal, bytes, size);
    if (lock >= 0)
        close(lock);
    closedir(all);
}
