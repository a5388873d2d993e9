/*
 * watch: every way to save, replace or redirect a file is reported, and other files are not.
 *
 * The steps of a save run to their end before the watch looks, so that no test depends on speed. A
 * missing report costs PATIENCE.
 */
#include "base/clock.h"
#include "base/watch.h"
#include "support/testing.h"

#include <sys/stat.h>
#include <unistd.h>

static const double PATIENCE = 300; /* seconds */
/* Seconds. The second is longer than a look and the longest delay after it. */
static const double QUIET = 0.04, QUIET_MAX = 0.09;

static Watch *watch;

static int enter_folder(void **state)
{
    watch = watch_open();
    return testing_enter_folder(state);
}

static int leave_folder(void **state)
{
    watch_close(watch);
    watch = NULL;
    return testing_leave_folder(state);
}

#define WATCH_TEST(name) TEST_WITH(0, name, enter_folder, leave_folder)

static void quiet(const char *after)
{
    if (watch_wait(watch, QUIET))
        fail_msg("reported without a change: after %s", after);
}

static void reported(const char *what)
{
    if (!watch_wait(watch, PATIENCE))
        fail_msg("not reported: %s", what);
}

static void reported_once(const char *what)
{
    reported(what);
    quiet(what);
}

static void watch_paths(const char *const *paths, int count)
{
    watch_set(watch, paths, count);
    reported("the first time");
}

static void watch_one(const char *path)
{
    watch_paths(&path, 1);
}

/* Each in a folder of its own, and all at once, because the waits would add up. */
WATCH_TEST(every_way_of_saving_is_reported_once)
{
    static const char *const ways[][2] = {
        {"in place", "echo new > a.vert"},
        {"in place, the same length", "printf 'dlo\\n' > a.vert"},
        {"in two steps", ": > a.vert; echo new >> a.vert"},
        {"appended to", "echo more >> a.vert"},
        {"a new one renamed", "echo new > .a.vert.tmp; mv .a.vert.tmp a.vert"},
        {"a new one with the old date", "cp -p a.vert b; echo new > b; touch -r a.vert b; "
                                        "mv b a.vert"},
        {"another size with the old date", "cp -p a.vert b; echo longer > a.vert; "
                                           "touch -r b a.vert"},
        {"moved from another folder", "mkdir sub; echo new > sub/x; mv sub/x a.vert"},
        {"as vim does", "echo > 4913; rm 4913; mv a.vert a.vert~; echo new > a.vert; "
                        "chmod 600 a.vert; rm a.vert~"},
        {"with a copy for backup", "cp a.vert a.vert~; echo new > a.vert"},
        {"as emacs does", "ln -s user@host .#a.vert; mv a.vert a.vert~; echo new > a.vert; "
                          "rm .#a.vert"},
        {"removed and made", "rm a.vert; echo new > a.vert"},
        {"a hard link put in its place", "echo new > b; ln -f b a.vert; rm b"},
        {"the date alone", "touch -d yesterday a.vert"},
        {"the mode", "chmod 604 a.vert"},
        {"emptied", ": > a.vert"},
        {"removed", "rm a.vert"},
        {"renamed", "mv a.vert b.vert"},
    };
    enum { COUNT = sizeof ways / sizeof ways[0] };
    Watch *watches[COUNT];
    char path[32];
    for (int i = 0; i < COUNT; i++) {
        snprintf(path, sizeof path, "%d", i);
        assert_int_equal(mkdir(path, 0777), 0);
        snprintf(path, sizeof path, "%d/a.vert", i);
        testing_put(path, "old\n");
        watches[i] = watch_open();
        watch_set(watches[i], &(const char *){path}, 1);
        assert_true(watch_wait(watches[i], PATIENCE));
    }
    for (int i = 0; i < COUNT; i++)
        testing_shell(formatted("cd %d; %s", i, ways[i][1]));
    for (int i = 0; i < COUNT; i++)
        if (!watch_wait(watches[i], PATIENCE))
            fail_msg("not reported: %s", ways[i][0]);
    for (double end = clock_now() + QUIET_MAX; clock_now() < end;)
        for (int i = 0; i < COUNT; i++)
            if (watch_wait(watches[i], 0.001))
                fail_msg("reported twice: %s", ways[i][0]);
    /* The file that replaced the first is watched as well. */
    testing_shell("for i in */; do echo again again > $i/a.vert; done");
    for (int i = 0; i < COUNT; i++) {
        if (!watch_wait(watches[i], PATIENCE))
            fail_msg("not reported again: %s", ways[i][0]);
        watch_close(watches[i]);
    }
}

/* Timestamps advance by ticks of up to 10 ms; a report must not come before the tick has ended. */
WATCH_TEST(a_write_right_after_a_report_is_reported)
{
    testing_put("a.vert", "0");
    watch_one("a.vert");
    for (int i = 0; i < 15; i++) {
        testing_put("a.vert", i % 2 ? "0" : "1");
        reported("the same length");
    }
}

WATCH_TEST(other_files_and_reading_are_not_reported)
{
    testing_put("a.vert", "old");
    assert_int_equal(mkdir("sub", 0777), 0);
    static const char *const paths[] = {"a.vert", "sub/missing.vert"};
    watch_paths(paths, 2);
    testing_shell(
        "cat a.vert > b.vert; cp a.vert a.vert2; touch sub/other sub/missing; rm a.vert2; "
        "mkdir c; rm -r c; ls . sub > /dev/null");
    quiet("other files");
    testing_shell("echo > sub/missing.vert");
    reported_once("made");
}

WATCH_TEST(a_missing_file_is_reported_when_it_is_made)
{
    watch_one("a.vert");
    testing_put("b.vert", "new");
    quiet("another file");
    testing_put("a.vert", "new");
    reported_once("made");
    testing_shell("rm a.vert");
    reported_once("removed");
    assert_int_equal(symlink("b.vert", "a.vert"), 0);
    reported_once("a link to what is there");
    testing_shell("rm a.vert; ln b.vert a.vert; echo x > b.vert");
    reported_once("a hard link");
}

WATCH_TEST(folders_made_one_by_one_are_followed)
{
    const char *path = formatted("%s/one/two/a.vert", testing_folder);
    for (int absolute = 0; absolute < 2; absolute++) {
        watch_one(absolute ? path : "one/two/a.vert");
        testing_shell("mkdir one; mkdir one/two");
        quiet("folders");
        testing_shell("echo > one/two/a.vert");
        reported_once("a file in folders that were missing");
        testing_shell("rm -r one");
        reported_once("removed with its folders");
        testing_shell("mkdir -p one/two; echo > one/two/a.vert");
        reported_once("all at once");
        testing_shell("rm -r one");
        reported_once("removed again");
    }
}

WATCH_TEST(a_replaced_folder_is_followed)
{
    testing_shell(
        "mkdir -p one/two other/two; echo 1 > one/two/a.vert; echo 12 > other/two/a.vert");
    watch_one("one/two/a.vert");
    testing_shell("mv one old; mv other one");
    reported_once("another folder in its place");
    testing_shell("echo x > old/two/a.vert");
    quiet("a change in the old folder");
    testing_shell("echo 123 > one/two/a.vert");
    reported_once("a change in the new one");
}

WATCH_TEST(links_and_their_targets_are_watched)
{
    testing_shell(
        "mkdir here there far; echo 1 > there/a.vert; echo 12 > far/a.vert; echo 1 > far/b");
    testing_shell("mkdir beside; echo 1 > beside/a.vert");
    testing_shell("ln -s ../there/a.vert here/a.vert; ln -s here door");
    watch_one("door/a.vert");
    testing_shell("echo 123 > there/a.vert");
    reported_once("the target, in place");
    testing_shell("echo 1234 > there/new; mv there/new there/a.vert");
    reported_once("the target, replaced");
    testing_shell("ln -sfn ../far/a.vert here/a.vert");
    reported_once("another target");
    testing_shell("echo 5 > there/a.vert");
    quiet("the earlier target");
    testing_shell("echo 56 > far/a.vert");
    reported_once("the present target");
    testing_shell("ln -s beside new; mv -T new door");
    reported_once("another target of the folder's link");
    testing_shell("echo 567 > beside/a.vert");
    reported_once("the file there");
    testing_shell("rm beside/a.vert; ln -s ../far/b beside/a.vert; echo 78 > far/b");
    reported_once("a link instead of a file");
    testing_shell("rm far/b");
    reported_once("a link to nothing");
    testing_shell("echo > far/b");
    reported_once("a link to something again");
}

WATCH_TEST(an_absolute_link_is_followed)
{
    testing_shell(formatted(
        "mkdir far; echo > far/a.vert; ln -s %s/far/a.vert a.vert; ln -s %s/./far//. door",
        testing_folder, testing_folder));
    static const char *const paths[] = {"a.vert", "door/b.vert"};
    watch_paths(paths, 2);
    testing_shell("echo x > far/a.vert");
    reported_once("through a link");
    testing_shell("echo x > far/b.vert");
    reported_once("through a folder's link");
}

WATCH_TEST(circular_links_and_endless_names_end)
{
    static char endless[3 * 4096];
    memset(endless, 'a', sizeof endless - 1);
    memcpy(endless + 300, "/b", 2);
    testing_shell("ln -s b a; ln -s a b; ln -s c/c c");
    const char *const paths[] = {"a", "c", "c/d", endless, "", "/", ".", "a.vert"};
    watch_paths(paths, 8);
    testing_shell("echo > a.vert");
    reported_once("a file beside a circle");
    testing_shell("rm b; echo > b");
    reported_once("the end of a circle");
}

WATCH_TEST(paths_can_be_replaced)
{
    testing_put("a.vert", "old");
    testing_put("b.vert", "old");
    watch_one("a.vert");
    watch_one("b.vert");
    testing_put("a.vert", "newer");
    quiet("a path no longer watched");
    testing_put("b.vert", "newer");
    reported_once("the path watched now");
    watch_paths(NULL, 0);
    testing_put("b.vert", "newest");
    quiet("no path");
}

/* Reported while the writes go on, and after the last. */
WATCH_TEST(a_file_written_all_the_time_is_reported)
{
    const double end = clock_now() + 0.5;
    int times = 0;
    testing_put("a.vert", "old");
    watch_one("a.vert");
    while (clock_now() < end) {
        testing_put("a.vert", "newer");
        times += watch_wait(watch, 0.001);
    }
    testing_put("a.vert", "the newest");
    assert_true(watch_wait(watch, PATIENCE));
    assert_true(times >= 1);
}

WATCH_TEST(a_wait_without_a_change_ends)
{
    watch_one("a.vert");
    assert_false(watch_wait(watch, 0));
    const double start = clock_now();
    struct timespec before, after;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    assert_false(watch_wait(watch, 0.5));
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    assert_true(clock_now() - start >= 0.5);
    const double spent =
        (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
    /* Busy waiting would take 0.5 s. */
    assert_true(spent < 0.1);
}

WATCH_TEST(closing_null_is_fine)
{
    watch_close(NULL);
}

int main(void)
{
    return testing_run(0, "watch", NULL, NULL);
}
