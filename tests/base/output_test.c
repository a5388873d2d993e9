/*
 * output: a file is complete or unchanged; devices and pipes are written directly.
 */
#include "app/options.h"
#include "base/output.h"
#include "support/testing.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Bytes; more than a pipe's buffer and than the limits below. */
enum { LARGE = 300000 };

static char large[LARGE + 1];
static Message message;

static bool holds(const char *path, const char *text)
{
    static char found[LARGE + 2];
    const int file = open(path, O_RDONLY | O_NONBLOCK);
    size_t used = 0;
    ssize_t got;
    if (file < 0)
        return false;
    while ((got = read(file, found + used, sizeof found - 1 - used)) > 0)
        used += (size_t)got;
    close(file);
    found[used] = '\0';
    return strcmp(found, text) == 0;
}

static mode_t mode_of(const char *path)
{
    struct stat status;
    assert_int_equal(lstat(path, &status), 0);
    return status.st_mode;
}

static bool write_text(const char *path, const char *text)
{
    message = (Message){0};
    return output_write(path, text, strlen(text), &message);
}

static void written(const char *path, const char *text)
{
    message = (Message){0};
    if (!output_check(path, &message) || !write_text(path, text))
        fail_msg("%s: %s", path, message.text);
    assert_string_equal(message.text, "");
}

/* output_check and output_write fail with a line that contains `said`, and leave no file. */
static void refused(const char *path, const char *said)
{
    const int before = testing_entries(".");
    for (int attempt = 0; attempt < 2; attempt++) {
        message = (Message){0};
        if (attempt ? write_text(path, "new") : output_check(path, &message))
            fail_msg("accepted: %.100s", path);
        if (!strstr(message.text, said) || strchr(message.text, '\n'))
            fail_msg("%.100s: expected \"%s\" in \"%s\"", path, said, message.text);
    }
    assert_int_equal(testing_entries("."), before);
}

FOLDER_TEST(a_new_file_gets_the_bytes_and_the_umask)
{
    const mode_t mask = umask(027);
    written("new.png", "bytes");
    umask(mask);
    assert_true(holds("new.png", "bytes"));
    assert_int_equal(mode_of("new.png"), S_IFREG | 0640);
    written("nothing.png", "");
    assert_true(holds("nothing.png", ""));
    assert_true(output_write("zeros.png", "a\0b", 3, &message));
    struct stat status;
    assert_int_equal(stat("zeros.png", &status), 0);
    assert_int_equal(status.st_size, 3);
    assert_int_equal(testing_entries("."), 3);
}

FOLDER_TEST(a_reader_of_the_old_file_keeps_it_whole)
{
    char text[16] = "";
    testing_put("old.png", "old");
    assert_int_equal(link("old.png", "other_name.png"), 0);
    const int reader = open("old.png", O_RDONLY);
    written("old.png", "new");
    assert_int_equal(read(reader, text, sizeof text), 3);
    close(reader);
    assert_string_equal(text, "old");
    assert_true(holds("other_name.png", "old"));
    assert_true(holds("old.png", "new"));
}

FOLDER_TEST(every_form_of_a_path_works)
{
    char longest[256];
    assert_int_equal(mkdir("sub", 0777), 0);
    const char *absolute = formatted("%s/absolute.png", testing_folder);
    memset(longest, 'n', 255); /* NAME_MAX */
    longest[255] = '\0';
    const char *const paths[] = {"a.png",        "./b.png", "sub/c.png",     "sub//d.png",
                                 "sub/../e.png", absolute,  longest,         "-f.png",
                                 "a b.png",      "%d.png",  "h\xC3\xA9.png", "no_extension"};
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        written(paths[i], "bytes");
        assert_true(holds(paths[i], "bytes"));
    }
    assert_int_equal(testing_entries("sub"), 2);
    assert_int_equal(testing_entries("."), 11);
}

FOLDER_TEST(unwritable_paths_are_rejected_beforehand)
{
    char name[300], path[PATH_MAX + 10];
    testing_put("file.png", "old");
    assert_int_equal(mkdir("sub", 0777), 0);
    assert_int_equal(symlink("sub", "link_to_folder"), 0);
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    memset(path, '/', sizeof path - 1);
    path[sizeof path - 1] = '\0';

    refused("", "name is empty");
    refused("sub", "sub: is a folder");
    refused("sub/", "is a folder");
    refused(".", "is a folder");
    refused("/", "is a folder");
    refused("link_to_folder", "is a folder");
    refused("missing/a.png", "the folder missing/ does not exist");
    refused("/missing/deep/a.png", "the folder /missing/deep/ does not exist");
    refused("missing/", "missing/");
    refused("file.png/a.png", "Not a directory");
    refused("file.png/", "Not a directory");
    refused(name, "File name too long");
    refused(path, "//"); /* the name fills the message */
    assert_true(holds("file.png", "old"));
}

FOLDER_TEST(a_link_stays_and_what_it_points_to_is_replaced)
{
    assert_int_equal(mkdir("far", 0777), 0);
    testing_put("far/target.png", "old");
    assert_int_equal(chmod("far/target.png", 0600), 0);
    assert_int_equal(symlink("target.png", "far/beside.png"),
                     0); /* relative to the link's folder */
    assert_int_equal(symlink("far/beside.png", "link.png"), 0);
    written("link.png", "new");
    assert_true(holds("far/target.png", "new"));
    assert_int_equal(mode_of("far/target.png"), S_IFREG | 0600);
    assert_true(S_ISLNK(mode_of("link.png")));
    assert_true(S_ISLNK(mode_of("far/beside.png")));
    assert_int_equal(testing_entries("far"), 2);
    assert_int_equal(testing_entries("."), 2);
}

FOLDER_TEST(a_link_to_a_file_that_is_not_there_makes_it)
{
    assert_int_equal(symlink(formatted("%s/made.png", testing_folder), "dangling.png"), 0);
    assert_int_equal(symlink("missing/a.png", "lost.png"), 0);
    written("dangling.png", "new");
    assert_true(S_ISLNK(mode_of("dangling.png")));
    assert_int_equal(mode_of("made.png") & S_IFMT, S_IFREG);
    assert_true(holds("made.png", "new"));
    refused("lost.png", "does not exist");
}

FOLDER_TEST(names_of_open_files_are_written_through)
{
    static const char *const forms[] = {"/dev/fd/%d", "/proc/self/fd/%d"};
    for (size_t i = 0; i < 2; i++) {
        struct stat before, after;
        const int file = open("open.png", O_RDWR | O_CREAT | O_TRUNC, 0600);
        assert_int_equal(fstat(file, &before), 0);
        written(formatted(forms[i], file), "through");
        close(file);
        assert_int_equal(stat("open.png", &after), 0);
        assert_int_equal(before.st_ino, after.st_ino);
        assert_true(holds("open.png", "through"));
    }
}

FOLDER_TEST(a_new_file_in_shared_memory_works)
{
    const char *path = formatted("/dev/shm/output_test-%ld.png", (long)getpid());
    if (access("/dev/shm", W_OK) != 0)
        return;
    message = (Message){0};
    const bool done = output_check(path, &message) && write_text(path, "bytes");
    const bool there = holds(path, "bytes");
    unlink(path);
    assert_string_equal(message.text, "");
    assert_true(done && there);
}

FOLDER_TEST(pieces_are_a_file_when_they_are_committed)
{
    testing_put("old.png", "old");
    assert_int_equal(chmod("old.png", 0640), 0);
    for (int whole = 0; whole < 2; whole++) {
        Output *output = output_begin("old.png", &message);
        assert_non_null(output);
        const int file = output_file(output);
        assert_true(output_append(file, "xyz and", 7) && output_append(file, " more", 5));
        assert_int_equal(pwrite(file, "bit", 3, 0), 3);
        char back[4] = "";
        assert_int_equal(pread(file, back, 3, 4), 3);
        assert_string_equal(back, "and");
        assert_true(holds("old.png", "old"));
        if (whole)
            assert_true(output_commit(output, &message));
        else
            output_abort(output);
        assert_true(holds("old.png", whole ? "bit and more" : "old"));
        assert_int_equal(mode_of("old.png") & 07777, 0640);
        assert_int_equal(testing_entries("."), 1);
    }
    output_abort(NULL);
    message = (Message){0};
    assert_null(output_begin("missing/a.png", &message));
    assert_non_null(strstr(message.text, "the folder missing/ does not exist"));
}

FOLDER_TEST(pieces_go_through_when_they_are_committed)
{
    const int file = open("open.png", O_RDWR | O_CREAT | O_TRUNC, 0600);
    const char *path = formatted("/dev/fd/%d", file);
    for (int whole = 0; whole < 2; whole++) {
        Output *output = output_begin(path, &message);
        assert_non_null(output);
        assert_true(output_append(output_file(output), large, LARGE));
        assert_true(holds("open.png", ""));
        if (whole)
            assert_true(output_commit(output, &message));
        else
            output_abort(output);
        assert_true(holds("open.png", whole ? large : ""));
    }
    close(file);
    assert_int_equal(testing_entries("."), 1);
}

static void *replace_for_ever(void *path)
{
    while (write_text(path, large))
        ;
    return NULL;
}

static int replace_two_for_ever(void)
{
    pthread_t thread;
    options_prepare_process();
    if (pthread_create(&thread, NULL, replace_for_ever, (char[]){"b.png"}) == 0)
        replace_for_ever((char[]){"a.png"});
    return 1;
}

/* A signal at a random moment, while two threads do nothing but write: a temporary file has a name
 * for a large part of the time. */
FOLDER_TEST(a_signal_leaves_whole_files_alone)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    /* May be inherited as ignored, as under nohup. */
    for (int i = 0; i < 3; i++)
        signal(numbers[i], SIG_DFL);
    srandom(1);
    for (int attempt = 0; attempt < 150; attempt++) {
        int status = 0;
        fflush(NULL);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0)
            _exit(replace_two_for_ever());
        usleep(2000 + (unsigned)random() % 8000);
        assert_int_equal(kill(child, numbers[attempt % 3]), 0);
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status));
        assert_int_equal(WTERMSIG(status), numbers[attempt % 3]);
        const int a = access("a.png", F_OK) == 0, b = access("b.png", F_OK) == 0;
        assert_int_equal(testing_entries("."), a + b);
        assert_true((!a || holds("a.png", large)) && (!b || holds("b.png", large)));
    }
}

/* Mounts a file system of 100 kB for this process alone; false if that is not permitted. */
static bool mount_small(const char *path)
{
    if (mkdir(path, 0777) != 0)
        return false;
    if (unshare(CLONE_NEWNS) != 0) {
        char map[64];
        const int length = snprintf(map, sizeof map, "0 %u 1", (unsigned)getuid());
        if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0)
            return false;
        const int file = open("/proc/self/uid_map", O_WRONLY);
        if (file < 0 || write(file, map, (size_t)length) != length)
            return false;
        close(file);
    }
    return mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) == 0 &&
           mount("small", path, "tmpfs", 0, "size=100k") == 0;
}

enum { NOT_PERMITTED = 77 };

static int write_without_proc(void)
{
    if (!mount_small("small") || mount("none", "/proc", "tmpfs", 0, NULL) != 0)
        return NOT_PERMITTED;
    if (!write_text("small/new.png", "new") || !holds("small/new.png", "new"))
        return 1;
    /* Here the temporary file is named from the beginning and must be removed. */
    if (write_text("small/new.png", large) || write_text("small/other.png", large))
        return 2;
    return holds("small/new.png", "new") && testing_entries("small") == 1 ? 0 : 3;
}

static int end_child(void)
{
    output_unlink_temporaries();
    return 0;
}

/* With temporary files that are named all the time. A child removes none of its parent's. */
static int end_without_proc(void)
{
    if (!mount_small("small") || mount("none", "/proc", "tmpfs", 0, NULL) != 0)
        return NOT_PERMITTED;
    options_prepare_process();
    Output *output = output_begin("small/new.png", &message);
    if (!output || testing_in_child(end_child) != 0 || testing_entries("small") != 1)
        return 1;
    output_unlink_temporaries();
    return testing_entries("small") == 0 ? 0 : 2;
}

static void check_mounted(int (*body)(void))
{
    const int result = testing_in_child(body);
    if (result == NOT_PERMITTED)
        print_message("not checked: this machine does not permit mounting a file system\n");
    else
        assert_int_equal(result, 0);
}

FOLDER_TEST(a_file_can_be_written_where_proc_is_not_mounted)
{
    check_mounted(write_without_proc);
}

FOLDER_TEST(a_leftover_temporary_name_is_removed_at_the_end)
{
    check_mounted(end_without_proc);
}

FOLDER_TEST(checking_beforehand_writes_nothing)
{
    testing_put("old.png", "old");
    assert_true(output_check("old.png", NULL));
    assert_true(output_check("new.png", NULL));
    assert_true(output_check("-", NULL));
    assert_false(output_check("missing/a.png", NULL));
    assert_true(holds("old.png", "old"));
    assert_int_equal(testing_entries("."), 1);
}

FOLDER_TEST(a_pattern_gives_numbered_names)
{
    static const struct {
        const char *pattern;
        int number;
        const char *path;
    } good[] = {
        {"a%d.png", 7, "a7.png"},
        {"a%d.png", 12345, "a12345.png"},
        {"a%04d.png", 7, "a0007.png"},
        {"a%4d.png", 7, "a   7.png"},
        {"%03d", 1000, "1000"},
        {"%%%d%%", 1, "%1%"},
        {"d%d/a.png", 2, "d2/a.png"},
        {"%0d", 5, "5"},
        {"%20d", 1, "                   1"},
        {"%d", 0, "0"},
    };
    static const char *const bad[] = {
        "a.png", "",     "%%",    "%",   "a%",   "%%d",  "%d%d", "%d%04d", "%s",
        "%i",    "%u",   "%x",    "%ld", "%-3d", "%+d",  "% d",  "%.3d",   "%*d",
        "%1$d",  "%21d", "%100d", "%n",  "%d%n", "%d%s", "%0",   "%03",    "%99999999999d"};
    char path[32];
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        message = (Message){0};
        if (!output_numbered(good[i].pattern, good[i].number, path, sizeof path, &message))
            fail_msg("%s: %s", good[i].pattern, message.text);
        assert_string_equal(path, good[i].path);
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        message = (Message){0};
        if (output_numbered(bad[i], 3, path, sizeof path, &message))
            fail_msg("accepted: %s", bad[i]);
        assert_non_null(strstr(message.text, ": "));
        assert_memory_equal(message.text, bad[i], strlen(bad[i]));
    }
}

FOLDER_TEST(a_numbered_name_that_is_too_long_is_refused)
{
    char path[16] = "";
    assert_true(output_numbered("picture%03d.png", 7, path, sizeof path - 1, NULL));
    assert_string_equal(path, "picture007.png"); /* 14 characters and the terminating zero */
    memset(path, 'z', sizeof path);
    assert_false(output_numbered("picture%03d.png", 7, path, 14, NULL));
    assert_int_equal(path[14], 'z');
    assert_false(output_numbered("%20d", 7, path, 20, NULL));
    assert_int_equal(path[14], 'z');
}

int main(void)
{
    /* As options_prepare_process does in every program. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    memset(large, 'L', LARGE);
    return testing_run(0, "output", NULL, NULL);
}
