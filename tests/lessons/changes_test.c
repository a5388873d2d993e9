/* Which lines changed: known pairs, and random ones, of which both files can be put together again
 * and no fewer lines could have changed. */
#include "lessons/changes.h"
#include "support/testing.h"

static Message message;

/* The lines with their marks, between bars. */
static void marked(const Changes *changes, char text[1024])
{
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < changes->count; i++)
        length += (size_t)snprintf(text + length, 1024 - length, "%c%s|",
                                   " -+."[changes->lines[i].kind], changes -> lines[i].text);
}

static void assert_changes(const char *before, const char *after, int around, const char *expected)
{
    char found[1024];
    Changes changes = {.count = 0};
    int changed, expected_changed = 0;
    require(changes_between(&changes, (ChangeText){"Old", before, false},
                            (ChangeText){"New", after, false}, around, &changed, &message),
            &message);
    marked(&changes, found);
    assert_string_equal(found, expected);
    for (int i = 0; i < changes.count; i++)
        expected_changed +=
            changes.lines[i].kind == CHANGE_ADDED || changes.lines[i].kind == CHANGE_REMOVED;
    assert_int_equal(changed, expected_changed);
    changes_close(&changes);
}

TEST(known_pairs)
{
    assert_changes("", "", 1, "");
    assert_changes("a\nb\n", "a\nb\n", 1, "");
    assert_changes("a\nb", "a\nb\n", 1, "");
    assert_changes("", "a\n", 1, "+a|");
    assert_changes("a\n", "", 1, "-a|");
    assert_changes("a\nb\nc\n", "a\nx\nc\n", 1, " a|-b|+x| c|");
    assert_changes("a\nb\nc\n", "a\nx\nc\n", 0, "-b|+x|");
    assert_changes("a\nb\nc\n", "a\nc\n", 1, " a|-b| c|");
    assert_changes("1\n2\n3\n4\n5\n6\n7\n", "0\n1\n2\n3\n4\n5\n6\n7\n8\n", 1, "+0| 1|.| 7|+8|");
    assert_changes("a\n\nb\n", "a\n \nb\n", 1, " a|-|+ | b|");
}

TEST(the_name_of_the_program_is_no_difference)
{
    assert_changes("const Old;\nx\n", "const New;\nx\n", 1, "");
    assert_changes("Old\n", "New2\n", 1, "-Old|+New2|");
    assert_changes("New\n", "Old\n", 1, "-New|+Old|");
}

/* Of a C file, what it does. */
TEST(comments_and_texts_of_help_do_not_count_in_code)
{
    static const char before[] = "/*\n * Old: one thing.\n */\n#include \"a.h\"\n\n/* One. */\n"
                                 "static const int A = 1; /* one */\nint b;\n"
                                 "    .summary = \"one\",\n    .tries = {\"-t 1\",\n  \"-t 2\"},\n"
                                 "    .draw = draw,\n";
    static const char after[] =
        "/*\n * New: another thing,\n * and more.\n */\n#include \"a.h\"\n"
        "/* Two\n * lines. */\nstatic const int A = 2; /* one */\nint b;\n\n"
        "    .summary = \"two\",\n    .draw = draw,\n";
    const ChangeText texts[2] = {{"Old", before, true}, {"New", after, true}};
    char found[1024];
    Changes changes = {.count = 0};
    int changed;
    require(changes_between(&changes, texts[0], texts[1], 0, &changed, &message), &message);
    marked(&changes, found);
    assert_string_equal(found, "-static const int A = 1; /* one */|"
                               "+static const int A = 2; /* one */|");
    assert_int_equal(changed, 2);
    changes_close(&changes);
}

static unsigned next(unsigned *seed)
{
    return *seed = *seed * 1664525U + 1013904223U;
}

static int random_text(unsigned *seed, char text[64])
{
    const int count = (int)(next(seed) >> 16) % 8;
    for (int i = 0; i < count; i++) {
        text[2 * i] = (char)('a' + (next(seed) >> 16) % 3);
        text[2 * i + 1] = '\n';
    }
    text[2 * count] = '\0';
    return count;
}

/* Of the common lines of two files from there on, by trying all. */
static int most_common(const char *a, const char *b)
{
    if (!*a || !*b)
        return 0;
    if (*a == *b)
        return 1 + most_common(a + 2, b + 2);
    const int without_a = most_common(a + 2, b), without_b = most_common(a, b + 2);
    return without_a > without_b ? without_a : without_b;
}

TEST(both_files_follow_from_the_fewest_changes)
{
    unsigned seed = 7;
    for (int round = 0; round < 2000; round++) {
        char texts[2][64], made[2][64] = {"", ""};
        Changes changes = {.count = 0};
        int changed;
        const int before = random_text(&seed, texts[0]), after = random_text(&seed, texts[1]);
        require(changes_between(&changes, (ChangeText){"Old", texts[0], false},
                                (ChangeText){"New", texts[1], false}, 100, &changed, &message),
                &message);
        assert_int_equal(changed, before + after - 2 * most_common(texts[0], texts[1]));
        for (int i = 0; i < changes.count && changed; i++)
            for (int k = 0; k < 2; k++)
                if (changes.lines[i].kind != (k ? CHANGE_REMOVED : CHANGE_ADDED))
                    strcat(strcat(made[k], changes.lines[i].text), "\n");
        for (int k = 0; k < 2 && changed; k++)
            assert_string_equal(made[k], texts[k]);
        changes_close(&changes);
    }
}

TEST(files_of_too_many_lines_are_an_error)
{
    static char text[2 * 5000 + 1];
    Changes changes = {.count = 0};
    int changed;
    memset(text, '\n', 5000);
    assert_false(changes_between(&changes, (ChangeText){"old", "", false},
                                 (ChangeText){"new", text, false}, 1, &changed, &message));
    assert_string_equal(message.text, "new: more than 4096 lines");
    changes_close(&changes);
}

TEST(a_line_that_is_too_long_is_cut)
{
    char text[1000];
    Changes changes = {.count = 0};
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    changes_add_text(&changes, text);
    assert_int_equal(changes.count, 1);
    assert_int_equal(strlen(changes.lines[0].text), CHANGE_TEXT_SIZE - 1);
    changes_close(&changes);
}

TEST_MAIN("changes", NULL, NULL)
