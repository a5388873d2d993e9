/*
 * shader: files are found, put together and numbered; the driver's messages lead to their lines.
 * The first group needs no driver.
 */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "canvas.h"
#include "shader.h"
#include "testing.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static unsigned seed;

static ShaderLoader loader;
static ShaderFiles kept; /* what the loader reads, where a test wants that */
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

static void make_bytes(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void make(const char *path, const char *text)
{
    make_bytes(path, text, strlen(text));
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

/* Refused with a message that begins with `start` and says `said`; nothing is left to close. */
static void refused(const char *name, const char *start, const char *said)
{
    if (load(name))
        fail_msg("accepted: %s", name);
    if (strncmp(message.text, start, strlen(start)) != 0 || !strstr(message.text, said))
        fail_msg("%s: expected \"%s... %s\" in \"%s\"", name, start, said, message.text);
    assert_null(source.text);
    assert_null(source.files);
}

/* The same with a place, "file:line: ", which needs no program's name before it. */
static void refused_at(const char *name, const char *place, const char *said)
{
    refused(name, place, said);
    assert_true(message.located);
}

/* Leaves out empty lines and those that number what follows: other tests are for the numbers. */
static char *squeeze(const char *text)
{
    char *plain = calloc(1, strlen(text) + 1);
    assert_non_null(plain);
    for (const char *p = text; *p; p += strcspn(p, "\n") + 1)
        if (*p != '\n' && strncmp(p, "#line ", 6) != 0)
            strncat(plain, p, strcspn(p, "\n") + 1);
    return plain;
}

/* The driver gets this text, which ends with a line's end. */
static void text_is(const char *expected)
{
    char *plain = squeeze(source.text), *wanted = squeeze(expected);
    assert_string_equal(plain, wanted);
    free(plain);
    free(wanted);
}

/* What a file of this text becomes, after the version. */
static void becomes(const char *text, const char *body)
{
    char expected[1024];
    make("main.vert", text);
    snprintf(expected, sizeof expected, "#version 100\n%s", body);
    found("main.vert", "./main.vert");
    text_is(expected);
}

/* What a driver calls a line of the text: source string and line number. */
static void driver_place(const char *line, int *file, int *number)
{
    *file = 0;
    *number = 1;
    for (const char *p = source.text; p < line; p += strcspn(p, "\n") + 1)
        if (sscanf(p, "#line %d %d", number, file) != 2)
            ++*number;
}

/* Finding. */

static void the_folders_are_searched_in_order_by_path_and_by_name(void **state)
{
    (void)state;
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
    found("lecture/LightedCube.vert", SHADERS_SOURCE "/lecture/LightedCube.vert");
    loader.folder = NULL;
    setenv("LIGHTING_SHADERS", "", 1);
    found("lecture/LightedCube.vert", SHADERS_SOURCE "/lecture/LightedCube.vert");
}

static void a_file_name_alone_is_no_way_into_the_source_tree(void **state)
{
    (void)state;
    refused("LightedCube.vert", "LightedCube.vert: no such shader file; --shaders DIR", "tried");
}

static void every_path_that_was_tried_is_listed_in_order(void **state)
{
    (void)state;
    static const char *const tried[] = {
        "\n  tried one/lecture/nope.vert", "\n  tried one/nope.vert",
        "\n  tried two/lecture/nope.vert", "\n  tried two/nope.vert",
        "\n  tried " SHADERS_SOURCE "/lecture/nope.vert"};
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

static void an_absolute_path_is_tried_alone(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof path, "%s/here.vert", testing_folder);
    make("here.vert", "int a;\n");
    found(path, path);
    refused("/missing/a.vert", "/missing/a.vert: no such shader file",
            "names a folder\n  tried /missing/a.vert");
    assert_null(strstr(strstr(message.text, "tried") + 1, "tried"));
}

static void folders_that_are_not_there_are_named(void **state)
{
    (void)state;
    message = (Message){0};
    assert_true(shader_loader_check(&loader, &message));
    loader.folder = "nowhere";
    assert_false(shader_loader_check(&loader, &message));
    assert_string_equal(message.text, "--shaders nowhere: there is no such folder");
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
    if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0)
        return 1;
    return !load("secret.vert") && strstr(message.text, "./secret.vert: Permission denied") ? 0 : 2;
}

static void what_is_there_but_no_text_file_is_not_passed_over(void **state)
{
    (void)state;
    int status = -1;
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
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        _exit(load_as_nobody());
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

/* Text. */

static void line_ends_and_a_byte_order_mark_make_no_difference(void **state)
{
    (void)state;
    becomes("int a;\n\nint b;\n", "int a;\n\nint b;\n");
    becomes("int a;\r\n\r\nint b;\r\n", "int a;\n\nint b;\n");
    becomes("int a;\r\rint b;\r", "int a;\n\nint b;\n");
    becomes("\xEF\xBB\xBFint a;\n\nint b;", "int a;\n\nint b;\n");
    becomes("// h\xC3\xA9llo\n\tint a;\f\n", "// h\xC3\xA9llo\n\tint a;\f\n");
}

static void what_is_no_text_is_refused_with_its_line(void **state)
{
    (void)state;
    make_bytes("zero.vert", "int a;\nint\0b;\n", 14);
    refused_at("zero.vert", "./zero.vert:2: ", "byte 0x00: the file is not text");
    make("control.vert", "int a;\r\n\r\nint \x1B[31m;\n");
    refused_at("control.vert", "./control.vert:3: ", "byte 0x1B");
    make("delete.vert", "\x7F");
    refused_at("delete.vert", "./delete.vert:1: ", "byte 0x7F");
    make("png.vert", "\x89PNG\r\n\x1A\n");
    refused_at("png.vert", "./png.vert:2: ", "byte 0x1A");
    make("includes.vert", "\n#include \"zero.vert\"\n");
    refused_at("includes.vert", "./zero.vert:2: ", "byte 0x00");
}

static void an_empty_file_is_refused(void **state)
{
    (void)state;
    static const char *const empty[] = {"", "\n", " \t\r\n\r\n", "\xEF\xBB\xBF"};
    for (size_t i = 0; i < sizeof empty / sizeof empty[0]; i++) {
        make("empty.vert", empty[i]);
        refused_at("empty.vert", "./empty.vert:1: ", "the file is empty");
    }
}

static void a_file_may_have_so_many_bytes_and_not_one_more(void **state)
{
    (void)state;
    char *text = malloc(SHADER_FILE_MOST + 1);
    assert_non_null(text);
    memset(text, ' ', SHADER_FILE_MOST + 1);
    memcpy(text, "int a;", 6);
    make_bytes("most.vert", text, SHADER_FILE_MOST);
    make_bytes("more.vert", text, SHADER_FILE_MOST + 1);
    free(text);
    found("most.vert", "./most.vert");
    char said[64];
    snprintf(said, sizeof said, "./more.vert: has %d bytes", SHADER_FILE_MOST + 1);
    refused("more.vert", said, "at most ");
    make("huge.vert", "int a;");
    assert_int_equal(truncate("huge.vert", 1LL << 40), 0);
    refused("huge.vert", "./huge.vert: has 1099511627776 bytes", "");
}

/* What is added. */

static void version_100_comes_first_however_it_is_written(void **state)
{
    (void)state;
    becomes("int a;\n", "int a;\n");
    becomes("#version 100\nint a;\n", "\nint a;\n");
    becomes("// why\n  #  version\t100 \nint a;\n", "// why\n\nint a;\n");
    becomes("/*\n#version 300 es\n*/\n//#version 300\nint a;\n",
            "/*\n#version 300 es\n*/\n//#version 300\nint a;\n");
    becomes("#versions 1\n", "#versions 1\n"); /* the driver's to refuse */
    make("part.glsl", "#version 100\nint b;\n");
    becomes("#include \"part.glsl\"\n", "\nint b;\n");
}

static void any_other_version_is_refused_with_its_line(void **state)
{
    (void)state;
    static const char *const bad[] = {"#version 300 es", "#version 110", "#version 1000",
                                      "#version",        "#version es",  "# version 99"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        make("part.glsl", bad[i]);
        refused_at("part.glsl", "./part.glsl:1: ", "only #version 100");
        make("main.vert", "int a;\n#include \"part.glsl\"\n");
        refused_at("main.vert", "./part.glsl:1: ", "only #version 100");
    }
}

static void defines_follow_the_version_and_move_no_line(void **state)
{
    (void)state;
    static const char *const defines[] = {"FOG", "LIGHTS 3", NULL};
    make("main.vert", "int a;\n");
    loader.defines = defines;
    found("main.vert", "./main.vert");
    text_is("#version 100\n#define FOG\n#define LIGHTS 3\nint a;\n");
}

static void precision_is_overridden_in_fragment_shaders_alone(void **state)
{
    (void)state;
    static const char text[] = "precision mediump float;\n";
    static const char *const defines[] = {"FOG", NULL};
    static const struct {
        const char *precision, *header;
    } cases[] = {{"highp", "#version 100\n#define mediump highp\n#define FOG\n"},
                 {"mediump", "#version 100\n#define highp mediump\n#define FOG\n"},
                 {NULL, "#version 100\n#define FOG\n"}};
    loader.defines = defines;
    for (size_t i = 0; i < 3; i++) {
        char expected[256];
        loader.precision = cases[i].precision;
        snprintf(expected, sizeof expected, "%s%s", cases[i].header, text);
        shader_source_close(&source);
        assert_true(shader_source_parse(&source, &loader, "a.frag", text, strlen(text),
                                        SHADER_FRAGMENT, NULL));
        text_is(expected);
        shader_source_close(&source);
        assert_true(shader_source_parse(&source, &loader, "a.vert", text, strlen(text),
                                        SHADER_VERTEX, NULL));
        text_is("#version 100\n#define FOG\nprecision mediump float;\n");
    }
}

/* Includes. */

static void an_include_is_looked_for_beside_its_file_then_in_the_folders(void **state)
{
    (void)state;
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

static void a_file_included_twice_is_taken_in_twice_under_one_number(void **state)
{
    (void)state;
    make("a.glsl", "int a;\n");
    becomes("#include \"a.glsl\"\n#include \"a.glsl\"\nint b;\n", "int a;\nint a;\nint b;\n");
    assert_int_equal(source.file_count, 2);
}

static void includes_in_comments_are_no_includes(void **state)
{
    (void)state;
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

static void a_comment_that_opens_behind_a_directive_stays_open(void **state)
{
    (void)state;
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

static void an_include_that_names_no_file_is_refused_with_its_line(void **state)
{
    (void)state;
    static const char *const bad[] = {"#include",         "#include a.glsl", "#include <a.glsl>",
                                      "#include \"",      "#include \"\"",   "#include \"a.glsl",
                                      "#include 'a.glsl'"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[128];
        snprintf(text, sizeof text, "int a;\n\n%s", bad[i]);
        make("main.vert", text);
        refused_at("main.vert", "./main.vert:3: ", "#include needs a file's name in double quotes");
    }
    make("main.vert", "int a;\n#include \"sub/nope.glsl\"\n");
    refused_at("main.vert", "./main.vert:2: sub/nope.glsl: no such shader file",
               "\n  tried ./sub/nope.glsl");
    make("outer.vert", "#include \"main.vert\"\n");
    refused_at("outer.vert", "./main.vert:2: sub/nope.glsl: no such shader file", "");
    assert_int_equal(mkdir("folder.glsl", 0777), 0);
    make("main.vert", "#include \"folder.glsl\"\n");
    refused_at("main.vert", "./main.vert:1: ./folder.glsl: is not a regular file", "");
}

static void a_file_that_includes_itself_is_refused_with_place_and_chain(void **state)
{
    (void)state;
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

static void a_cycle_through_a_link_is_found(void **state)
{
    (void)state;
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

static void includes_nest_31_deep_and_no_deeper(void **state)
{
    (void)state;
    make_chain(40, 1);
    found("chain9.glsl", "./chain9.glsl"); /* 32 files: 9 to 40 */
    refused_at("chain8.glsl", "./chain39.glsl:2: ", "more than 32 deep");
}

static void includes_that_grow_without_bounds_are_refused_soon(void **state)
{
    (void)state;
    make_chain(25, 2); /* 2^25 copies of the last */
    const clock_t start = clock();
    refused("chain0.glsl", "./chain", "");
    /* Processor time, so that a busy machine does not matter; a student waits no longer. */
    assert_true((double)(clock() - start) / CLOCKS_PER_SEC < 5);
}

/* Files of random text, of which each includes some of those after it, with line ends of every
 * kind. Every line says where it is, but for one that is broken where that is asked for. */
enum { FILES = 6, MOST_LINES = 12 };

static void make_tree(int broken_file, int broken_line, const char *broken)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (int file = 0; file < FILES; file++) {
        const char *end = ends[rand() % 3];
        char path[32], text[2048] = "";
        strcat(strcat(text, "// the first line"), end);
        for (int line = 2; line <= MOST_LINES; line++) {
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
    if (!shader_source_parse(&source, &loader, "main.vert", text, strlen(text), SHADER_VERTEX,
                             &message))
        fail_msg("%s", message.text);
}

/* As each driver says a place: Mesa, ANGLE, NVIDIA. */
static const char *const PLACES[] = {"%d:%d(7): error: %s\n", "ERROR: %d:%d: %s\n",
                                     "%d(%d) : error C1008: %s\n"};

static void every_line_is_told_in_terms_of_its_file(void **state)
{
    (void)state;
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

static void a_log_keeps_what_has_no_place(void **state)
{
    (void)state;
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

static void every_line_of_a_log_is_told_and_the_first_is_shown(void **state)
{
    (void)state;
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

static void a_message_that_is_there_already_stays(void **state)
{
    (void)state;
    parse("int a;\n");
    message_set(&message, "the cause");
    shader_explain_log(&source, "0:2(1): error: e", &message);
    assert_string_equal(message.text, "the cause");
    assert_false(message.located);
    assert_false(shader_explain_log(&source, "0:1(1): error: e", NULL));
}

static void long_lines_and_logs_are_cut(void **state)
{
    (void)state;
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

static void a_line_of_a_large_shader_is_found_soon(void **state)
{
    (void)state;
    enum { LAST = SHADER_FILE_MOST / 2, SIZE = 2 * LAST };
    char *text = malloc(SIZE + 1), log[64], said[64];
    int file, line;
    assert_non_null(text);
    for (int i = 0; i < SIZE; i++)
        text[i] = i % 2 ? '\n' : ';';
    text[SIZE - 2] = '@';
    text[SIZE] = '\0';
    parse(text);
    free(text);
    /* Without driver_place: it reads numbers on every line, and is as slow as it must not be. */
    file = 0;
    line = strstr(source.text, "#line ") ? LAST : LAST + 1;
    snprintf(log, sizeof log, "%d:%d(1): error: e", file, line);
    snprintf(said, sizeof said, "main.vert:%d: error: e\n  %d | @", LAST, LAST);
    const clock_t start = clock();
    shader_explain_log(&source, log, &message);
    assert_string_equal(message.text, said);
    /* Processor time, so that a busy machine does not matter; one pass takes milliseconds. */
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

/* main.vert and main.frag do not become a program; the message begins with `start`, and shows the
 * line `shown` where that is not NULL. */
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

static void a_broken_line_is_named_wherever_it_stands(void **state)
{
    (void)state;
    static const char *const defines[] = {"FOG", "LIGHTS 3", NULL};
    static const char *const broken[] = {
        "int wrong = nothing_here;", "int wrong = ;", "#error on purpose",
        "vec4 wrong() { return vec3(1.0); }"}; /* meaning, grammar, preprocessor, types */
    srand(seed);
    for (int round = 0; round < 40; round++) {
        const char *line = broken[round % 4];
        const int file = rand() % FILES, number = 2 + rand() % (MOST_LINES - 1);
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

static void errors_around_an_include_have_their_own_lines(void **state)
{
    (void)state;
    make("a.glsl", "int a;\nint b;\n\nint c;\n");
    program_refused("wrong;\n#include \"a.glsl\"\nvoid main() {}\n", FRAGMENT,
                    "./main.vert:1: ", "  1 | wrong;");
    program_refused("#include \"a.glsl\"\nwrong;\nvoid main() {}\n", FRAGMENT,
                    "./main.vert:2: ", "  2 | wrong;");
    program_refused("\n#include \"a.glsl\"\n\n/* two\nlines */\nvoid main() {\n    wrong = 1;\n}\n",
                    FRAGMENT, "./main.vert:7: ", "  7 |     wrong = 1;");
    program_refused("#version 100\nvoid main() {\n\n    int a = 1.0;\n}\n", FRAGMENT,
                    "./main.vert:4: ", "  4 |     int a = 1.0;");
    program_refused(VERTEX, "\n\nprecision mediump float;\nvarying int v;\nvoid main() {}\n",
                    "./main.frag:4: ", "  4 | varying int v;");
}

static void a_link_error_is_named_at_the_declaration(void **state)
{
    (void)state;
    static const char vertex[] = "attribute vec4 a_Position;\nvarying vec4 v_First;\n"
                                 "varying vec3 v_Second;\nvoid main() {\n"
                                 "    gl_Position = a_Position;\n    v_First = a_Position;\n"
                                 "    v_Second = a_Position.xyz;\n}\n";
    /* Another type; the first varying, which is right, has a type that the driver speaks of. */
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
    /* No variable to name. */
    program_refused(VERTEX, "precision mediump float;\nvoid other() {\n}\n",
                    "./main.vert, ./main.frag: linking: ", NULL);
}

static void line_directives_of_the_shader_itself_do_no_harm(void **state)
{
    (void)state;
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

static void a_missing_file_of_a_pair_is_named(void **state)
{
    (void)state;
    Shader shader;
    make("main.vert", VERTEX);
    assert_false(open_program(&shader));
    assert_non_null(strstr(message.text, "main.frag: no such shader file"));
    assert_int_equal(shader.program, 0);
}

static void a_missing_variable_is_named_with_its_program(void **state)
{
    (void)state;
    Shader shader;
    GLint location = 7;
    make("main.vert", "attribute vec4 a_Color;\nattribute vec4 a_Position;\n"
                      "uniform vec4 u_Used, u_Unused;\nvoid main() {\n"
                      "    gl_Position = a_Position + a_Color + u_Used;\n}\n");
    make("main.frag", FRAGMENT);
    if (!open_program(&shader))
        fail_msg("%s", message.text);
    assert_string_equal(shader.name, "main");
    assert_true(shader_attribute(&shader, "a_Position", &location, NULL));
    assert_int_equal(location, 0); /* wherever it is declared */
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

static void every_precision_and_define_reaches_the_driver(void **state)
{
    (void)state;
    static const char *const precisions[] = {NULL, "highp", "mediump"};
    static const char *const defines[] = {"COLOR vec4(1.0)", "CORRECT", NULL};
    make("main.vert", VERTEX);
    make("main.frag", "#ifndef CORRECT\n#error not defined\n#endif\n"
                      "#ifdef GL_FRAGMENT_PRECISION_HIGH\nprecision highp float;\n#else\n"
                      "precision mediump float;\n#endif\nuniform mediump float u_A;\n"
                      "uniform highp float u_B;\n"
                      "void main() {\n    gl_FragColor = COLOR * u_A * u_B;\n}\n");
    loader.defines = defines;
    for (size_t i = 0; i < sizeof precisions / sizeof precisions[0]; i++) {
        Shader shader;
        loader.precision = precisions[i];
        if (!open_program(&shader))
            fail_msg("%s", message.text);
        shader_close(&shader);
    }
}

/* Files that are kept. */

/* The paths that have been asked for so far. */
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

static void what_was_read_and_missed_stays_so(void **state)
{
    (void)state;
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

    /* Edited, removed, and put where it would be found earlier. */
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

    /* What was never asked for comes from disk. */
    loader.files = &kept;
    make("one/more.glsl", "int e;\n");
    found("more.glsl", "one/more.glsl");
    asked_for(asked, 5);
    shader_files_close(&kept);
    assert_int_equal(kept.count, 0);
}

static void what_changes_is_told_by_its_contents(void **state)
{
    (void)state;
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
    /* Written again with the same text, by another file, with another date: nothing. */
    make("new", "int b;\n");
    assert_int_equal(rename("new", "part.glsl"), 0);
    assert_int_equal(chmod("part.glsl", 0600), 0);
    assert_null(shader_files_changed(&kept));
    make("part.glsl", "int b;\n ");
    changed("./part.glsl");
    make_bytes("part.glsl", "int b;\n\0", 8);
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
    assert_null(shader_files_changed(&kept)); /* it was not there before either */
    shader_files_close(&kept);

    /* What could not be read is the same as long as the reason is. */
    assert_int_equal(mkdir("folder.vert", 0777), 0);
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    assert_null(shader_files_changed(&kept));
    assert_int_equal(rmdir("folder.vert"), 0);
    changed("./folder.vert");
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    shader_files_close(&kept);
}

static void replacements_are_kept_and_made_texts_are_none(void **state)
{
    (void)state;
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

static void a_cycle_that_comes_later_does_no_harm_to_what_was_read(void **state)
{
    (void)state;
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

static void a_folder_that_comes_or_goes_is_a_change(void **state)
{
    (void)state;
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

static void closing_nothing_is_fine(void **state)
{
    (void)state;
    Shader zeroed = {0};
    ShaderSource empty = {0};
    shader_close(NULL);
    shader_close(&zeroed);
    shader_source_close(NULL);
    shader_source_close(&empty);
    shader_files_close(NULL);
    shader_files_close(&(ShaderFiles){0});
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, enter_folder, leave_folder)

int main(void)
{
    const struct CMUnitTest files[] = {
        TEST(the_folders_are_searched_in_order_by_path_and_by_name),
        TEST(a_file_name_alone_is_no_way_into_the_source_tree),
        TEST(every_path_that_was_tried_is_listed_in_order),
        TEST(an_absolute_path_is_tried_alone),
        TEST(folders_that_are_not_there_are_named),
        TEST(what_is_there_but_no_text_file_is_not_passed_over),
        TEST(line_ends_and_a_byte_order_mark_make_no_difference),
        TEST(what_is_no_text_is_refused_with_its_line),
        TEST(an_empty_file_is_refused),
        TEST(a_file_may_have_so_many_bytes_and_not_one_more),
        TEST(version_100_comes_first_however_it_is_written),
        TEST(any_other_version_is_refused_with_its_line),
        TEST(defines_follow_the_version_and_move_no_line),
        TEST(precision_is_overridden_in_fragment_shaders_alone),
        TEST(an_include_is_looked_for_beside_its_file_then_in_the_folders),
        TEST(a_file_included_twice_is_taken_in_twice_under_one_number),
        TEST(includes_in_comments_are_no_includes),
        TEST(a_comment_that_opens_behind_a_directive_stays_open),
        TEST(an_include_that_names_no_file_is_refused_with_its_line),
        TEST(a_file_that_includes_itself_is_refused_with_place_and_chain),
        TEST(a_cycle_through_a_link_is_found),
        TEST(includes_nest_31_deep_and_no_deeper),
        TEST(includes_that_grow_without_bounds_are_refused_soon),
        TEST(every_line_is_told_in_terms_of_its_file),
        TEST(a_log_keeps_what_has_no_place),
        TEST(every_line_of_a_log_is_told_and_the_first_is_shown),
        TEST(a_message_that_is_there_already_stays),
        TEST(long_lines_and_logs_are_cut),
        TEST(a_line_of_a_large_shader_is_found_soon),
        TEST(what_was_read_and_missed_stays_so),
        TEST(what_changes_is_told_by_its_contents),
        TEST(replacements_are_kept_and_made_texts_are_none),
        TEST(a_cycle_that_comes_later_does_no_harm_to_what_was_read),
        TEST(a_folder_that_comes_or_goes_is_a_change),
        TEST(closing_nothing_is_fine),
    };
    const struct CMUnitTest driver[] = {
        TEST(a_broken_line_is_named_wherever_it_stands),
        TEST(errors_around_an_include_have_their_own_lines),
        TEST(a_link_error_is_named_at_the_declaration),
        TEST(line_directives_of_the_shader_itself_do_no_harm),
        TEST(a_missing_file_of_a_pair_is_named),
        TEST(a_missing_variable_is_named_with_its_program),
        TEST(every_precision_and_define_reaches_the_driver),
    };
    const char *given = getenv("LIGHTING_TEST_SEED");
    seed = given ? (unsigned)strtoul(given, NULL, 10) : (unsigned)time(NULL);
    printf("LIGHTING_TEST_SEED=%u\n", seed);

    int failed = cmocka_run_group_tests_name("shader files", files, NULL, NULL);
    message = (Message){0};
    if (!canvas_open(&canvas, &(CanvasOptions){.width = 4, .height = 4}, &message)) {
        printf("compiling and linking is skipped: %s\n", message.text);
        return failed ? failed : 77;
    }
    failed += cmocka_run_group_tests_name("shaders in the driver", driver, NULL, NULL);
    canvas_close(&canvas);
    return failed;
}
