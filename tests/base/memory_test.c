/*
 * Small blocks: what they hold, and the end of a process that gets none.
 */
#include "base/memory.h"
#include "base/output.h"
#include "base/sanitized.h"
#include "support/testing.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

TEST(blocks_are_zeroed_grown_and_copied)
{
    int *numbers = memory_new(3, sizeof *numbers);
    assert_true(numbers[0] == 0 && numbers[2] == 0);
    numbers[2] = 7;
    numbers = memory_grow(numbers, 1000, sizeof *numbers);
    assert_int_equal(numbers[2], 7);
    numbers = memory_grow(numbers, 0, sizeof *numbers);
    free(numbers);
    char *copy = memory_copy("ab\0c", 4), *text = memory_text("text");
    char *formatted = memory_format("%s and %d", text, 3);
    assert_memory_equal(copy, "ab\0c", 5);
    assert_string_equal(formatted, "text and 3");
    free(copy);
    free(text);
    free(formatted);
    free(memory_new(0, 0));
    free(memory_copy(NULL, 0));
}

/* The cases' ways to ask for too much. */
static int way;

static int ask_for_too_much(void)
{
    const int log = open("log", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    Output *output = output_begin("picture.png", NULL);
    if (dup2(log, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0 || !output ||
        !output_append(output_file(output), "half", 4))
        return 100;
    printf("half a line"); /* dropped */
    if (way < 2 && !ADDRESS_SANITIZER) {
        const struct rlimit limit = {64 << 20, 64 << 20};
        setrlimit(RLIMIT_AS, &limit);
    }
    volatile size_t count = way < 2 ? (size_t)512 << 20 : SIZE_MAX / 2 + 2;
    free(way == 0   ? memory_new(count, 1)
         : way == 1 ? memory_grow(NULL, count, 2)
                    : memory_grow(NULL, count, 2)); /* 2 bytes, if the product overflowed */
    return 101;
}

FOLDER_TEST(lack_of_memory_ends_the_process_with_one_line)
{
    const char *expected = formatted("%s: not enough memory\n", program_invocation_short_name);
    for (way = ADDRESS_SANITIZER ? 2 : 0; way < 3; way++) {
        size_t size;
        assert_int_equal(testing_in_child(ask_for_too_much), MEMORY_EXIT);
        char *text = testing_read("log", &size);
        assert_string_equal(text, expected);
        free(text);
        assert_int_equal(testing_entries("."), 1); /* the log */
    }
}

TEST_MAIN("memory", NULL, NULL)
