#include "base/cache.h"

#include "base/output.h"
#include "base/paths.h"
#include "base/version.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* The finalizer of MurmurHash3 (Appleby, 2011). */
static uint64_t mixed(uint64_t z)
{
    z = (z ^ (z >> 33)) * 0xFF51AFD7ED558CCDu;
    z = (z ^ (z >> 33)) * 0xC4CEB9FE1A85EC53u;
    return z ^ (z >> 33);
}

void cache_key_add(CacheKey *key, const void *bytes, size_t size)
{
    uint64_t a = key->bits[0] + size, b = key->bits[1] ^ (size * 0x9E3779B97F4A7C15u);
    for (size_t at = 0; at < size; at += sizeof(uint64_t)) {
        uint64_t word = 0;
        const size_t rest = size - at;
        memcpy(&word, (const char *)bytes + at, rest < sizeof word ? rest : sizeof word);
        a = mixed(a ^ word) + 0x9E3779B97F4A7C15u;
        b = (b ^ mixed(word + 0xD1B54A32D192ED03u)) * 0x2545F4914F6CDD1Du;
        b ^= b >> 29;
    }
    key->bits[0] = mixed(a);
    key->bits[1] = mixed(b);
}

static bool add_file(CacheKey *key, const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode))
        return false;
    cache_key_add(key, &status.st_mtim, sizeof status.st_mtim);
    cache_key_add(key, &status.st_size, sizeof status.st_size);
    return true;
}

void cache_key_add_program(CacheKey *key)
{
    char path[PATH_MAX];
    cache_key_add(key, VERSION, sizeof VERSION);
    if (paths_program(path, NULL))
        add_file(key, path);
}

bool cache_key_add_tool(CacheKey *key, const char *name)
{
    const char *folder = getenv("PATH");
    for (size_t length; folder && folder[0]; folder += length + (folder[length] == ':')) {
        char path[PATH_MAX];
        length = strcspn(folder, ":");
        if (length &&
            snprintf(path, sizeof path, "%.*s/%s", (int)length, folder, name) < PATH_MAX &&
            access(path, X_OK) == 0 && add_file(key, path))
            return true;
    }
    return false;
}

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
    return !create || output_folder(folder, NULL);
}

void cache_prepare_driver(void)
{
    char folder[PATH_MAX];
    struct stat status;
    const char *cache = getenv("XDG_CACHE_HOME");
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
}

static bool find_path(const char *kind, const CacheKey *key, bool create, char path[PATH_MAX])
{
    if (!find_folder(path, create))
        return false;
    sprintf(path + strlen(path), "/%.32s-%016llx%016llx", kind, (unsigned long long)key->bits[0],
            (unsigned long long)key->bits[1]);
    return true;
}

void *cache_read(const char *kind, const CacheKey *key, size_t *size)
{
    char path[PATH_MAX];
    struct stat status;
    const int file = find_path(kind, key, false, path)
                         ? open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW)
                         : -1;
    char *bytes = NULL;
    if (file >= 0 && fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_size <= CACHE_MAX && (bytes = malloc((size_t)status.st_size + 1)) != NULL) {
        size_t have = 0;
        ssize_t more = 1;
        *size = (size_t)status.st_size;
        while (have < *size && (more = read(file, bytes + have, *size - have)) > 0)
            have += (size_t)more;
        if (have < *size) {
            free(bytes);
            bytes = NULL;
        }
        futimens(file, NULL); /* used now */
    }
    if (file >= 0)
        close(file);
    return bytes;
}

/* Removes the least recently used files until `size` bytes more fit. */
static void make_room(const char *folder, size_t size)
{
    for (;;) {
        DIR *all = opendir(folder);
        char oldest[NAME_MAX + 1] = "";
        struct timespec time = {0, 0};
        size_t sum = size;
        if (!all)
            return;
        for (const struct dirent *entry; (entry = readdir(all)) != NULL;) {
            struct stat status;
            if (fstatat(dirfd(all), entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0 ||
                !S_ISREG(status.st_mode) || status.st_size == 0)
                continue;
            sum += (size_t)status.st_size;
            if (!oldest[0] || status.st_mtim.tv_sec < time.tv_sec ||
                (status.st_mtim.tv_sec == time.tv_sec && status.st_mtim.tv_nsec < time.tv_nsec)) {
                snprintf(oldest, sizeof oldest, "%s", entry->d_name);
                time = status.st_mtim;
            }
        }
        const bool done = sum <= CACHE_MAX || !oldest[0] || unlinkat(dirfd(all), oldest, 0) != 0;
        closedir(all);
        if (done)
            return;
    }
}

void cache_write(const char *kind, const CacheKey *key, const void *bytes, size_t size)
{
    char path[PATH_MAX], folder[PATH_MAX], lock[PATH_MAX];
    if (size > CACHE_MAX || size == 0 || !find_path(kind, key, true, path) ||
        !find_folder(folder, false))
        return;
    strcat(strcpy(lock, folder), "/lock");
    const int turn = open(lock, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (turn < 0)
        return;
    /* Not waited for: the other process may be stopped. */
    if (flock(turn, LOCK_EX | LOCK_NB) == 0) {
        make_room(folder, size);
        output_write(path, bytes, size, NULL);
    }
    close(turn);
}
