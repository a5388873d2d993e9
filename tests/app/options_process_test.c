/*
 * What programs say on their standard streams, and what becomes of these.
 */
#include "app/options.h"
#include "base/version.h"
#include "support/testing.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const Usage PROGRAM = {.name = "LightedCube", .summary = "A summary."};
static const Usage GALLERY = {.name = "gallery", .summary = "A summary.", .gallery = true};

static OptionsResult read_word(const Usage *usage, const char *word)
{
    Options options;
    char name[] = "program", copy[16], *arguments[] = {name, copy, NULL};
    snprintf(copy, sizeof copy, "%s", word);
    return options_read(&options, usage, 2, arguments, &(Message){0});
}

/* A stream's file descriptor, while a temporary file stands in its place. */
typedef struct Capture {
    FILE *stream, *file;
    int saved;
} Capture;

static Capture capture_start(FILE *stream)
{
    Capture capture = {.stream = stream, .file = tmpfile()};
    assert_non_null(capture.file);
    fflush(stream);
    capture.saved = dup(fileno(stream));
    assert_true(dup2(fileno(capture.file), fileno(stream)) >= 0);
    return capture;
}

static void capture_end(Capture *capture, char *text, size_t size)
{
    fflush(capture->stream);
    assert_true(dup2(capture->saved, fileno(capture->stream)) >= 0);
    close(capture->saved);
    rewind(capture->file);
    text[fread(text, 1, size - 1, capture->file)] = '\0';
    fclose(capture->file);
}

TEST(help_names_every_option_and_version_is_one_line)
{
    static const char *const named[] = {"Usage: LightedCube [options]",
                                        "A summary.",
                                        "-o, --output",
                                        "-s, --size",
                                        "-t, --time",
                                        "-a, --angle",
                                        "-n, --frames",
                                        "--fps",
                                        "--samples",
                                        "-b, --backend",
                                        "--shaders",
                                        "--precision",
                                        "--print-shader",
                                        "--alpha",
                                        "--compress",
                                        "-v, --verbose",
                                        "--doctor",
                                        "-h, --help",
                                        "--version",
                                        "LIGHTING_SHADERS",
                                        "400x400",
                                        "Exit status"};
    char text[8192];
    Capture capture = capture_start(stdout);
    const OptionsResult result = read_word(&PROGRAM, "--help");
    capture_end(&capture, text, sizeof text);
    assert_int_equal(result, OPTIONS_ANSWERED);
    for (size_t i = 0; i < sizeof named / sizeof named[0]; i++)
        if (!strstr(text, named[i]))
            fail_msg("not in --help: %s", named[i]);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"))
        if (strlen(line) > 100)
            fail_msg("too long: %s", line);

    capture = capture_start(stdout);
    const OptionsResult gallery = read_word(&GALLERY, "-h");
    capture_end(&capture, text, sizeof text);
    assert_int_equal(gallery, OPTIONS_ANSWERED);
    assert_non_null(strstr(text, "Usage: gallery [options] [NAME...]"));
    assert_null(strstr(text, "--frames"));

    capture = capture_start(stdout);
    const OptionsResult version = read_word(&PROGRAM, "--version");
    capture_end(&capture, text, sizeof text);
    assert_int_equal(version, OPTIONS_ANSWERED);
    assert_string_equal(text, "LightedCube (lighting) " VERSION "\n");
}

TEST(a_failure_begins_with_the_programs_name_or_a_place)
{
    char text[256];
    const Message plain = {.text = "a.png: is a folder"};
    const Message placed = {.text = "a.vert:3: syntax error", .located = true};
    const Message empty = {.text = ""};
    Capture capture = capture_start(stderr);
    const int first = options_fail("LightedCube", &plain, EXIT_USAGE);
    const int second = options_fail("LightedCube", &placed, EXIT_FAILED);
    options_fail("LightedCube", &empty, EXIT_FAILED);
    capture_end(&capture, text, sizeof text);
    assert_int_equal(first, EXIT_USAGE);
    assert_int_equal(second, EXIT_FAILED);
    assert_string_equal(text, "LightedCube: a.png: is a folder\na.vert:3: syntax error\n"
                              "LightedCube: failed\n");
}

static int prepare_with_closed_streams(void)
{
    close(0);
    close(1);
    close(2);
    options_prepare_process();
    const int next = open("/dev/null", O_RDONLY);
    char byte;
    if (next != 3)
        return 1; /* a file got the number of a standard stream */
    if (read(0, &byte, 1) != 0)
        return 2;
    if (write(1, "x", 1) >= 0 || write(2, "x", 1) >= 0)
        return 3; /* writing to a closed stream must fail */
    return 0;
}

static int prepare_with_open_streams(void)
{
    int ends[2];
    if (pipe(ends) != 0 || dup2(ends[1], 1) < 0)
        return 1;
    options_prepare_process();
    if (write(1, "x", 1) != 1)
        return 2; /* open streams stay as they are */
    close(ends[0]);
    if (write(1, "x", 1) >= 0 || errno != EPIPE)
        return 3; /* a broken pipe is an error, not the end */
    return signal(SIGXFSZ, SIG_DFL) == SIG_IGN ? 0 : 4;
}

static int finish_on_a_full_device(void)
{
    const int full = open("/dev/full", O_WRONLY);
    const int quiet = open("/dev/null", O_WRONLY);
    if (full < 0 || dup2(full, 1) < 0 || dup2(quiet, 2) < 0)
        return 1;
    if (options_finish("LightedCube", 0) != 0)
        return 2; /* nothing was written, so nothing is lost */
    fputs("data", stdout);
    return options_finish("LightedCube", 0) == EXIT_FAILED ? 0 : 3;
}

TEST(closed_standard_streams_are_reserved)
{
    assert_int_equal(testing_in_child(prepare_with_closed_streams), 0);
}

TEST(open_streams_stay_and_broken_pipes_are_errors)
{
    assert_int_equal(testing_in_child(prepare_with_open_streams), 0);
}

TEST(output_that_does_not_arrive_is_a_failure)
{
    assert_int_equal(testing_in_child(finish_on_a_full_device), 0);
}

int main(void)
{
    return testing_run(0, "options_process", NULL, NULL);
}
