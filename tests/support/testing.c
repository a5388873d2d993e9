#include "support/testing.h"

#include "base/paths.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <sys/wait.h>
#include <unistd.h>

char testing_folder[] = "/tmp/lighting_test-XXXXXX";

static struct {
    struct CMUnitTest tests[128];
    size_t count;
} lists[2];

void testing_add(int list, struct CMUnitTest test)
{
    assert_true(lists[list].count < sizeof lists[list].tests / sizeof lists[list].tests[0]);
    lists[list].tests[lists[list].count++] = test;
}

int testing_run(int list, const char *name, CMFixtureFunction setup, CMFixtureFunction teardown)
{
    return _cmocka_run_group_tests(name, lists[list].tests, lists[list].count, setup, teardown);
}

int testing_step(int step)
{
    const char *everything = getenv("LIGHTING_TEST_LONG");
    const int every = everything ? atoi(everything) : 0;
    if (every > 0)
        return every < 2 * step ? every : 2 * step;
    return 4 * step;
}

int testing_part(int count, int step)
{
    const int part = count / testing_step(step);
    return part > 0 ? part : 1;
}

static struct {
    int number, count;
} part = {0, 1};

bool testing_mine(int number)
{
    return number % part.count == part.number;
}

int testing_in_parts(int (*body)(void))
{
    int worst = 0, status;
    fflush(NULL);
    part.count = testing_step(2) == 1 ? (int)sysconf(_SC_NPROCESSORS_ONLN) : 1;
    for (int number = 1; number < part.count; number++) {
        const pid_t child = fork();
        part.number = child == 0 ? number : 0;
        if (child == 0)
            return body();
        if (child < 0)
            worst = 1;
    }
    const int own = body();
    pid_t ended;
    while ((ended = wait(&status)) > 0 || (ended < 0 && errno == EINTR))
        if (ended > 0 && (!WIFEXITED(status) || WEXITSTATUS(status) != 0))
            worst = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    return own ? own : worst;
}

unsigned long long testing_seed(unsigned long long usual)
{
    const char *text = getenv("LIGHTING_TEST_SEED");
    const unsigned long long seed = text && *text ? strtoull(text, NULL, 0) : usual;
    printf("LIGHTING_TEST_SEED=%llu\n", seed);
    return seed;
}

void testing_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%.17g instead of %.17g", value, expected);
}

const char *formatted(const char *format, ...)
{
    static char texts[16][8192];
    static size_t last;
    char *text = texts[++last % 16];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof texts[0], format, arguments);
    va_end(arguments);
    assert_in_range(length, 0, sizeof texts[0] - 1);
    return text;
}

Message testing_failure;

void require(bool done, const Message *message)
{
    const Message said = *message;
    testing_failure = (Message){0};
    if (!done)
        fail_msg("%s", said.text);
}

int testing_enter_folder(void **state)
{
    (void)state;
    memcpy(testing_folder + sizeof testing_folder - 7, "XXXXXX", 6);
    return mkdtemp(testing_folder) && chdir(testing_folder) == 0 ? 0 : -1;
}

int testing_leave_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", testing_folder);
    return chdir("/") == 0 ? system(command) : -1;
}

int testing_enter_cache(void **state)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s%s",
             cache  ? cache
             : home ? home
                    : "",
             cache ? "" : "/.cache");
    if (cache || home)
        setenv("MESA_SHADER_CACHE_DIR", folder, 0);
    return testing_enter_folder(state) || setenv("XDG_CACHE_HOME", testing_folder, 1);
}

int testing_leave_cache(void **state)
{
    unsetenv("XDG_CACHE_HOME");
    return testing_leave_folder(state);
}

int testing_leave_empty_folder(void **state)
{
    (void)state;
    return chdir("/") == 0 ? rmdir(testing_folder) : -1;
}

void testing_write(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void testing_put(const char *path, const char *text)
{
    testing_write(path, text, strlen(text));
}

char *testing_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("%s is missing", path);
    char *bytes = calloc(1, 1 << 22);
    assert_non_null(bytes);
    *size = fread(bytes, 1, (1 << 22) - 1, file);
    fclose(file);
    return bytes;
}

const char *testing_source(const char *path)
{
    static char found[PATH_MAX];
    assert_true(paths_data(PATHS_SOURCE, path, "", found));
    return found;
}

void testing_shell(const char *command)
{
    if (system(command) != 0)
        fail_msg("failed: %s", command);
}

int testing_in_child(int (*body)(void))
{
    int status = 0;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(body());
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

bool testing_drop_root(void)
{
    return geteuid() != 0 || setresuid(65534, 65534, 65534) == 0;
}

void testing_seed48(unsigned short seed[3])
{
    const unsigned long long number = testing_seed(20240229);
    seed[0] = 0x330e;
    seed[1] = (unsigned short)number;
    seed[2] = (unsigned short)(number >> 16);
}

int testing_entries(const char *folder)
{
    int count = -2; /* . and .. */
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    while (readdir(listing))
        count++;
    closedir(listing);
    return count;
}

int testing_open_files(void)
{
    return testing_entries("/proc/self/fd");
}

long testing_resident_kib(void)
{
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%*d %ld", &pages), 1);
    fclose(file);
    return pages * (sysconf(_SC_PAGESIZE) / 1024);
}
