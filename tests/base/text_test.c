/*
 * Texts: lines, comments, and names that were misspelled.
 */
#include "base/text.h"
#include "base/random.h"
#include "support/testing.h"

TEST(a_quoted_source_line_is_known)
{
    assert_true(text_is_quote("  3 | void main() { a | b; }\nmore"));
    assert_true(text_is_quote("  16384 |"));
    assert_false(text_is_quote("  hint: write a | b"));
    assert_false(text_is_quote("3 | no blanks before it"));
    assert_false(text_is_quote("   | no number"));
    assert_false(text_is_quote(""));
}

static void expect_decimal(const char *text)
{
    char *end, *expected_end;
    const double number = text_decimal(text, &end), expected = strtod(text, &expected_end);
    if (memcmp(&number, &expected, sizeof number) != 0 || end != expected_end)
        fail_msg("\"%s\": %.17g, %td bytes; %.17g, %td", text, number, end - text, expected,
                 expected_end - text);
}

TEST(decimals_are_what_strtod_reads)
{
    char cases[] =
        "|-|+1.5|.|-.|.5|5.|-0|-.0 1|1.2.3| \t\n7/|1e5|1.5e|1.25f|0x1p3|\v2|nan|-inf|--1|"
        "1_0|999999999999999|9999999999999999|0.1234567890123456789|00000000000000001";
    for (char *rest = cases, *text; (text = strsep(&rest, "|"));)
        expect_decimal(text);
    Random random = {testing_seed(1)};
    for (int i = 0; i < 100000; i++) {
        char text[64];
        snprintf(text, sizeof text, "%.*f", random_below(&random, 17),
                 random_between(&random, -1, 1) * pow(10, random_below(&random, 16)));
        expect_decimal(text);
    }
}

TEST(comments_become_blanks)
{
    static const struct {
        const char *text, *plain;
    } cases[] = {
        {"", ""},
        {"a / b * c", "a / b * c"},
        {"a // b\nc", "a  \nc"},
        {"a // b", "a  "},
        {"a/* // */b", "a b"},
        {"a/**/b/***/c", "a b c"},
        {"a /*/ b */ c", "a   c"},
        {"a // b /* c\nd */", "a  \nd */"},
        {"a /* b", "a  "},
        {"a //", "a  "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[32];
        strcpy(text, cases[i].text);
        text_strip_comments(text);
        assert_string_equal(text, cases[i].plain);
    }
}

TEST(a_paragraph_breaks_at_blanks_and_after_bars)
{
    static const struct {
        int column, indent, width;
        const char *text, *set;
        int end;
    } cases[] = {
        {0, 2, 9, "", "", 0},
        {0, 2, 9, "one two three four", "one two\n  three\n  four", 6},
        {0, 2, 13, "one two three four", "one two three\n  four", 6},
        {0, 0, 3, "one two", "one\ntwo", 3},
        {0, 4, 2, "three four", "three\n    four", 8}, /* at least a word in each line */
        {7, 2, 9, "one two", "\n  one two", 9},        /* not beside what is there */
        {6, 2, 9, "one two", "one\n  two", 5},
        {4, 4, 6, "three", "three", 9},
        {0, 1, 8, "one|two|three", "one|two|\n three", 6},
        {0, 1, 20, "one\ntwo", "one\n two", 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *set;
        size_t size;
        FILE *file = open_memstream(&set, &size);
        assert_non_null(file);
        const int end =
            text_wrap(file, cases[i].text, cases[i].column, cases[i].indent, cases[i].width);
        assert_int_equal(fclose(file), 0);
        assert_string_equal(set, cases[i].set);
        assert_int_equal(end, cases[i].end);
        free(set);
    }
}

TEST(the_nearest_name_has_the_fewest_edits)
{
    static const char *const names[] = {
        "cube", "sphere", "torus", "LightedCube", "LightedCube_ambient", NULL};
    static const char *const none[] = {NULL};
    static const struct {
        const char *word, *nearest;
    } cases[] = {
        {"cube", "cube"},
        {"cub", "cube"},
        {"cubes", "cube"},
        {"Cube", "cube"},
        {"ucbe", "cube"},
        {"shpere", "sphere"},
        {"tours", "torus"},
        {"lightedcube", "LightedCube"},
        {"LightedCubes", "LightedCube"},
        {"LightedCube_ambiant", "LightedCube_ambient"},
        {"LightedCube_a", "LightedCube_ambient"},
        {"tor", "torus"},
        {"SPH", "sphere"},
        {"LightedC", NULL}, /* two begin so */
        {"square", NULL},   /* half of the letters of sphere */
        {"teapot", NULL},
        {"xyz", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *found = text_nearest(cases[i].word, names);
        if (!cases[i].nearest && found)
            fail_msg("%s: found %s", cases[i].word, found);
        if (cases[i].nearest)
            assert_string_equal(found ? found : "(none)", cases[i].nearest);
    }
    assert_null(text_nearest("cube", none));

    char endless[5000];
    memset(endless, 'c', sizeof endless - 1);
    endless[sizeof endless - 1] = '\0';
    const char *const long_names[] = {endless, NULL};
    assert_null(text_nearest("cube", long_names));
    text_nearest(endless, names); /* whatever it finds, it must return */
}

TEST(what_is_shortened_keeps_its_parentheses)
{
    static const char *const cases[][2] = {
        {"dot(a(b + c), d)", "dot(a(b + c), d)"},
        {"dot(first(b + c).rgb, second)", "dot(first(...).rgb, second)"},
        {"first for dot(b, c) + sum", "first for dot(...) + sum"},
        {"a word and another and more words", "a word and another and ..."}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "%s", cases[i][0]);
        text_shorten(text, i == 2 ? 24 : 28);
        assert_string_equal(text, cases[i][1]);
    }
}

TEST(numbers_at_their_places)
{
    int n[3] = {0};
    assert_int_equal(text_numbers("0:12(3): rest", "#:#(#):", n), 8);
    assert_true(n[0] == 0 && n[1] == 12 && n[2] == 3);
    assert_int_equal(text_numbers("-1:-2: rest", "#:#:", n), 6);
    assert_true(n[0] == -1 && n[1] == -2);
    assert_int_equal(text_numbers("0:12", "#:#:", n), 0);
    assert_int_equal(text_numbers("a:12:", "#:#:", n), 0);
}

TEST_MAIN("text", NULL, NULL)
