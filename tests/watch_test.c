/*
 * watch: whatever an editor, a version control system or a student does to a file or to what leads
 * to it is told, and nothing else; with inotify and without.
 *
 * Whatever a test does at once has happened before the watch looks, so that nothing depends on how
 * long it takes. A change that is not told makes a test wait for PATIENCE.
 */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "progress.h"
#include "testing.h"
#include "watch.h"

#include <dirent.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const double PATIENCE = 20; /* seconds */
/* Longer than the longest delay; and than a period of looking. */
static const double QUIET = 0.12, QUIET_WITHOUT = 0.25;

static bool without_inotify; /* in this group of tests */
static Watch *watch;
static Message message;

/* The next file cannot be opened while this holds. */
static void limit_files(struct rlimit *before)
{
    struct rlimit limit;
    const int lowest = open("/dev/null", O_RDONLY);
    assert_true(lowest >= 0);
    close(lowest);
    assert_int_equal(getrlimit(RLIMIT_NOFILE, before), 0);
    limit = *before;
    limit.rlim_cur = (rlim_t)lowest;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
}

static bool open_without_inotify(void)
{
    struct rlimit before;
    limit_files(&before);
    const bool opened = watch_open(&watch, &message);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
    return opened;
}

static int enter_folder(void **state)
{
    message = (Message){0};
    if (testing_enter_folder(state) != 0)
        return -1;
    return (without_inotify ? open_without_inotify() : watch_open(&watch, &message)) ? 0 : -1;
}

static int leave_folder(void **state)
{
    watch_close(watch);
    watch = NULL;
    return testing_leave_folder(state);
}

/* What is done to files. */

static void shell(const char *command)
{
    if (system(command) != 0)
        fail_msg("failed: %s", command);
}

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* What is told. */

static void quiet(const char *after)
{
    if (watch_wait(watch, without_inotify ? QUIET_WITHOUT : QUIET))
        fail_msg("told of a change for no reason: after %s", after);
}

static void heard(const char *what)
{
    if (!watch_wait(watch, PATIENCE))
        fail_msg("not told: %s", what);
}

/* Once, and then no more. */
static void told(const char *what)
{
    heard(what);
    quiet(what);
}

static void watch_paths(const char *const *paths, int count)
{
    assert_true(watch_set(watch, paths, count, &message));
    heard("the first time");
    if (without_inotify)
        assert_non_null(strstr(watch_polls(watch), "Too many open files"));
    else if (watch_polls(watch))
        fail_msg("inotify is not used: %s", watch_polls(watch));
    /* Dates are as fine as a tick of the kernel's clock, 10 ms at most: what follows is later. */
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
}

static void watch_one(const char *path)
{
    watch_paths(&path, 1);
}

/* Editors. */

static void every_way_of_saving_is_told_once(void **state)
{
    (void)state;
    static const char *const ways[][2] = {
        {"in place", "echo new > a.vert"},
        {"in place, the same length", "printf 'dlo\\n' > a.vert"},
        {"in two steps", ": > a.vert; echo new >> a.vert"},
        {"appended to", "echo more >> a.vert"},
        {"a new one renamed", "echo new > .a.vert.tmp; mv .a.vert.tmp a.vert"},
        {"moved from another folder", "echo new > sub/x; mv sub/x a.vert"},
        {"as vim does", "echo > 4913; rm 4913; mv a.vert a.vert~; echo new > a.vert; "
                        "chmod 600 a.vert; rm a.vert~"},
        {"with a copy for backup", "cp a.vert a.vert~; echo new > a.vert"},
        {"as emacs does", "ln -s user@host .#a.vert; mv a.vert a.vert~; echo new > a.vert; "
                          "rm .#a.vert"},
        {"removed and made", "rm a.vert; echo new > a.vert"},
        {"a hard link put in its place", "echo new > b; ln -f b a.vert; rm b"},
        {"the date alone", "touch -d yesterday a.vert"},
        {"the mode", "chmod 604 a.vert"},
        {"removed", "rm a.vert"},
        {"renamed", "mv a.vert b.vert"},
    };
    assert_int_equal(mkdir("sub", 0777), 0);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        put("a.vert", "old\n");
        watch_one("a.vert");
        shell(ways[i][1]);
        told(ways[i][0]);
        /* And again: what was replaced is still watched. */
        shell("echo again again > a.vert");
        heard(ways[i][0]);
    }
}

static void other_files_and_reading_are_no_change(void **state)
{
    (void)state;
    put("a.vert", "old");
    assert_int_equal(mkdir("sub", 0777), 0);
    static const char *const paths[] = {"a.vert", "sub/missing.vert"};
    watch_paths(paths, 2);
    shell("cat a.vert > b.vert; cp a.vert a.vert2; touch sub/other sub/missing; rm a.vert2; "
          "mkdir c; rm -r c; ls . sub > /dev/null");
    quiet("other files");
    shell("echo > sub/missing.vert");
    told("made");
}

static void a_file_that_was_missing_is_told_when_it_comes(void **state)
{
    (void)state;
    watch_one("a.vert");
    put("b.vert", "new");
    quiet("another file");
    put("a.vert", "new");
    told("made");
    shell("rm a.vert");
    told("removed");
    assert_int_equal(symlink("b.vert", "a.vert"), 0);
    told("a link to what is there");
    shell("rm a.vert; ln b.vert a.vert");
    told("a hard link");
}

/* What leads to a file. */

static void folders_that_come_one_by_one_are_followed(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof path, "%s/one/two/a.vert", testing_folder);
    for (int absolute = 0; absolute < 2; absolute++) {
        watch_one(absolute ? path : "one/two/a.vert");
        shell("mkdir one; mkdir one/two");
        /* Looking at the path alone does not tell of folders. */
        if (!without_inotify)
            told("folders");
        shell("echo > one/two/a.vert");
        told("a file in folders that were missing");
        shell("rm -r one");
        told("removed with its folders");
        shell("mkdir -p one/two; echo > one/two/a.vert");
        told("all at once");
        shell("rm -r one");
        told("removed again");
    }
}

static void a_folder_that_is_replaced_is_followed(void **state)
{
    (void)state;
    shell("mkdir -p one/two other/two; echo 1 > one/two/a.vert; echo 12 > other/two/a.vert");
    watch_one("one/two/a.vert");
    shell("mv one old; mv other one");
    told("another folder in its place");
    shell("echo x > old/two/a.vert");
    quiet("a change in the old folder");
    shell("echo 123 > one/two/a.vert");
    told("a change in the new one");
}

static void links_are_watched_where_they_are_and_where_they_lead(void **state)
{
    (void)state;
    shell("mkdir here there far; echo 1 > there/a.vert; echo 12 > far/a.vert; echo 1 > far/b");
    shell("mkdir beside; echo 1 > beside/a.vert");
    shell("ln -s ../there/a.vert here/a.vert; ln -s here door");
    watch_one("door/a.vert");
    shell("echo 123 > there/a.vert");
    told("what it leads to, in place");
    shell("echo 1234 > there/new; mv there/new there/a.vert");
    told("what it leads to, replaced");
    shell("ln -sfn ../far/a.vert here/a.vert");
    told("the link led elsewhere");
    shell("echo 5 > there/a.vert");
    quiet("where it led before");
    shell("echo 56 > far/a.vert");
    told("where it leads now");
    shell("ln -s beside new; mv -T new door");
    told("the link to the folder led elsewhere");
    shell("echo 567 > beside/a.vert");
    told("the file there");
    shell("rm beside/a.vert; ln -s ../far/b beside/a.vert; echo 78 > far/b");
    told("a link in the place of a file");
    shell("rm far/b");
    told("a link to nothing");
    shell("echo > far/b");
    told("and to something again");
}

static void an_absolute_link_is_followed(void **state)
{
    (void)state;
    char command[256];
    snprintf(command, sizeof command,
             "mkdir far; echo > far/a.vert; ln -s %s/far/a.vert a.vert; ln -s %s/./far//. door",
             testing_folder, testing_folder);
    shell(command);
    static const char *const paths[] = {"a.vert", "door/b.vert"};
    watch_paths(paths, 2);
    shell("echo x > far/a.vert");
    told("through a link");
    shell("echo x > far/b.vert");
    told("through a folder's link");
}

static void links_in_a_circle_and_endless_names_end(void **state)
{
    (void)state;
    static char endless[3 * 4096];
    memset(endless, 'a', sizeof endless - 1);
    memcpy(endless + 300, "/b", 2);
    shell("ln -s b a; ln -s a b; ln -s c/c c");
    const char *const paths[] = {"a", "c", "c/d", endless, "", "/", ".", "a.vert"};
    watch_paths(paths, 8);
    shell("echo > a.vert");
    told("a file beside a circle");
    shell("rm b; echo > b");
    told("the end of a circle");
}

/* The watch itself. */

static void paths_can_be_set_anew(void **state)
{
    (void)state;
    put("a.vert", "old");
    put("b.vert", "old");
    watch_one("a.vert");
    watch_one("b.vert");
    put("a.vert", "newer");
    quiet("what is watched no more");
    put("b.vert", "newer");
    told("what is watched now");
    watch_paths(NULL, 0);
    put("b.vert", "newest");
    quiet("nothing is watched");
}

/* What this process has open, and what inotify watches for it. */
static void count(int *files, int *watches)
{
    DIR *open_files = opendir("/proc/self/fdinfo");
    assert_non_null(open_files);
    *files = *watches = 0;
    for (struct dirent *entry; (entry = readdir(open_files));) {
        char path[512], line[512];
        snprintf(path, sizeof path, "/proc/self/fdinfo/%s", entry->d_name);
        FILE *info = fopen(path, "r");
        while (info && fgets(line, sizeof line, info))
            *watches += strncmp(line, "inotify ", 8) == 0;
        if (info)
            fclose(info);
        ++*files;
    }
    closedir(open_files);
}

static void nothing_piles_up(void **state)
{
    (void)state;
    int files[2], watches[2];
    shell("mkdir one two; echo 1 > one/a.vert; echo 2 > two/a.vert; ln -s one now");
    watch_one("now/a.vert");
    count(&files[0], &watches[0]);
    /* More than a process may have open by default, and than a user may have of inotify. */
    for (int i = 0; i < 1100; i++) {
        Watch *another;
        assert_true(watch_open(&another, &message));
        watch_close(another);
        assert_int_equal(unlink("now"), 0);
        assert_int_equal(symlink(i % 2 ? "one" : "two", "now"), 0);
        const char *path = "now/a.vert";
        assert_true(watch_set(watch, &path, 1, &message));
        watch_changed(watch);
    }
    watch_wait(watch, QUIET_WITHOUT);
    count(&files[1], &watches[1]);
    assert_int_equal(files[1], files[0]);
    assert_int_equal(watches[1], watches[0]);
    assert_true(without_inotify ? watches[0] == 0 : watches[0] > 1);
}

static void a_change_among_more_events_than_are_kept_is_told(void **state)
{
    (void)state;
    int most = 0;
    FILE *limit = fopen("/proc/sys/fs/inotify/max_queued_events", "r");
    if (!limit || fscanf(limit, "%d", &most) != 1 || most > 200000)
        most = 0;
    if (limit)
        fclose(limit);
    if (!most)
        skip();
    put("a.vert", "old");
    watch_one("a.vert");
    for (int i = 0; i < most / 2 + 10; i++) { /* made and closed: two events each, or more */
        char name[32];
        snprintf(name, sizeof name, "%d", i);
        const int file = open(name, O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
        assert_true(file >= 0);
        close(file);
        unlink(name);
    }
    put("a.vert", "newer");
    told("a change that there was no room for");
    put("a.vert", "the newest");
    told("the next");
}

/* Steps that go on and on are told in the midst, and after the last. */
static void a_file_that_is_written_all_the_time_is_told(void **state)
{
    (void)state;
    const double end = progress_now() + 1;
    int times = 0;
    put("a.vert", "old");
    watch_one("a.vert");
    while (progress_now() < end) {
        put("a.vert", "newer");
        times += watch_wait(watch, 0.001);
    }
    put("a.vert", "the newest");
    assert_true(watch_wait(watch, PATIENCE));
    assert_true(times >= 1);
}

static void a_wait_without_a_change_ends(void **state)
{
    (void)state;
    watch_one("a.vert");
    assert_false(watch_changed(watch));
    const double start = progress_now();
    struct timespec before, after;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    assert_false(watch_wait(watch, 0.5));
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    assert_true(progress_now() - start >= 0.5);
    const double spent =
        (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
    /* Half a second of spinning would be half a second: this waits. */
    assert_true(spent < 0.1);
}

static void closing_nothing_is_fine(void **state)
{
    (void)state;
    watch_close(NULL);
}

/* At once: nothing needs to be watched first. */
static void a_lack_of_instances_is_named(void **state)
{
    (void)state;
    assert_null(watch_polls(watch));
    watch_close(watch);
    assert_true(open_without_inotify());
    assert_string_equal(watch_polls(watch), "inotify: Too many open files");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, enter_folder, leave_folder)

#define BOTH                                                                                       \
    TEST(every_way_of_saving_is_told_once), TEST(other_files_and_reading_are_no_change),           \
        TEST(a_file_that_was_missing_is_told_when_it_comes),                                       \
        TEST(folders_that_come_one_by_one_are_followed),                                           \
        TEST(a_folder_that_is_replaced_is_followed),                                               \
        TEST(links_are_watched_where_they_are_and_where_they_lead),                                \
        TEST(an_absolute_link_is_followed), TEST(links_in_a_circle_and_endless_names_end),         \
        TEST(paths_can_be_set_anew), TEST(nothing_piles_up),                                       \
        TEST(a_file_that_is_written_all_the_time_is_told), TEST(a_wait_without_a_change_ends)

int main(void)
{
    const struct CMUnitTest with[] = {
        BOTH,
        TEST(a_change_among_more_events_than_are_kept_is_told),
        TEST(a_lack_of_instances_is_named),
        TEST(closing_nothing_is_fine),
    };
    const struct CMUnitTest without[] = {BOTH};
    int failed = cmocka_run_group_tests_name("with inotify", with, NULL, NULL);
    without_inotify = true;
    failed += cmocka_run_group_tests_name("without", without, NULL, NULL);
    return failed;
}
