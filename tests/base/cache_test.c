/*
 * The cache: what is written is read, damage and want of a folder are misses, the least recently
 * used goes, and processes that write at once leave whole files.
 */
#include "base/cache.h"
#include "support/testing.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static CacheKey key_of(const char *text)
{
    CacheKey key = {{0, 0}};
    cache_key_add(&key, text, strlen(text));
    return key;
}

/* Whether `text` is kept under a key of the same name. */
static bool has(const char *name, const char *text)
{
    size_t size = 0;
    const CacheKey key = key_of(name);
    char *bytes = cache_read("test", &key, &size);
    const bool found = bytes && size == strlen(text) && memcmp(bytes, text, size) == 0;
    free(bytes);
    return found;
}

static void put(const char *name, const char *text)
{
    const CacheKey key = key_of(name);
    cache_write("test", &key, text, strlen(text));
}

TEST_WITH(0, what_is_kept_is_found, testing_enter_cache, testing_leave_cache)
{
    assert_false(has("a", "one"));
    put("a", "one");
    put("b", "two");
    assert_true(has("a", "one") && has("b", "two"));
    put("a", "three");
    assert_true(has("a", "three") && has("b", "two"));
}

TEST_WITH(0, keys_differ_by_bytes_lengths_and_order, testing_enter_cache, testing_leave_cache)
{
    static const char bytes[40] = {0};
    CacheKey keys[42] = {{{0, 0}}};
    for (size_t i = 0; i <= 40; i++)
        cache_key_add(&keys[i], bytes, i);
    cache_key_add(&keys[41], bytes, 20);
    cache_key_add(&keys[41], bytes, 20); /* not the same as 40 at once */
    for (int i = 0; i < 42; i++)
        for (int k = 0; k < i; k++)
            assert_memory_not_equal(&keys[i], &keys[k], sizeof keys[i]);
}

TEST_WITH(0, without_a_folder_nothing_is_kept, testing_enter_cache, testing_leave_cache)
{
    const char *path = formatted("%s/file", testing_folder);
    close(open(path, O_CREAT | O_WRONLY, 0600));
    const char *const folders[] = {path, "relative", "/dev/null", "/nonexistent/folder"};
    unsetenv("HOME");
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        setenv("XDG_CACHE_HOME", folders[i], 1);
        put("a", "one");
        assert_false(has("a", "one"));
    }
}

/* What may have happened to a file of the cache. */
static void shorten(const char *path)
{
    assert_int_equal(truncate(path, 20), 0);
}

static void empty(const char *path)
{
    assert_int_equal(truncate(path, 0), 0);
}

static void lengthen(const char *path)
{
    assert_int_equal(truncate(path, 100), 0);
}

static void flip(const char *path, off_t at)
{
    char byte;
    const int file = open(path, O_RDWR);
    assert_true(pread(file, &byte, 1, at) == 1);
    byte ^= 1;
    assert_true(pwrite(file, &byte, 1, at) == 1);
    close(file);
}

static void change_key(const char *path)
{
    flip(path, 0);
}

static void change_hash(const char *path)
{
    flip(path, 31);
}

static void change_bytes(const char *path)
{
    flip(path, 33);
}

static void link_elsewhere(const char *path)
{
    assert_int_equal(rename(path, "elsewhere"), 0);
    assert_int_equal(symlink("../elsewhere", path), 0);
}

static void become_pipe(const char *path)
{
    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
}

static void become_folder(const char *path)
{
    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkdir(path, 0700), 0);
}

static void change_owner(const char *path)
{
    assert_int_equal(chown(path, 65534, 65534), 0);
}

static void open_folder_to_others(const char *path)
{
    (void)path;
    assert_int_equal(chmod("lighting", 0777), 0);
}

TEST_WITH(0, what_is_not_as_it_was_written_is_a_miss, testing_enter_cache, testing_leave_cache)
{
    static const struct {
        void (*spoil)(const char *path);
        bool as_root, for_good;
    } cases[] = {
        {shorten, false, false},        {empty, false, false},
        {lengthen, false, false},       {change_key, false, false},
        {change_hash, false, false},    {change_bytes, false, false},
        {link_elsewhere, false, false}, {become_pipe, false, false},
        {change_owner, true, false},    {open_folder_to_others, false, false},
        {become_folder, false, true},
    };
    const CacheKey key = key_of("a");
    char path[80];
    struct stat status;
    snprintf(path, sizeof path, "lighting/test-%016llx%016llx", (unsigned long long)key.bits[0],
             (unsigned long long)key.bits[1]);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (cases[i].as_root && geteuid() != 0)
            continue;
        put("a", "one");
        put("b", "two");
        assert_true(has("a", "one"));
        cases[i].spoil(path);
        assert_false(has("a", "one"));
        put("a", "one"); /* writes it anew */
        assert_int_equal(has("a", "one"), !cases[i].for_good);
        assert_int_equal(stat("lighting", &status), 0);
        assert_int_equal(status.st_mode & 0777, 0700);
        /* Others could have written all files of an open folder. */
        assert_int_equal(has("b", "two"), cases[i].spoil != open_folder_to_others);
    }
}

TEST_WITH(0, anothers_folder_is_not_used, testing_enter_cache, testing_leave_cache)
{
    if (geteuid() != 0)
        return;
    put("a", "one");
    assert_int_equal(chown("lighting", 65534, 65534), 0);
    assert_false(has("a", "one"));
    put("b", "two");
    assert_int_equal(testing_entries("lighting"), 2); /* the first, and the lock */
}

TEST_WITH(0, the_least_recently_used_goes, testing_enter_cache, testing_leave_cache)
{
    enum { SIZE = 30000000 };
    char *large = calloc(1, SIZE);
    size_t size;
    assert_non_null(large);
    for (int i = 0; i < 5; i++) {
        const char name[] = {(char)('a' + i), '\0'};
        const CacheKey key = key_of(name), first = key_of("a");
        cache_write("test", &key, large, SIZE);
        free(cache_read("test", &first, &size));          /* used again and again */
        nanosleep(&(struct timespec){0, 20000000}, NULL); /* times of files are that coarse */
    }
    for (int i = 0; i < 5; i++) {
        const char name[] = {(char)('a' + i), '\0'};
        const CacheKey key = key_of(name);
        void *bytes = cache_read("test", &key, &size);
        /* Three fit: the first, and the last two. */
        assert_int_equal(bytes != NULL, i == 0 || i >= 3);
        free(bytes);
    }
    free(large);
}

TEST_WITH(0, processes_that_write_at_once_leave_whole_files, testing_enter_cache,
          testing_leave_cache)
{
    enum { PROCESSES = 4, ROUNDS = 50, SIZE = 100000 };
    const CacheKey key = key_of("a");
    pid_t all[PROCESSES];
    for (int i = 0; i < PROCESSES; i++) {
        all[i] = fork();
        if (all[i] == 0) {
            char *bytes = malloc(SIZE);
            memset(bytes, 'a' + i, SIZE);
            for (int round = 0; round < ROUNDS; round++) {
                size_t size = SIZE;
                cache_write("test", &key, bytes, SIZE);
                char *read = cache_read("test", &key, &size);
                for (size_t k = 0; read && k < size; k++)
                    if (read[k] != read[0] || size != SIZE)
                        _exit(1);
                free(read);
            }
            _exit(0);
        }
    }
    for (int i = 0; i < PROCESSES; i++) {
        int status;
        assert_int_equal(waitpid(all[i], &status, 0), all[i]);
        assert_int_equal(status, 0);
    }
}

TEST_MAIN("cache", NULL, NULL)
