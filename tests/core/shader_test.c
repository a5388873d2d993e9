/*
 * shader: finding, including and numbering files; mapping the driver's messages to their lines. The
 * first group needs no driver.
 */
#include "core/canvas.h"
#include "core/shader_source.h"
#include "core/shader.h"
#include "core/shader_files.h"
#include "support/testing.h"

#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static unsigned seed;

static ShaderLoader loader;
static ShaderFiles kept; /* the loader's cache, if a test wants one */
static ShaderSource source;
static Message message;

static int enter_folder(void **state)
{
    unsetenv("LIGHTING_SHADERS");
    loader = (ShaderLoader){.folder = "."};
    return testing_enter_folder(state);
}

static int leave_folder(void **state)
{
    shader_source_close(&source);
    shader_files_close(&kept);
    return testing_leave_folder(state);
}

#define SHADER_TEST(name) TEST_WITH(0, name, enter_folder, leave_folder)
#define DRIVER_TEST(name) TEST_WITH(1, name, enter_folder, leave_folder)

static void make(const char *path, const char *text)
{
    testing_write(path, text, strlen(text));
}

static bool load(const char *name)
{
    shader_source_close(&source);
    message = (Message){0};
    return shader_source_open(&source, &loader, name, SHADER_VERTEX, &message);
}

static void found(const char *name, const char *path)
{
    if (!load(name))
        fail_msg("%s: %s", name, message.text);
    assert_string_equal(source.files[0], path);
    assert_int_equal(source.size, strlen(source.text));
}

/* Fails with a message that begins with `start` and contains `said`; nothing is left to close. */
static void refused(const char *name, const char *start, const char *said)
{
    if (load(name))
        fail_msg("accepted: %s", name);
    if (strncmp(message.text, start, strlen(start)) != 0 || !strstr(message.text, said))
        fail_msg("%s: expected \"%s... %s\" in \"%s\"", name, start, said, message.text);
    assert_null(source.text);
    assert_null(source.files);
}

/* The same with a location, "file:line: ". */
static void refused_at(const char *name, const char *place, const char *said)
{
    refused(name, place, said);
    assert_true(message.located);
}

/* Drops empty lines and #line directives, which other tests check. */
static char *squeeze(const char *text)
{
    char *plain = calloc(1, strlen(text) + 1);
    assert_non_null(plain);
    for (const char *p = text; *p; p += strcspn(p, "\n") + 1)
        if (*p != '\n' && strncmp(p, "#line ", 6) != 0)
            strncat(plain, p, strcspn(p, "\n") + 1);
    return plain;
}

/* The driver gets this text, which ends with a newline. */
static void text_is(const char *expected)
{
    char *plain = squeeze(source.text), *wanted = squeeze(expected);
    assert_string_equal(plain, wanted);
    free(plain);
    free(wanted);
}

/* The text after preprocessing, without #version. */
static void becomes(const char *text, const char *body)
{
    char expected[1024];
    make("main.vert", text);
    snprintf(expected, sizeof expected, "#version 100\n%s", body);
    found("main.vert", "./main.vert");
    text_is(expected);
}

/* A driver's location of a line: source string and line number. */
static void driver_place(const char *line, int *file, int *number)
{
    *file = 0;
    *number = 1;
    for (const char *p = source.text; p < line; p += strcspn(p, "\n") + 1)
        if (sscanf(p, "#line %d %d", number, file) != 2)
            ++*number;
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
    char last[PATH_MAX + 16];
    snprintf(last, sizeof last, "\n  tried %s", testing_source("shaders/lecture/nope.vert"));
    const char *const tried[] = {"\n  tried one/lecture/nope.vert", "\n  tried one/nope.vert",
                                 "\n  tried two/lecture/nope.vert", "\n  tried two/nope.vert",
                                 last};
    loader.folder = "one";
    setenv("LIGHTING_SHADERS", "two", 1);
    refused("lecture/nope.vert", "lecture/nope.vert: no such shader file", "");
    const char *p = message.text;
    for (int i = 0; i < 5; i++) {
        p = strstr(p, tried[i]);
        if (!p)
            fail_msg("not listed in its place: %s in %s", tried[i], message.text);
    }
    /* And two of an installation. */
    int lines = 0;
    for (p = message.text; (p = strstr(p, "\n  tried ")); p++)
        lines++;
    assert_int_equal(lines, 7);
}

SHADER_TEST(an_absolute_path_is_tried_alone)
{
    char path[128];
    snprintf(path, sizeof path, "%s/here.vert", testing_folder);
    make("here.vert", "int a;\n");
    found(path, path);
    refused("/missing/a.vert", "/missing/a.vert: no such shader file\n  tried /missing/a.vert", "");
    assert_null(strstr(strstr(message.text, "tried") + 1, "tried"));
}

SHADER_TEST(missing_folders_are_named)
{
    message = (Message){0};
    assert_true(shader_loader_check(&loader, &message));
    loader.folder = "nowhere";
    assert_false(shader_loader_check(&loader, &message));
    assert_string_equal(message.text, "nowhere: no such shader folder");
    make("file", "text");
    loader.folder = "file";
    assert_false(shader_loader_check(&loader, NULL));
    loader.folder = NULL;
    assert_true(shader_loader_check(&loader, NULL));
    message = (Message){0};
    setenv("LIGHTING_SHADERS", "nowhere", 1);
    assert_false(shader_loader_check(&loader, &message));
    assert_non_null(strstr(message.text, "LIGHTING_SHADERS=nowhere: there is no such folder"));
    setenv("LIGHTING_SHADERS", "", 1);
    assert_true(shader_loader_check(&loader, NULL));
}

static int load_as_nobody(void)
{
    if (!testing_drop_root())
        return 1;
    return !load("secret.vert") && strstr(message.text, "./secret.vert: Permission denied") ? 0 : 2;
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
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (const char *const *text = cases[i].texts; *text; text++) {
            make("part.glsl", *text);
            refused_at("part.glsl", cases[i].place, cases[i].said);
            refused_at("main.vert", cases[i].place, cases[i].said);
        }
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
    char said[64];
    snprintf(said, sizeof said, "./more.vert: has %d bytes", SHADER_FILE_MAX + 1);
    refused("more.vert", said, "at most ");
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
        char expected[256];
        loader.precision = cases[i].precision;
        snprintf(expected, sizeof expected, "%s%s", cases[i].header, text);
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
    assert_non_null(strstr(strstr(message.text, "through"), "./c.glsl"));
    make("outer.vert", "#include \"b.glsl\"\n");
    refused_at("outer.vert", "./a.vert:2: ", "./b.glsl: includes itself, through ./c.glsl");
    assert_non_null(strstr(strstr(message.text, "through"), "./a.vert"));
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

/* Files of random text, each including some later ones, with line ends of all kinds. Each line
 * states its location, except for an optional broken one. */
enum { FILES = 6, MAX_LINES = 12 };

static void make_tree(int broken_file, int broken_line, const char *broken)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (int file = 0; file < FILES; file++) {
        const char *end = ends[rand() % 3];
        char path[32], text[2048] = "";
        strcat(strcat(text, "// the first line"), end);
        for (int line = 2; line <= MAX_LINES; line++) {
            const int choice = rand() % 6, next = file + 1 + rand() % FILES;
            char *to = text + strlen(text);
            const size_t room = sizeof text - strlen(text);
            if (file == broken_file && line == broken_line)
                snprintf(to, room, "%s%s", broken, end);
            else if (choice == 0 && next < FILES)
                snprintf(to, room, "#include \"part%d.glsl\"%s", next, end);
            else if (choice == 1)
                snprintf(to, room, "%s", end);
            else if (choice == 2)
                snprintf(to, room, "#version 100%s", end);
            else
                snprintf(to, room, "%s @%d:%d%s%s", choice == 3 ? "/*" : "//", file, line,
                         choice == 3 ? " */" : "", end);
        }
        snprintf(path, sizeof path, "part%d.glsl", file);
        make(path, text);
    }
}

/* The driver's log. */

static void parse(const char *text)
{
    shader_source_close(&source);
    message = (Message){0};
    const ShaderText made[] = {{"main.vert", text}, {NULL, NULL}};
    loader.texts = made;
    const bool done = shader_source_open(&source, &loader, "main.vert", SHADER_VERTEX, &message);
    loader.texts = NULL;
    if (!done)
        fail_msg("%s", message.text);
}

/* Formats of locations: Mesa, ANGLE, NVIDIA. */
static const char *const PLACES[] = {"%d:%d(7): error: %s\n", "ERROR: %d:%d: %s\n",
                                     "%d(%d) : error C1008: %s\n"};

SHADER_TEST(driver_lines_are_mapped_to_file_and_line)
{
    srand(seed);
    int checked = 0;
    for (int round = 0; round < 10; round++) {
        int file, line, said_file, said_line;
        make_tree(-1, 0, "");
        found("part0.glsl", "./part0.glsl");
        for (const char *p = source.text; *p; p += strcspn(p, "\n") + 1) {
            const int length = (int)strcspn(p, "\n");
            const char *mark = memchr(p, '@', (size_t)length);
            if (!mark || sscanf(mark, "@%d:%d", &said_file, &said_line) != 2)
                continue;
            char log[64], start[32], shown[64];
            driver_place(p, &file, &line);
            snprintf(log, sizeof log, PLACES[checked++ % 3], file, line, "what is wrong");
            snprintf(start, sizeof start, "./part%d.glsl:%d: ", said_file, said_line);
            snprintf(shown, sizeof shown, "what is wrong\n  %d | %.*s", said_line, length, p);
            message = (Message){0};
            assert_false(shader_explain_log(&source, log, &message));
            if (strncmp(message.text, start, strlen(start)) != 0 || !strstr(message.text, shown))
                fail_msg("%s for %s%s", message.text, start, shown);
            assert_true(message.located);
        }
    }
    assert_true(checked > 100);
}

SHADER_TEST(log_lines_without_a_location_are_kept)
{
    static const char *const logs[] = {"out of memory",
                                       "9:1(1): error: no such string",
                                       "-1:1(1): error: e",
                                       "0:99(1): error: beyond the end",
                                       "0:0(1): error: e",
                                       "0:-5(1): error: e",
                                       "99999999999:1(1): e",
                                       "0:99999999999(1): e",
                                       "0:\n3(1): two lines",
                                       "%s%n %d",
                                       "(1): e",
                                       "ERROR: 2 compilation errors."};
    for (size_t i = 0; i < sizeof logs / sizeof logs[0]; i++) {
        parse("int a;\nint b;\n");
        assert_false(shader_explain_log(&source, logs[i], &message));
        const char *rest = strchr(logs[i], ' ');
        if (!strstr(message.text, rest ? rest : logs[i]))
            fail_msg("\"%s\" became \"%s\"", logs[i], message.text);
    }
}

/* Reads both stages, of which these are the bodies, as if a driver had refused one. */
static const char *hint(const char *vertex, const char *fragment, int refused, const char *said)
{
    ShaderSource both[2];
    const ShaderText texts[] = {{"a.vert", vertex}, {"a.frag", fragment}, {NULL, NULL}};
    const ShaderLoader own = {.texts = texts, .only_texts = true};
    message = (Message){0};
    assert_true(shader_source_open(&both[0], &own, "a.vert", SHADER_VERTEX, &message));
    assert_true(shader_source_open(&both[1], &own, "a.frag", SHADER_FRAGMENT, &message));
    message_set(&message, "%s", said);
    shader_advise(both, refused, &message);
    shader_source_close(&both[0]);
    shader_source_close(&both[1]);
    return message.text;
}

#define V                                                                                          \
    "attribute vec4 a_P;\nvarying vec3 v_N;\nvoid main() { v_N = a_P.xyz; gl_Position = a_P; }\n"
#define F(body) "precision highp float;\nvarying vec3 v_N;\nvoid main() {\n" body "\n}\n"

SHADER_TEST(a_hint_follows_the_drivers_first_line_and_quote)
{
    assert_string_equal(
        hint(V, F("gl_FragColor = v_N;"), SHADER_FRAGMENT,
             "a.frag:4: no\n  4 | gl_FragColor = v_N;\na.frag:4: more"),
        "a.frag:4: no\n  4 | gl_FragColor = v_N;\n  hint: gl_FragColor is a vec4, v_N a "
        "vec3: write vec4(v_N, 1.0), or 0.0 for a direction\na.frag:4: more");
    assert_string_equal(
        hint(V, F("float a = max(v_N.x, 0);"), SHADER_FRAGMENT, "refused"),
        "refused\n  hint: a.frag:4: max(v_N.x, 0): v_N.x is a float, 0 an int: write 0.0");
    assert_string_equal(hint(V, F(""), SHADER_FRAGMENT, "refused"), "refused");
    assert_string_equal(hint("float f;", F(""), SHADER_VERTEX, "no main"),
                        "no main\n  hint: a.vert:1: a function `void main()` is missing");
}

SHADER_TEST(macros_that_grow_come_to_no_driver)
{
    char text[2000] = "#define A0 1.0\n";
    for (int i = 1; i < 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "#define A%d A%d + A%d\n", i,
                 i - 1, i - 1);
    strcat(text, "const float a = A39;\n");
    parse(text);
    assert_false(shader_bounded(&source, SHADER_VERTEX, 0, &message));
    assert_non_null(strstr(message.text, ":41: error: "));
}

SHADER_TEST(functions_that_double_come_to_no_driver)
{
    char text[8000] = "float f0() { return 1.0; }\n";
    for (int i = 1; i < 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "float f%d() { return f%d() + f%d(); }\n", i, i - 1, i - 1);
    strcat(text, "void main() { gl_Position = vec4(f39()); }\n");
    parse(text);
    assert_false(shader_bounded(&source, SHADER_VERTEX, 0, &message));
    assert_non_null(strstr(message.text, ":41: error: with each function put"));
}

SHADER_TEST(what_does_not_link_is_explained)
{
    static const char other[] =
        "precision highp float;\nvarying vec4 v_N;\nvoid main() { gl_FragColor = v_N; }\n";
    static const char none[] =
        "precision highp float;\nvarying vec4 v_M;\nvoid main() { gl_FragColor = v_M; }\n";
    assert_string_equal(
        hint(V, other, SHADER_LINKING, "no"),
        "no\n  hint: a.frag:2: v_N is vec4 here and vec3 in the vertex shader: declare it "
        "alike in both");
    assert_non_null(strstr(hint(V, none, SHADER_LINKING, "no"),
                           "a.frag:2: the vertex shader has no varying v_M"));
    assert_string_equal(hint(V, F("gl_FragColor = vec4(v_N, 1.0);"), SHADER_LINKING, "no"), "no");
    assert_non_null(
        strstr(hint("uniform float u;\n" V,
                    "uniform mediump float u;\nvoid main() { gl_FragColor = vec4(u); }\n",
                    SHADER_LINKING, "no"),
               "another precision"));
}

SHADER_TEST(what_a_driver_says_of_a_missing_main_has_a_file)
{
    parse("void mian() {}\n");
    shader_explain_log(&source, "ERROR: -1:-1: '' : Missing main()\n", &message);
    assert_non_null(strstr(message.text, ": '' : Missing main()"));
    assert_null(strstr(message.text, "-1"));
}

/* What NVIDIA 580.159 wrote: of products it lists all there are, and a link's log has a heading. */
SHADER_TEST(nvidias_logs_have_a_file_and_no_lists)
{
    static const struct {
        const char *log, *said;
    } cases[] = {
        {"Fragment info\n-------------\n0(2) : error C3002: call to undefined function "
         "\"float f();\"\n",
         "a.frag:2: error C3002: call to undefined function \"float f();\"\n  2 | varying vec3 v_N;"},
        {"Fragment info\n-------------\n(0) : error C3001: no program defined\n",
         "a.frag: error C3001: no program defined"},
        {"Vertex info\n-----------\n(0) : error C3001: no program defined\n",
         "a.vert: error C3001: no program defined"},
        {"Vertex info\n-----------\nerror: type mismatch between shaders for uniform (named v_N)\n",
         "a.frag:2: linking: error: type mismatch between shaders for uniform (named v_N)\n"
         "  2 | varying vec3 v_N;"},
        {"error: too much\n\n", "a.vert, a.frag: linking: error: too much"}};
    ShaderSource both[2];
    const ShaderText texts[] = {{"a.vert", V}, {"a.frag", F("")}, {NULL, NULL}};
    const ShaderLoader own = {.texts = texts, .only_texts = true};
    assert_true(shader_source_open(&both[0], &own, "a.vert", SHADER_VERTEX, &message));
    assert_true(shader_source_open(&both[1], &own, "a.frag", SHADER_FRAGMENT, &message));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char log[256];
        snprintf(log, sizeof log, "%s", cases[i].log);
        message = (Message){0};
        assert_false(shader_explain_link(both, log, &message));
        assert_string_equal(message.text, cases[i].said);
    }
    message = (Message){0};
    shader_explain_log(&both[0],
                       "0(2) : error C1101: ambiguous \"mul(mat4, vec3)\"\n"
                       "    (0) : gp5 mediump mat3x4 mul(mediump mat3x1, mediump mat1x4)\n"
                       "    (0) : mat3 mul(mat3x1, ma",
                       &message);
    assert_null(strstr(message.text, "mat3x1"));
    message = (Message){0};
    shader_explain_log(&both[1], "(0) : error C0000: unexpected $end\n", &message);
    assert_string_equal(message.text, "a.frag: error C0000: unexpected $end");
    shader_source_close(&both[0]);
    shader_source_close(&both[1]);
}

SHADER_TEST(every_line_of_a_log_is_mapped_and_the_first_is_quoted)
{
    char log[128];
    int file, line;
    make("a.glsl", "// one\nint a;\n");
    make("main.vert", "int b;\n#include \"a.glsl\"\nint c;\n");
    found("main.vert", "./main.vert");
    driver_place(strstr(source.text, "int a;"), &file, &line);
    int used = snprintf(log, sizeof log, "\n%d:%d(1): warning: w\n", file, line);
    driver_place(strstr(source.text, "int c;"), &file, &line);
    snprintf(log + used, sizeof log - (size_t)used, "%d:%d(2): error: e\nerror: too many", file,
             line);
    shader_explain_log(&source, log, &message);
    assert_string_equal(message.text, "./a.glsl:2: warning: w\n  2 | int a;\n"
                                      "./main.vert:3: error: e\nerror: too many");
    assert_true(message.located);
}

SHADER_TEST(an_earlier_message_stays)
{
    parse("int a;\n");
    message_set(&message, "the cause");
    shader_explain_log(&source, "0:2(1): error: e", &message);
    assert_string_equal(message.text, "the cause");
    assert_false(message.located);
    assert_false(shader_explain_log(&source, "0:1(1): error: e", NULL));
}

SHADER_TEST(long_lines_and_logs_are_cut)
{
    static char text[20000], log[20000];
    int file, line;
    memset(text, 'x', sizeof text - 1);
    parse(text);
    driver_place(strchr(source.text, 'x'), &file, &line);
    snprintf(log, sizeof log, "%d:%d(1): ", file, line);
    shader_explain_log(&source, log, &message);
    assert_non_null(strstr(message.text, "  1 | xxx"));
    assert_true(strlen(message.text) < 300);
    memset(log + strlen(log), 'y', sizeof log - strlen(log) - 1);
    message = (Message){0};
    shader_explain_log(&source, log, &message);
    assert_int_equal(strlen(message.text), sizeof message.text - 1);
}

SHADER_TEST(a_line_of_a_large_shader_is_found_quickly)
{
    enum { LAST = SHADER_FILE_MAX / 2, SIZE = 2 * LAST };
    char *text = malloc(SIZE + 1), log[64], said[64];
    int file, line;
    assert_non_null(text);
    for (int i = 0; i < SIZE; i++)
        text[i] = i % 2 ? '\n' : ';';
    text[SIZE - 2] = '@';
    text[SIZE] = '\0';
    parse(text);
    free(text);
    /* Without driver_place, which is quadratic itself. */
    file = 0;
    line = strstr(source.text, "#line ") ? LAST : LAST + 1;
    snprintf(log, sizeof log, "%d:%d(1): error: e", file, line);
    snprintf(said, sizeof said, "main.vert:%d: error: e\n  %d | @", LAST, LAST);
    const clock_t start = clock();
    shader_explain_log(&source, log, &message);
    assert_string_equal(message.text, said);
    /* Processor time, independent of other processes; one pass takes milliseconds. */
    assert_true((double)(clock() - start) / CLOCKS_PER_SEC < 2);
}

/* With a driver. */

static Canvas canvas;

static const char FRAGMENT[] = "void main() {\n    gl_FragColor = vec4(1.0);\n}\n";
static const char VERTEX[] = "attribute vec4 a_Position;\nvoid main() {\n"
                             "    gl_Position = a_Position;\n}\n";

static bool open_program(Shader *shader)
{
    message = (Message){0};
    return shader_open(shader, &loader, "main", &message);
}

/* main.vert and main.frag do not compile or link; the message begins with `start` and contains the
 * line `shown` unless that is NULL. */
static void program_refused(const char *vertex, const char *fragment, const char *start,
                            const char *shown)
{
    Shader shader;
    make("main.vert", vertex);
    make("main.frag", fragment);
    if (open_program(&shader))
        fail_msg("accepted: %s\n%s", vertex, fragment);
    if (strncmp(message.text, start, strlen(start)) != 0)
        fail_msg("expected to begin \"%s\": %s", start, message.text);
    if (shown && !strstr(message.text, shown))
        fail_msg("expected to show \"%s\": %s", shown, message.text);
    assert_int_equal(message.located, shown != NULL);
    assert_int_equal(shader.program, 0);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

DRIVER_TEST(a_broken_line_is_named_in_any_file)
{
    static const char *const defines[] = {"FOG", "LIGHTS 3", NULL};
    static const char *const broken[] = {
        "int wrong = nothing_here;", "int wrong = ;", "#error on purpose",
        "vec4 wrong() { return vec3(1.0); }"}; /* semantics, grammar, preprocessor, types */
    srand(seed);
    for (int round = 0; round < 40; round++) {
        const char *line = broken[round % 4];
        const int file = rand() % FILES, number = 2 + rand() % (MAX_LINES - 1);
        char fragment[256], start[64], shown[64];
        make_tree(file, number, line);
        snprintf(
            fragment, sizeof fragment,
            "%sprecision highp float;\n#include \"part0.glsl\"\n\n#include \"part%d.glsl\"\n%s",
            rand() % 2 ? "#version 100\n" : "", file, FRAGMENT);
        snprintf(start, sizeof start, "./part%d.glsl:%d: ", file, number);
        snprintf(shown, sizeof shown, "\n  %d | %s", number, line);
        loader.defines = rand() % 2 ? defines : NULL;
        loader.precision = rand() % 2 ? "mediump" : NULL;
        program_refused(VERTEX, fragment, start, shown);
    }
}

DRIVER_TEST(a_link_error_is_named_at_the_declaration)
{
    static const char vertex[] = "attribute vec4 a_Position;\nvarying vec4 v_First;\n"
                                 "varying vec3 v_Second;\nvoid main() {\n"
                                 "    gl_Position = a_Position;\n    v_First = a_Position;\n"
                                 "    v_Second = a_Position.xyz;\n}\n";
    /* A type mismatch; the first varying, which is correct, has a type named in the log. */
    program_refused(vertex,
                    "precision mediump float;\n\nvarying vec4 v_First;\nvarying vec4 v_Second;\n"
                    "void main() {\n    gl_FragColor = v_First + v_Second;\n}\n",
                    "./main.frag:4: linking: ", "  4 | varying vec4 v_Second;");
    /* Not in the vertex shader, and declared in an include. */
    make("varyings.glsl", "varying vec4 v_First;\n\nvarying vec4 v_Missing;\n");
    program_refused(vertex,
                    "precision mediump float;\n#include \"varyings.glsl\"\nvoid main() {\n"
                    "    gl_FragColor = v_First + v_Missing;\n}\n",
                    "./varyings.glsl:3: linking: ", "  3 | varying vec4 v_Missing;");
    /* A uniform of two types. */
    program_refused("uniform vec3 u_Color;\nvoid main() {\n"
                    "    gl_Position = vec4(u_Color, 1.0);\n}\n",
                    "precision mediump float;\nuniform vec4 u_Color;\nvoid main() {\n"
                    "    gl_FragColor = u_Color;\n}\n",
                    "./main.frag:2: linking: ", "  2 | uniform vec4 u_Color;");
    /* No variable is named. */
    program_refused(VERTEX, "precision mediump float;\nvoid other() {\n}\n",
                    "./main.vert, ./main.frag: linking: ", NULL);
}

DRIVER_TEST(line_directives_of_the_shader_itself_do_no_harm)
{
    static const char *const directives[] = {"#line 5",
                                             "#line 5 0",
                                             "#line 5 1000000",
                                             "#line 2147483647 3",
                                             "/*\n#line 5 1000000\n*/",
                                             "/**/ #line 5 1000000"};
    for (size_t i = 0; i < sizeof directives / sizeof directives[0]; i++) {
        char fragment[256];
        Shader shader;
        make("main.vert", VERTEX);
        snprintf(fragment, sizeof fragment,
                 "precision mediump float;\n%s\nvarying vec4 v_Missing;\nvoid main() {\n"
                 "    gl_FragColor = v_Missing;\n}\n",
                 directives[i]);
        make("main.frag", fragment);
        assert_false(open_program(&shader));
        assert_non_null(strstr(message.text, "v_Missing"));
        snprintf(fragment, sizeof fragment, "%s\nwrong;\n%s", directives[i], FRAGMENT);
        make("main.frag", fragment);
        assert_false(open_program(&shader));
        assert_true(message.text[0] != '\0');
    }
}

DRIVER_TEST(a_missing_variable_is_named_with_its_program)
{
    Shader shader;
    GLint location = 7;
    make("main.vert", "attribute vec4 a_Color;\nattribute vec4 a_Position;\n"
                      "uniform vec4 u_Used, u_Unused;\nvoid main() {\n"
                      "    gl_Position = a_Position + a_Color + u_Used;\n}\n");
    make("main.frag", FRAGMENT);
    require(open_program(&shader), &message);
    assert_string_equal(shader.name, "main");
    assert_true(shader_attribute(&shader, "a_Position", &location, NULL));
    assert_int_equal(location, 0); /* in any order of declaration */
    assert_true(shader_attribute(&shader, "a_Color", &location, NULL));
    assert_true(location > 0);
    assert_true(shader_uniform(&shader, "u_Used", &location, NULL));
    assert_true(location >= 0);

    assert_false(shader_uniform(&shader, "u_Unused", &location, &message));
    assert_non_null(strstr(message.text, "main: the linked program has no uniform u_Unused"));
    message = (Message){0};
    assert_false(shader_uniform(&shader, "u_Nope", &location, &message));
    assert_non_null(strstr(message.text, "main: the linked program has no uniform u_Nope"));
    message = (Message){0};
    assert_false(shader_attribute(&shader, "a_Nope", &location, &message));
    assert_non_null(strstr(message.text, "main: the linked program has no attribute a_Nope"));

    shader_close(&shader);
    assert_int_equal(shader.program, 0);
    shader_close(&shader);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

DRIVER_TEST(a_missing_variable_is_a_warning_if_the_loader_has_one)
{
    Shader shader;
    GLint locations[4];
    const ShaderLocation wanted[] = {{"a_Position", &locations[0]},
                                     {"u_Unused", &locations[1]},
                                     {"u_LightColor", &locations[2]},
                                     {"u_Scale", &locations[3]},
                                     {NULL, NULL}};
    Message warning = {0};
    make("main.vert", "attribute vec4 a_Position;\nuniform vec4 u_LightColour, u_Unused;\n"
                      "uniform float u_Other;\nvoid main() {\n"
                      "    gl_Position = a_Position * u_Other + u_LightColour;\n}\n");
    make("main.frag", FRAGMENT);
    require(open_program(&shader), &message);
    assert_false(shader_locations(&shader, wanted, &message));
    assert_non_null(strstr(message.text, "main: the linked program has no uniform u_Unused"));
    shader_close(&shader);

    loader.warning = &warning;
    require(open_program(&shader), &message);
    assert_true(shader_locations(&shader, wanted, &message));
    assert_string_equal(message.text, "");
    assert_string_equal(warning.text, "./main.vert:2: warning: u_Unused is not used, "
                                      "u_LightColour: u_LightColor?, u_Scale is not declared");
    assert_true(warning.located);
    assert_int_equal(locations[0], 0);
    for (int i = 1; i < 4; i++)
        assert_int_equal(locations[i], -1);
    /* As the lecture's programs use them. */
    glUseProgram(shader.program);
    shader_set_vec3(locations[2], (Vec3){1, 1, 1});
    shader_set_mat4(locations[2], mat4_identity());
    shader_set_attribute(locations[2], (Vec3){1, 1, 1});
    assert_int_equal(glGetError(), GL_NO_ERROR);
    shader_close(&shader);
}

/* The cache of files. */

/* The requested paths. */
static void asked_for(const char *const *paths, int count)
{
    for (int i = 0; i < count && i < kept.count; i++)
        assert_string_equal(kept.files[i].path, paths[i]);
    assert_int_equal(kept.count, count);
}

static void changed(const char *path)
{
    const char *found_path = shader_files_changed(&kept);
    if (!found_path)
        fail_msg("%s has not changed", path);
    assert_string_equal(found_path, path);
}

SHADER_TEST(the_cache_keeps_what_was_read_or_missed)
{
    static const char *const asked[] = {"one/a/main.vert", "one/main.vert", "one/part.glsl",
                                        "two/part.glsl", "one/more.glsl"};
    assert_int_equal(system("mkdir -p one/a two"), 0);
    make("one/main.vert", "#include \"part.glsl\"\nint a;\n");
    make("two/part.glsl", "int b;\n");
    loader.folder = "one";
    loader.files = &kept;
    setenv("LIGHTING_SHADERS", "two", 1);
    found("a/main.vert", "one/main.vert");
    text_is("#version 100\nint b;\nint a;\n");
    asked_for(asked, 4);
    assert_null(shader_files_changed(&kept));

    /* Edited, removed, and created where it would be found earlier. */
    make("one/main.vert", "int c;\n");
    assert_int_equal(unlink("two/part.glsl"), 0);
    make("one/a/main.vert", "int d;\n");
    for (int i = 0; i < 2; i++) {
        found("a/main.vert", "one/main.vert");
        text_is("#version 100\nint b;\nint a;\n");
        asked_for(asked, 4);
    }
    loader.files = NULL;
    found("a/main.vert", "one/a/main.vert");
    text_is("#version 100\nint d;\n");

    /* Files not requested before come from disk. */
    loader.files = &kept;
    make("one/more.glsl", "int e;\n");
    found("more.glsl", "one/more.glsl");
    asked_for(asked, 5);
    shader_files_close(&kept);
    assert_int_equal(kept.count, 0);
}

SHADER_TEST(only_changed_contents_are_a_change)
{
    make("main.vert", "#include \"part.glsl\"\n");
    make("part.glsl", "int b;\n");
    assert_int_equal(mkdir("sub", 0777), 0);
    loader.folder = "sub";
    loader.files = &kept;
    setenv("LIGHTING_SHADERS", ".", 1);
    found("main.vert", "./main.vert");
    static const char *const asked[] = {"sub/main.vert", "./main.vert", "./part.glsl"};
    asked_for(asked, 3);

    make("part.glsl", "int c;\n");
    changed("./part.glsl");
    make("main.vert", "int c;\n");
    changed("./main.vert");
    make("main.vert", "#include \"part.glsl\"\n");
    changed("./part.glsl");
    /* Rewritten with the same text, as another file, with another date: no change. */
    make("new", "int b;\n");
    assert_int_equal(rename("new", "part.glsl"), 0);
    assert_int_equal(chmod("part.glsl", 0600), 0);
    assert_null(shader_files_changed(&kept));
    make("part.glsl", "int b;\n ");
    changed("./part.glsl");
    testing_write("part.glsl", "int b;\n\0", 8);
    changed("./part.glsl");
    assert_int_equal(unlink("part.glsl"), 0);
    changed("./part.glsl");
    assert_int_equal(mkdir("part.glsl", 0777), 0);
    changed("./part.glsl");
    assert_int_equal(rmdir("part.glsl"), 0);
    make("part.glsl", "int b;\n");
    assert_null(shader_files_changed(&kept));
    make("sub/main.vert", "");
    changed("sub/main.vert");
    assert_int_equal(unlink("sub/main.vert"), 0);
    assert_int_equal(symlink("../main.vert", "sub/main.vert"), 0);
    changed("sub/main.vert");
    assert_int_equal(system("rm -r sub"), 0);
    assert_null(shader_files_changed(&kept)); /* it was missing before, too */
    shader_files_close(&kept);

    /* An unreadable file is unchanged while the reason is the same. */
    assert_int_equal(mkdir("folder.vert", 0777), 0);
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    assert_null(shader_files_changed(&kept));
    assert_int_equal(rmdir("folder.vert"), 0);
    changed("./folder.vert");
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    shader_files_close(&kept);
}

SHADER_TEST(replacements_are_cached_and_texts_in_memory_are_not)
{
    static const ShaderText texts[] = {{"made.glsl", "int m;\n"}, {NULL, NULL}};
    static const ShaderReplacement replacements[] = {{"old.glsl", "new.glsl"}, {NULL, NULL}};
    static const char *const asked[] = {"./main.vert", "./new.glsl"};
    make("main.vert", "#include \"made.glsl\"\n#include \"old.glsl\"\n");
    make("made.glsl", "int o;\n");
    make("old.glsl", "int o;\n");
    make("new.glsl", "int n;\n");
    loader.texts = texts;
    loader.replacements = replacements;
    loader.files = &kept;
    for (int i = 0; i < 2; i++) {
        found("main.vert", "./main.vert");
        text_is("#version 100\nint m;\nint n;\n");
        asked_for(asked, 2);
        make("made.glsl", "int x;\n");
        make("old.glsl", "int x;\n");
        assert_null(shader_files_changed(&kept));
        make("new.glsl", "int x;\n");
        changed("./new.glsl");
        make("new.glsl", "int n;\n");
    }
    shader_files_close(&kept);
}

SHADER_TEST(a_later_cycle_does_not_harm_the_cache)
{
    make("a.vert", "#include \"b.glsl\"\n");
    make("b.glsl", "int b;\n");
    loader.files = &kept;
    found("a.vert", "./a.vert");
    assert_int_equal(unlink("b.glsl"), 0);
    assert_int_equal(symlink("a.vert", "b.glsl"), 0);
    changed("./b.glsl");
    found("a.vert", "./a.vert");
    text_is("#version 100\nint b;\n");
    shader_files_close(&kept);
    refused("a.vert", "./", "includes itself");
    shader_files_close(&kept);
}

SHADER_TEST(a_folder_created_or_removed_is_a_change)
{
    loader = (ShaderLoader){.folder = "mine", .files = &kept};
    assert_false(shader_loader_check(&loader, NULL));
    assert_null(shader_files_changed(&kept));
    assert_int_equal(mkdir("mine", 0777), 0);
    changed("mine");
    shader_files_close(&kept);
    assert_true(shader_loader_check(&loader, NULL));
    assert_null(shader_files_changed(&kept));
    assert_int_equal(rmdir("mine"), 0);
    changed("mine");
    shader_files_close(&kept);
}

SHADER_TEST(closing_nothing_is_fine)
{
    Shader zeroed = {0};
    ShaderSource empty = {0};
    shader_close(NULL);
    shader_close(&zeroed);
    shader_source_close(NULL);
    shader_source_close(&empty);
    shader_files_close(NULL);
    shader_files_close(&(ShaderFiles){0});
}

int main(void)
{
    const char *given = getenv("LIGHTING_TEST_SEED");
    seed = given ? (unsigned)strtoul(given, NULL, 10) : (unsigned)time(NULL);
    printf("LIGHTING_TEST_SEED=%u\n", seed);

    int failed = testing_run(0, "shader files", NULL, NULL);
    message = (Message){0};
    if (!canvas_open(&canvas, &(CanvasOptions){.width = 4, .height = 4}, &message)) {
        printf("compiling and linking is skipped: %s\n", message.text);
        return failed ? failed : EXIT_SKIPPED;
    }
    failed += testing_run(1, "shaders in the driver", NULL, NULL);
    canvas_close(&canvas);
    return failed;
}
