/*
 * sandbox: files and pictures that are not trusted, what a confined process cannot do, and how it
 * ends.
 */
#include "base/sanitized.h"
#include "labs/check/code.h"
#include "labs/sandbox/png_copy.h"
#include "labs/sandbox/sandbox.h"
#include "labs/sandbox/source.h"
#include "support/testing.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

static Message message;
static Bundle bundle;

static int start(void **state)
{
    (void)state;
    message.text[0] = '\0';
    bundle_close(&bundle);
    return 0;
}

TEST_WITH(0, odd_names_and_encodings_become_the_labs, start, NULL)
{
    static const char utf16[] = "\xFF\xFEv\0o\0i\0d\0\xE9\0";
    assert_true(bundle_add(&bundle, "Lab05.FRAG.txt", utf16, sizeof utf16 - 1, &message));
    assert_true(bundle_add(&bundle, "main.vert", "x", 1, &message));
    source_normalize(&bundle, &LABS[4]);
    const BundleFile *file = bundle_find(&bundle, "lab05.frag");
    assert_non_null(file);
    assert_string_equal((const char *)file->bytes, "void\xC3\xA9");
    assert_non_null(bundle_find(&bundle, "lab05.vert"));
    assert_true(source_is_wanted("lab05.frag.txt"));
    assert_false(source_is_wanted("notes.txt"));
}

/* Without ".txt" nothing safe is left of these. */
TEST_WITH(0, a_name_that_is_only_an_ending_stays, start, NULL)
{
    static const char *const names[] = {"a/.txt", "..txt", "...txt"};
    for (int i = 0; i < 3; i++)
        assert_true(bundle_add(&bundle, names[i], "x", 1, &message));
    source_normalize(&bundle, &LABS[4]);
    for (int i = 0; i < 3; i++)
        assert_non_null(bundle_find(&bundle, names[i]));
}

/* Files in memory. */

TEST_WITH(0, names_that_leave_a_folder_are_refused, start, NULL)
{
    static const char *const bad[] = {"",     "/a", "..",  "a/../b", "a/..",  ".",
                                      "a//b", "a/", "./a", "a\nb",   "a\x7F", "1/2/3/4/5/6/7/8/9"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_false(bundle_name_is_safe(bad[i]));
        assert_false(bundle_add(&bundle, bad[i], "x", 1, &message));
    }
    assert_true(bundle_name_is_safe("a/b..c/.d"));
    assert_true(bundle_add(&bundle, "a/empty.h", "", 0, &message));
    assert_false(bundle_add(&bundle, "a/empty.h", "", 0, &message));
}

/* A PNG of one pixel. */
static const unsigned char PIXEL[] = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
    0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00, 0x0C, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9C, 0x63, 0xF8, 0xCF, 0xC0, 0x00, 0x00, 0x03, 0x01, 0x01, 0x00, 0xC9, 0xFE, 0x92,
    0xEF, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

TEST_WITH(0, only_the_picture_of_a_png_is_kept, start, NULL)
{
    unsigned char bytes[sizeof PIXEL + 64];
    /* An empty text chunk with its checksum. */
    static const unsigned char text[] = {0x00, 0x00, 0x00, 0x00, 0x74, 0x45,
                                         0x58, 0x74, 0x96, 0x42, 0xC5, 0x85};
    size_t size = sizeof PIXEL;
    memcpy(bytes, PIXEL, size);
    assert_true(png_copy(bytes, &size, &message));
    assert_int_equal(size, sizeof PIXEL);
    for (size_t i = 0; i < sizeof PIXEL; i++) {
        memcpy(bytes, PIXEL, sizeof PIXEL);
        bytes[i] ^= 0x10;
        size = sizeof PIXEL;
        assert_false(png_copy(bytes, &size, NULL)); /* a checksum covers every byte */
        size = i;
        memcpy(bytes, PIXEL, sizeof PIXEL);
        assert_false(png_copy(bytes, &size, NULL));
    }
    memcpy(bytes, PIXEL, 33);
    memcpy(bytes + 33, text, sizeof text);
    memcpy(bytes + 33 + sizeof text, PIXEL + 33, sizeof PIXEL - 33);
    memcpy(bytes + sizeof PIXEL + sizeof text, "<script>", 8); /* after the end */
    size = sizeof PIXEL + sizeof text + 8;
    assert_true(png_copy(bytes, &size, &message));
    assert_int_equal(size, sizeof PIXEL);
    assert_memory_equal(bytes, PIXEL, sizeof PIXEL);
}

/* What a confined process can do, as bits of its exit code. */
enum {
    FORKED = 1,
    WROTE = 2,
    CONNECTED = 4,
    SIGNALLED = 8,
    EMPTIED = 16,
    UNREAD = 32,
    OPENED = 64
};

static int try_everything(const char *path)
{
    int done = 0;
    char byte;
    Message own = {.text = ""};
    if (!confine_process(true, &own))
        return 255;
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    done |= child > 0 ? FORKED : 0;
    done |= open(path, O_WRONLY | O_CREAT, 0600) >= 0 ? WROTE : 0;
    done |= open(path, O_RDONLY | O_TRUNC) >= 0 ? EMPTIED : 0;
    done |= socket(AF_INET, SOCK_STREAM, 0) >= 0 ? CONNECTED : 0;
    done |= kill(getppid(), 0) == 0 ? SIGNALLED : 0;
    const int file = open(path, O_RDONLY);
    done |= file < 0 || read(file, &byte, 1) != 1 ? UNREAD : 0;
    /* Once what it runs is loaded, it opens nothing. */
    if (!confine_process(false, &own))
        return 255;
    done |= open(path, O_RDONLY) >= 0 ? OPENED : 0;
    return done;
}

/* Also as root. */
TEST_WITH(0, a_confined_process_can_only_compute, start, NULL)
{
    static const char path[] = "file";
    int status;
    testing_put(path, "x");
    const pid_t child = fork();
    if (child == 0)
        _exit(try_everything(path));
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) == 255)
        skip();
    assert_int_equal(WEXITSTATUS(status), 0);
}

/* Of a process that ended with this status, while it worked on a submission. */
static void assert_end(const char *said, int status, SandboxEnd end, const char *why)
{
    char bytes[512] = "", reason[1024];
    const int size = snprintf(bytes + 1, sizeof bytes - 1, "%s", said);
    const SandboxRun run = {.bytes = bytes, .size = (size_t)size + 1, .status = status};
    assert_int_equal(sandbox_end(&run), end);
    sandbox_reason(&run, reason);
    assert_string_equal(reason, why);
}

/* Else a fault of `check` would read as one of the submission. */
TEST_WITH(0, a_sanitizers_report_is_a_failure_to_judge, start, NULL)
{
    static const char overflow[] = "two.c:3:4: runtime error: signed integer overflow";
    assert_end("no memory\n", 1, SANDBOX_CRASHED, "no memory");
    assert_end(overflow, 1, ADDRESS_SANITIZER ? SANDBOX_FAILED : SANDBOX_CRASHED, overflow);
    if (!ADDRESS_SANITIZER)
        return;
    assert_end("==7==ERROR: AddressSanitizer: heap-buffer-overflow on\n    #0 in line_of\n\n"
               "SUMMARY: AddressSanitizer: heap-buffer-overflow matrices.c:9 in line_of\n"
               "Shadow bytes\n==7==ABORTING\n",
               1, SANDBOX_FAILED,
               "SUMMARY: AddressSanitizer: heap-buffer-overflow matrices.c:9 in line_of");
    assert_end("==7==LeakSanitizer has encountered a fatal error.\n", 1, SANDBOX_FAILED,
               "==7==LeakSanitizer has encountered a fatal error.");
}

int main(void)
{
    return testing_run(0, "sandbox", testing_enter_folder, testing_leave_folder);
}
