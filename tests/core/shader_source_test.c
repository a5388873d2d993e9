/*
 * shader_source: finding, including and numbering files. No GL.
 */
#include "core/shader_folder.h"

#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* The same with a location, "file:line: ". */
static void refused_at(const char *name, const char *place, const char *said)
{
    refused(name, place, said);
    assert_true(failure.located);
}

/* The text after preprocessing, without #version. */
static void becomes(const char *text, const char *body)
{
    make("main.vert", text);
    const char *expected = formatted("#version 100\n%s", body);
    found("main.vert", "./main.vert");
    text_is(expected);
}

/* Search. */

SHADER_TEST(the_folders_are_searched_in_order_by_path_and_by_name)
{
    assert_int_equal(system("mkdir -p one/lecture two/lecture"), 0);
    static const char *const places[] = {"one/lecture/LightedCube.vert", "one/LightedCube.vert",
                                         "two/lecture/LightedCube.vert", "two/LightedCube.vert"};
    for (int i = 0; i < 4; i++)
        make(places[i], "int found;\n");
    loader.folder = "one";
    setenv("LIGHTING_SHADERS", "two", 1);
    for (int i = 0; i < 4; i++) {
        found("lecture/LightedCube.vert", places[i]);
        assert_int_equal(unlink(places[i]), 0);
    }
    found("lecture/LightedCube.vert", testing_source("shaders/lecture/LightedCube.vert"));
    loader.folder = NULL;
    setenv("LIGHTING_SHADERS", "", 1);
    found("lecture/LightedCube.vert", testing_source("shaders/lecture/LightedCube.vert"));
}

SHADER_TEST(a_file_name_alone_is_not_found_in_the_source_tree)
{
    refused("LightedCube.vert", "LightedCube.vert: no such shader file\n", "tried");
}

SHADER_TEST(every_path_that_was_tried_is_listed_in_order)
{
    const char *const tried[] = {
        "\n  tried one/lecture/nope.vert", "\n  tried one/nope.vert",
        "\n  tried two/lecture/nope.vert", "\n  tried two/nope.vert",
        formatted("\n  tried %s", testing_source("shaders/lecture/nope.vert"))};
    loader.folder = "one";
    setenv("LIGHTING_SHADERS", "two", 1);
    refused("lecture/nope.vert", "lecture/nope.vert: no such shader file", "");
    const char *p = failure.text;
    for (int i = 0; i < 5; i++) {
        p = strstr(p, tried[i]);
        if (!p)
            fail_msg("not listed in its place: %s in %s", tried[i], failure.text);
    }
    /* And two of an installation. */
    int lines = 0;
    for (p = failure.text; (p = strstr(p, "\n  tried ")); p++)
        lines++;
    assert_int_equal(lines, 7);
}

SHADER_TEST(an_absolute_path_is_tried_alone)
{
    const char *path = formatted("%s/here.vert", testing_folder);
    make("here.vert", "int a;\n");
    found(path, path);
    refused("/missing/a.vert", "/missing/a.vert: no such shader file\n  tried /missing/a.vert", "");
    assert_null(strstr(strstr(failure.text, "tried") + 1, "tried"));
}

SHADER_TEST(missing_folders_are_named)
{
    failure = (Message){0};
    assert_true(shader_loader_check(&loader, &failure));
    loader.folder = "nowhere";
    FAILS(shader_loader_check(&loader, message), "nowhere: no such shader folder");
    make("file", "text");
    loader.folder = "file";
    assert_false(shader_loader_check(&loader, NULL));
    loader.folder = NULL;
    assert_true(shader_loader_check(&loader, NULL));
    failure = (Message){0};
    setenv("LIGHTING_SHADERS", "nowhere", 1);
    FAILS_WITH(shader_loader_check(&loader, message),
               "LIGHTING_SHADERS=nowhere: there is no such folder");
    setenv("LIGHTING_SHADERS", "", 1);
    assert_true(shader_loader_check(&loader, NULL));
}

static int load_as_nobody(void)
{
    if (!testing_drop_root())
        return 1;
    return !load("secret.vert") && strstr(failure.text, "./secret.vert: Permission denied") ? 0 : 2;
}

SHADER_TEST(a_file_that_cannot_be_read_ends_the_search)
{
    assert_int_equal(mkdir("folder.vert", 0777), 0);
    assert_int_equal(mkfifo("pipe.vert", 0666), 0); /* must not wait for a writer */
    assert_int_equal(symlink("loop.vert", "loop.vert"), 0);
    assert_int_equal(symlink("/dev/zero", "zero.vert"), 0);
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    refused("pipe.vert", "./pipe.vert: is not a regular file", "");
    refused("zero.vert", "./zero.vert: is not a regular file", "");
    refused("loop.vert", "./loop.vert: ", "symbolic links");

    make("secret.vert", "int a;\n");
    assert_int_equal(chmod("secret.vert", 0), 0);
    assert_int_equal(chmod(".", 0755), 0);
    assert_int_equal(testing_in_child(load_as_nobody), 0);
}

/* Text. */

SHADER_TEST(line_ends_and_a_byte_order_mark_make_no_difference)
{
    becomes("int a;\n\nint b;\n", "int a;\n\nint b;\n");
    becomes("int a;\r\n\r\nint b;\r\n", "int a;\n\nint b;\n");
    becomes("int a;\r\rint b;\r", "int a;\n\nint b;\n");
    becomes("\xEF\xBB\xBFint a;\n\nint b;", "int a;\n\nint b;\n");
    becomes("// h\xC3\xA9llo\n\tint a;\f\n", "// h\xC3\xA9llo\n\tint a;\f\n");
}

/* In the file that is asked for and in one that it includes. */
SHADER_TEST(what_no_file_may_have_is_refused_with_its_line)
{
    static const struct {
        const char *place, *said, *texts[8];
    } cases[] = {
        {"./part.glsl:3: ", "byte 0x1B", {"int a;\r\n\r\nint \x1B[31m;\n"}},
        {"./part.glsl:1: ", "byte 0x7F", {"\x7F"}},
        {"./part.glsl:2: ", "byte 0x1A: the file is not text", {"\x89PNG\r\n\x1A\n"}},
        {"./part.glsl:1: ", "the file is empty", {"", "\n", " \t\r\n\r\n", "\xEF\xBB\xBF"}},
        {"./part.glsl:1: ",
         "only #version 100",
         {"#version 300 es", "#version 110", "#version 1000", "#version", "#version es",
          "# version 99"}},
        {"./part.glsl:2: ",
         "#include needs a file's name in double quotes",
         {"\n#include", "\n#include a.glsl", "\n#include <a.glsl>", "\n#include \"",
          "\n#include \"\"", "\n#include \"a.glsl", "\n#include 'a.glsl'"}},
        {"./part.glsl:2: sub/nope.glsl: no such shader file",
         "\n  tried ./sub/nope.glsl",
         {"int a;\n#include \"sub/nope.glsl\"\n"}},
        {"./part.glsl:1: ./folder.glsl: is not a regular file", "", {"#include \"folder.glsl\"\n"}},
    };
    assert_int_equal(mkdir("folder.glsl", 0777), 0);
    make("main.vert", "int a;\n#include \"part.glsl\"\n");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (const char *const *text = cases[i].texts; *text; text++) {
            make("part.glsl", *text);
            refused_at("part.glsl", cases[i].place, cases[i].said);
            refused_at("main.vert", cases[i].place, cases[i].said);
        }
    testing_write("zero.vert", "int a;\nint\0b;\n", 14);
    refused_at("zero.vert", "./zero.vert:2: ", "byte 0x00: the file is not text");
}

SHADER_TEST(a_file_has_at_most_the_documented_size)
{
    char *text = malloc(SHADER_FILE_MAX + 1);
    assert_non_null(text);
    memset(text, ' ', SHADER_FILE_MAX + 1);
    memcpy(text, "int a;", 6);
    testing_write("most.vert", text, SHADER_FILE_MAX);
    testing_write("more.vert", text, SHADER_FILE_MAX + 1);
    free(text);
    found("most.vert", "./most.vert");
    refused("more.vert", formatted("./more.vert: has %d bytes", SHADER_FILE_MAX + 1), "at most ");
    make("huge.vert", "int a;");
    assert_int_equal(truncate("huge.vert", 1LL << 40), 0);
    refused("huge.vert", "./huge.vert: has 1099511627776 bytes", "");
}

/* Additions. */

SHADER_TEST(version_100_comes_first_in_any_spelling)
{
    becomes("int a;\n", "int a;\n");
    becomes("#version 100\nint a;\n", "\nint a;\n");
    becomes("// why\n  #  version\t100 \nint a;\n", "// why\n\nint a;\n");
    becomes("/*\n#version 300 es\n*/\n//#version 300\nint a;\n",
            "/*\n#version 300 es\n*/\n//#version 300\nint a;\n");
    becomes("#versions 1\n", "#versions 1\n"); /* left to the driver to reject */
    make("part.glsl", "#version 100\nint b;\n");
    becomes("#include \"part.glsl\"\n", "\nint b;\n");
}

SHADER_TEST(defines_follow_the_version_and_move_no_line)
{
    static const char *const defines[] = {"FOG", "LIGHTS 3", NULL};
    make("main.vert", "int a;\n");
    loader.defines = defines;
    found("main.vert", "./main.vert");
    text_is("#version 100\n#define FOG\n#define LIGHTS 3\nint a;\n");
}

SHADER_TEST(precision_is_overridden_in_fragment_shaders_alone)
{
    static const char text[] = "precision mediump float;\n";
    static const char *const defines[] = {"FOG", NULL};
    static const ShaderText texts[] = {{"a.frag", text}, {"a.vert", text}, {NULL, NULL}};
    static const struct {
        const char *precision, *header;
    } cases[] = {{"highp", "#version 100\n#define mediump highp\n#define FOG\n"},
                 {"mediump", "#version 100\n#define highp mediump\n#define FOG\n"},
                 {NULL, "#version 100\n#define FOG\n"}};
    loader.defines = defines;
    loader.texts = texts;
    for (size_t i = 0; i < 3; i++) {
        loader.precision = cases[i].precision;
        const char *expected = formatted("%s%s", cases[i].header, text);
        shader_source_close(&source);
        assert_true(shader_source_open(&source, &loader, "a.frag", SHADER_FRAGMENT, NULL));
        text_is(expected);
        shader_source_close(&source);
        assert_true(shader_source_open(&source, &loader, "a.vert", SHADER_VERTEX, NULL));
        text_is("#version 100\n#define FOG\nprecision mediump float;\n");
    }
}

/* Includes. */

SHADER_TEST(includes_are_searched_beside_their_file_then_in_the_folders)
{
    assert_int_equal(system("mkdir -p sub/deep common"), 0);
    make("sub/main.vert", "#include \"a.glsl\"\n#include \"deep/b.glsl\"\n");
    make("sub/a.glsl", "int beside;\n");
    make("a.glsl", "int not_this;\n");
    make("sub/deep/b.glsl", "#include \"common/c.glsl\"\n  # include  \"../a.glsl\"  // again\n");
    make("common/c.glsl", "int from_folder;\n");
    found("sub/main.vert", "./sub/main.vert");
    text_is("#version 100\nint beside;\nint from_folder;\nint beside;\n");
    assert_string_equal(source.files[1], "./sub/a.glsl");
    assert_string_equal(source.files[3], "./common/c.glsl");
}

SHADER_TEST(a_file_included_twice_appears_twice_with_one_number)
{
    make("a.glsl", "int a;\n");
    becomes("#include \"a.glsl\"\n#include \"a.glsl\"\nint b;\n", "int a;\nint a;\nint b;\n");
    assert_int_equal(source.file_count, 2);
}

/* Where an include is left out, so is the #line after it. */
SHADER_TEST(lines_after_an_include_that_is_left_out_keep_their_numbers)
{
    make("a.glsl", "int a;\nint a1;\n");
    make("main.vert", "#if 0\n#if 1\n#include \"a.glsl\"\n#endif\n#else\nint b;\n#endif\nint c;\n");
    found("main.vert", "./main.vert");
    assert_non_null(strstr(source.text, "#else\n#line 6 0\nint b;\n#endif\n#line 8 0\nint c;\n"));
}

SHADER_TEST(includes_in_comments_are_ignored)
{
    make("a.glsl", "int a;\n");
    static const char *const texts[] = {
        "/*\n#include \"missing.glsl\"\n*/\nint b;\n",
        "// #include \"missing.glsl\"\n//#include \"missing.glsl\"\n",
        "int b; /* open\n// */ int c; /* again\n#include \"missing.glsl\"\n*/\n",
        "/**/ /*/\n#include \"missing.glsl\"\n/**/\nint b;\n",
        "#includes \"missing.glsl\"\n#include_next \"missing.glsl\"\n",
        "int b; #include \"missing.glsl\"\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        becomes(texts[i], texts[i]);
    becomes("// /* no comment opens here\n#include \"a.glsl\"\n",
            "// /* no comment opens here\nint a;\n");
    becomes("/* one */ /* two */\n#include \"a.glsl\"\n", "/* one */ /* two */\nint a;\n");
}

static int count(const char *text, const char *word)
{
    int found_words = 0;
    for (const char *p = text; (p = strstr(p, word)); p += strlen(word))
        found_words++;
    return found_words;
}

SHADER_TEST(a_comment_that_opens_behind_a_directive_stays_open)
{
    static const char *const texts[] = {
        "#version 100 /* why\n#include \"missing.glsl\"\n*/\nint b;\n",
        "#include \"a.glsl\" /* why\n#include \"missing.glsl\"\n*/\nint b;\n",
    };
    make("a.glsl", "int a;\n");
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        make("main.vert", texts[i]);
        found("main.vert", "./main.vert");
        assert_int_equal(count(source.text, "/*"), 1);
        assert_int_equal(count(source.text, "*/"), 1);
    }
}

SHADER_TEST(a_file_that_includes_itself_is_refused_with_place_and_chain)
{
    make("self.vert", "int a;\n#include \"self.vert\"\n");
    refused_at("self.vert", "./self.vert:2: ", "./self.vert: includes itself");
    make("a.vert", "int a;\n#include \"b.glsl\"\n");
    make("b.glsl", "#include \"c.glsl\"\n");
    make("c.glsl", "int c;\n\n#include \"a.vert\"\n");
    refused_at("a.vert", "./c.glsl:3: ", "./a.vert: includes itself, through ./b.glsl");
    assert_non_null(strstr(strstr(failure.text, "through"), "./c.glsl"));
    make("outer.vert", "#include \"b.glsl\"\n");
    refused_at("outer.vert", "./a.vert:2: ", "./b.glsl: includes itself, through ./c.glsl");
    assert_non_null(strstr(strstr(failure.text, "through"), "./a.vert"));
}

SHADER_TEST(a_cycle_through_a_link_is_found)
{
    make("a.vert", "#include \"link.glsl\"\n");
    assert_int_equal(symlink("a.vert", "link.glsl"), 0);
    refused("a.vert", "./", "includes itself");
    assert_int_equal(mkdir("sub", 0777), 0);
    assert_int_equal(symlink("..", "sub/up"), 0);
    make("b.vert", "#include \"sub/up/b.vert\"\n");
    refused("b.vert", "./", "includes itself");
    make("hard.vert", "#include \"hard.glsl\"\n");
    assert_int_equal(link("hard.vert", "hard.glsl"), 0);
    refused("hard.vert", "./", "includes itself");
}

/* Files 0 to last, each including the next `times` times. */
static void make_chain(int last, int times)
{
    for (int i = 0; i <= last; i++) {
        char path[32], line[64], text[1024] = "int a;\n";
        snprintf(path, sizeof path, "chain%d.glsl", i);
        snprintf(line, sizeof line, "#include \"chain%d.glsl\"\n", i + 1);
        for (int j = 0; j < times && i < last; j++)
            strcat(text, line);
        make(path, text);
    }
}

SHADER_TEST(includes_nest_31_deep_and_no_deeper)
{
    make_chain(40, 1);
    found("chain9.glsl", "./chain9.glsl"); /* 32 files: 9 to 40 */
    refused_at("chain8.glsl", "./chain39.glsl:2: ", "more than 32 deep");
}

SHADER_TEST(exponential_includes_are_rejected_quickly)
{
    make_chain(25, 2); /* 2^25 copies of the last */
    const clock_t start = clock();
    refused("chain0.glsl", "./chain", "");
    /* Processor time, independent of other processes. */
    assert_true((double)(clock() - start) / CLOCKS_PER_SEC < 5);
}

TEST_MAIN("shader source", NULL, NULL)
