/*
 * Animations as files and streams, complete or not at all; animation_test.py reads them back.
 */
#include "images/animation.h"
#include "support/testing.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static Message message;

static AnimationOptions wanted(const char *format, const char *path)
{
    return (AnimationOptions){.format = format,
                              .path = path,
                              .width = 32,
                              .height = 24,
                              .frames = 3,
                              .fps = 30,
                              .compress = IMAGE_COMPRESS_DEFAULT};
}

FOLDER_TEST(what_a_format_cannot_hold_is_refused)
{
    static const struct {
        const char *format;
        double fps;
        bool alpha, possible;
    } cases[] = {
        {"gif", 100, false, true},      {"gif", 100.01, false, false},
        {"gif", 0.00153, false, true},  {"gif", 0.00152, false, false},
        {"gif", 30, true, false},       {"webp", 1000, true, true},
        {"webp", 1000.1, false, false}, {"apng", 65535, true, true},
        {"apng", 65536, false, false},  {"mp4", 1e6, false, true},
        {"mp4", 30, true, false},       {"webm", 1000, true, true},
        {"webm", 1001, false, false},   {"y4m", 1e6, false, true},
        {"y4m", 30, true, false},       {"rgb", 0.001, false, true},
        {"rgb", 30, true, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        AnimationOptions options = wanted(cases[i].format, NULL);
        options.fps = cases[i].fps;
        options.alpha = cases[i].alpha;
        message = (Message){0};
        if (animation_check(&options, &message) != cases[i].possible)
            fail_msg("%s, %g, alpha %d: %s", cases[i].format, cases[i].fps, cases[i].alpha,
                     message.text);
        assert_int_equal(message.text[0] != '\0', !cases[i].possible);
    }
}

/* Redirects standard output to a file; returns the argument of to_terminal. */
static int to_file(const char *path)
{
    fflush(stdout);
    const int saved = dup(1), file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    assert_true(saved >= 0 && file >= 0 && dup2(file, 1) == 1);
    close(file);
    return saved;
}

static void to_terminal(int saved)
{
    dup2(saved, 1);
    close(saved);
}

/* The tolerance is for values halfway between two integers, which doubles round either way. */
static void is_nearest(unsigned char found, double value)
{
    if (fabs(found - value) > 0.5 + 1e-12 * 255)
        fail_msg("%d is not %.15g", found, value);
}

/* Every 15th level of each channel: 18^3 pixels. */
FOLDER_TEST(y4m_is_bt601_to_the_nearest_number)
{
    enum { LEVELS = 18, COUNT = LEVELS * LEVELS * LEVELS };
    static unsigned char found[3 * COUNT];
    Picture picture = {.alpha = false};
    AnimationOptions options = wanted("y4m", NULL);
    Animation *animation;
    char line[128];
    options.width = LEVELS * LEVELS;
    options.height = LEVELS;
    assert_true(image_open(&picture.image, options.width, options.height, IMAGE_BYTE, NULL));
    unsigned char *pixels = picture.image.pixels;
    for (int i = 0; i < COUNT; i++) {
        const int levels[] = {i % LEVELS, i / LEVELS % LEVELS, i / LEVELS / LEVELS};
        for (int c = 0; c < 3; c++)
            pixels[4 * i + c] = (unsigned char)(15 * levels[c]);
    }
    message = (Message){0};
    const int saved = to_file("a.y4m");
    const bool done = animation_open(&animation, &options, &message) &&
                      animation_add(animation, &picture, &message) &&
                      animation_close(animation, true, &message);
    to_terminal(saved);
    assert_string_equal(message.text, "");
    assert_true(done);
    FILE *file = fopen("a.y4m", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "YUV4MPEG2 W324 H18 F30:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "FRAME\n");
    assert_int_equal(fread(found, 1, sizeof found, file), sizeof found);
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
    for (int i = 0; i < COUNT; i++) {
        const double r = pixels[4 * i] / 255.0, g = pixels[4 * i + 1] / 255.0;
        const double b = pixels[4 * i + 2] / 255.0, y = 0.299 * r + 0.587 * g + 0.114 * b;
        is_nearest(found[i], 219 * y + 16);
        is_nearest(found[COUNT + i], 224 * (b - y) / 1.772 + 128);
        is_nearest(found[2 * COUNT + i], 224 * (r - y) / 1.402 + 128);
    }
    image_close(&picture.image);
}

static void open_picture(Picture *picture, int width, int height, ImageType type)
{
    *picture = (Picture){.alpha = false};
    assert_true(image_open(&picture->image, width, height, type, NULL));
}

FOLDER_TEST(a_picture_of_another_size_is_refused)
{
    static const struct {
        int width, height;
        ImageType type;
    } cases[] = {{31, 24, IMAGE_BYTE}, {32, 25, IMAGE_BYTE}, {32, 24, IMAGE_FLOAT}};
    const AnimationOptions options = wanted("rgb", NULL);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Picture picture;
        Animation *animation;
        open_picture(&picture, cases[i].width, cases[i].height, cases[i].type);
        message = (Message){0};
        assert_true(animation_open(&animation, &options, &message));
        assert_false(animation_add(animation, &picture, &message));
        assert_non_null(strstr(message.text, "32x24"));
        assert_false(animation_close(animation, false, &message));
        image_close(&picture.image);
    }
}

static const char *const FILES[] = {"gif", "webp", "apng", "mp4", "webm"};

/* Adds `count` of three pictures and closes. Leaves no process, and no file unless complete. */
static void add_and_close(const char *format, int count, bool whole)
{
    Picture picture;
    Animation *animation;
    const char *path = formatted("a.%s", format);
    const AnimationOptions options = wanted(format, path);
    open_picture(&picture, 32, 24, IMAGE_BYTE);
    message = (Message){0};
    bool done = animation_open(&animation, &options, &message);
    for (int i = 0; i < count && done; i++) {
        memset(picture.image.pixels, 80 * i, 4 * 32 * 24);
        done = animation_add(animation, &picture, &message);
    }
    assert_string_equal(message.text, "");
    assert_int_equal(animation_close(animation, whole, &message), whole);
    image_close(&picture.image);
    errno = 0;
    assert_true(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD);
    assert_int_equal(testing_entries("."), whole);
    struct stat status;
    if (whole) {
        assert_int_equal(stat(path, &status), 0);
        assert_true(status.st_size > 0);
        assert_int_equal(unlink(path), 0);
    }
}

FOLDER_TEST(a_complete_animation_is_a_file_and_an_incomplete_one_nothing)
{
    for (size_t i = 0; i < sizeof FILES / sizeof FILES[0]; i++) {
        add_and_close(FILES[i], 3, true);
        for (int count = 0; count <= 3; count++)
            add_and_close(FILES[i], count, false);
    }
    assert_true(animation_close(NULL, true, NULL));
    assert_false(animation_close(NULL, false, NULL));
}

FOLDER_TEST(impossible_animations_are_not_opened)
{
    for (size_t i = 0; i < sizeof FILES / sizeof FILES[0]; i++) {
        Animation *animation;
        const AnimationOptions options = wanted(FILES[i], formatted("missing/a.%s", FILES[i]));
        message = (Message){0};
        assert_false(animation_open(&animation, &options, &message));
        assert_null(animation);
        assert_non_null(strstr(message.text, "the folder missing/ does not exist"));
    }
    assert_int_equal(testing_entries("."), 0);
}

/* Queues with a sink. */

typedef struct Seen {
    int count, last, fails_at;
    const char *said;
} Seen;

static bool see(void *data, const Picture *picture, Message *reason)
{
    Seen *seen = data;
    const int number = atoi(picture->path);
    if (number != seen->last + 1)
        return message_set(reason, "%d comes after %d", number, seen->last);
    seen->last = number;
    if (++seen->count == seen->fails_at)
        return seen->said ? message_set(reason, "%s", seen->said) : false;
    return true;
}

static bool give_all(Seen *seen, int count)
{
    const PictureQueueOptions options = {8, 8, IMAGE_BYTE, count, see, seen};
    PictureQueue *queue;
    bool done = true;
    message = (Message){0};
    assert_true(picture_queue_open(&queue, &options, &message));
    for (int i = 1; i <= count && done; i++) {
        Picture *picture = picture_queue_take(queue);
        snprintf(picture->path, sizeof picture->path, "%d", i);
        done = picture_queue_give(queue, picture, &message);
    }
    return picture_queue_close(queue, &message) && done;
}

FOLDER_TEST(one_thread_gets_the_pictures_in_their_order)
{
    Seen seen = {.count = 0};
    assert_true(give_all(&seen, 500));
    assert_int_equal(seen.count, 500);
    assert_string_equal(message.text, "");
}

FOLDER_TEST(a_sink_that_fails_gets_no_more_pictures)
{
    static const char *const said[] = {"full", NULL}; /* with and without a message */
    for (int i = 0; i < 2; i++) {
        Seen seen = {.fails_at = 7, .said = said[i]};
        assert_false(give_all(&seen, 500));
        assert_int_equal(seen.count, 7);
        assert_string_equal(message.text, said[i] ? said[i] : "");
    }
}

int main(void)
{
    signal(SIGPIPE, SIG_IGN); /* as in every program, by options_prepare_process */
    return testing_run(0, "animation", NULL, NULL);
}
