/*
 * shader: compiling and linking; the driver's messages are mapped to lines of files, with hints.
 * The first group needs no driver.
 */
#include "core/canvas.h"
#include "core/shader.h"
#include "core/shader_folder.h"

#include <time.h>

static unsigned seed;

/* The driver's log. */

static void parse(const char *text)
{
    shader_source_close(&source);
    failure = (Message){0};
    const ShaderText made[] = {{"main.vert", text}, {NULL, NULL}};
    loader.texts = made;
    const bool done = shader_source_open(&source, &loader, "main.vert", SHADER_VERTEX, &failure);
    loader.texts = NULL;
    if (!done)
        fail_msg("%s", failure.text);
}

/* The message of a driver's log. */
static const char *explained(const ShaderSource *of, const char *log)
{
    failure = (Message){0};
    assert_false(shader_explain_log(of, log, &failure));
    return failure.text;
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
            driver_place(p, &file, &line);
            const char *log = formatted(PLACES[checked++ % 3], file, line, "what is wrong");
            const char *start = formatted("./part%d.glsl:%d: ", said_file, said_line);
            const char *shown = formatted("what is wrong\n  %d | %.*s", said_line, length, p);
            const char *said = explained(&source, log);
            if (strncmp(said, start, strlen(start)) != 0 || !strstr(said, shown))
                fail_msg("%s for %s%s", said, start, shown);
            assert_true(failure.located);
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
        const char *rest = strchr(logs[i], ' ');
        if (!strstr(explained(&source, logs[i]), rest ? rest : logs[i]))
            fail_msg("\"%s\" became \"%s\"", logs[i], failure.text);
    }
}

static ShaderSource both[2]; /* stages of one program, to be closed */

static void open_both(const char *vertex, const char *fragment)
{
    const ShaderText texts[] = {{"a.vert", vertex}, {"a.frag", fragment}, {NULL, NULL}};
    const ShaderLoader own = {.texts = texts, .only_texts = true};
    SUCCEEDS(shader_source_open(&both[0], &own, "a.vert", SHADER_VERTEX, message) &&
             shader_source_open(&both[1], &own, "a.frag", SHADER_FRAGMENT, message));
    failure = (Message){0};
}

static void close_both(void)
{
    shader_source_close(&both[0]);
    shader_source_close(&both[1]);
}

/* What is said of both stages as if a driver had refused one, or linking them. */
static const char *hint(const char *vertex, const char *fragment, int which, const char *said)
{
    open_both(vertex, fragment);
    message_set(&failure, "%s", said);
    shader_advise(both, which, &failure);
    close_both();
    return failure.text;
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

static void unbounded(const char *text, const char *said)
{
    parse(text);
    FAILS_WITH(shader_bounded(&source, SHADER_VERTEX, 0, message), said);
}

SHADER_TEST(what_grows_without_bound_comes_to_no_driver)
{
    static const struct {
        const char *first, *each, *last, *said;
    } doubling[] = {
        {"#define A0 1.0\n", "#define A%d A%d + A%d\n", "const float a = A39;\n", ":41: error: "},
        {"float f0() { return 1.0; }\n", "float f%d() { return f%d() + f%d(); }\n",
         "void main() { gl_Position = vec4(f39()); }\n", ":41: error: with each function put"}};
    for (int k = 0; k < 2; k++) {
        char text[8000] = "";
        strcat(text, doubling[k].first);
        for (int i = 1; i < 40; i++)
            strcat(text, formatted(doubling[k].each, i, i - 1, i - 1));
        unbounded(strcat(text, doubling[k].last), doubling[k].said);
    }
    parse("void main() {\n    float a[16384]; gl_Position = vec4(a[0]);\n}\n");
    assert_true(shader_bounded(&source, SHADER_VERTEX, 0, &failure));
    unbounded("struct S { vec4 a[3000]; };\nvoid main() {\n    S s[2000];\n}\n",
              ":3: error: s holds 24000000 numbers or more; at most ");
    unbounded("void main() {\n    float a[2147483647];\n}\n",
              ":2: error: a holds 1000000000 numbers or more; at ");
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
    const char *said = explained(&source, "ERROR: -1:-1: '' : Missing main()\n");
    assert_non_null(strstr(said, ": '' : Missing main()"));
    assert_null(strstr(said, "-1"));
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
    open_both(V, F(""));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char log[256];
        snprintf(log, sizeof log, "%s", cases[i].log);
        failure = (Message){0};
        assert_false(shader_explain_link(both, log, &failure));
        assert_string_equal(failure.text, cases[i].said);
    }
    assert_null(strstr(
        explained(&both[0], "0(2) : error C1101: ambiguous \"mul(mat4, vec3)\"\n"
                            "    (0) : gp5 mediump mat3x4 mul(mediump mat3x1, mediump mat1x4)\n"
                            "    (0) : mat3 mul(mat3x1, ma"),
        "mat3x1"));
    assert_string_equal(explained(&both[1], "(0) : error C0000: unexpected $end\n"),
                        "a.frag: error C0000: unexpected $end");
    close_both();
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
    assert_string_equal(explained(&source, log), "./a.glsl:2: warning: w\n  2 | int a;\n"
                                                 "./main.vert:3: error: e\nerror: too many");
    assert_true(failure.located);
}

SHADER_TEST(an_earlier_message_stays)
{
    parse("int a;\n");
    message_set(&failure, "the cause");
    shader_explain_log(&source, "0:2(1): error: e", &failure);
    assert_string_equal(failure.text, "the cause");
    assert_false(failure.located);
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
    assert_non_null(strstr(explained(&source, log), "  1 | xxx"));
    assert_true(strlen(failure.text) < 300);
    memset(log + strlen(log), 'y', sizeof log - strlen(log) - 1);
    assert_int_equal(strlen(explained(&source, log)), sizeof failure.text - 1);
}

SHADER_TEST(a_line_of_a_large_shader_is_found_quickly)
{
    enum { LAST = SHADER_FILE_MAX / 2, SIZE = 2 * LAST };
    char *text = malloc(SIZE + 1);
    assert_non_null(text);
    for (int i = 0; i < SIZE; i++)
        text[i] = i % 2 ? '\n' : ';';
    text[SIZE - 2] = '@';
    text[SIZE] = '\0';
    parse(text);
    free(text);
    /* Without driver_place, which is quadratic itself. */
    const int line = strstr(source.text, "#line ") ? LAST : LAST + 1;
    const clock_t start = clock();
    assert_string_equal(explained(&source, formatted("0:%d(1): error: e", line)),
                        formatted("main.vert:%d: error: e\n  %d | @", LAST, LAST));
    /* Processor time, independent of other processes; one pass takes milliseconds. */
    assert_true((double)(clock() - start) / CLOCKS_PER_SEC < 2);
}

/* With a driver. */

static Canvas canvas;

static const char FRAGMENT[] = "void main() {\n    gl_FragColor = vec4(1.0);\n}\n";
static const char VERTEX[] = "attribute vec4 a_Position;\nvoid main() {\n"
                             "    gl_Position = a_Position;\n}\n";

static bool open_program(Shader *shader, const char *vertex, const char *fragment)
{
    failure = (Message){0};
    make("main.vert", vertex);
    make("main.frag", fragment);
    return shader_open(shader, &loader, "main", &failure);
}

/* main.vert and main.frag do not compile or link; the message begins with `start` and contains the
 * line `shown` unless that is NULL. */
static void program_refused(const char *vertex, const char *fragment, const char *start,
                            const char *shown)
{
    Shader shader;
    if (open_program(&shader, vertex, fragment))
        fail_msg("accepted: %s\n%s", vertex, fragment);
    if (strncmp(failure.text, start, strlen(start)) != 0)
        fail_msg("expected to begin \"%s\": %s", start, failure.text);
    if (shown && !strstr(failure.text, shown))
        fail_msg("expected to show \"%s\": %s", shown, failure.text);
    assert_int_equal(failure.located, shown != NULL);
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
        make_tree(file, number, line);
        const char *fragment = formatted(
            "%sprecision highp float;\n#include \"part0.glsl\"\n\n#include \"part%d.glsl\"\n%s",
            rand() % 2 ? "#version 100\n" : "", file, FRAGMENT);
        const char *start = formatted("./part%d.glsl:%d: ", file, number);
        const char *shown = formatted("\n  %d | %s", number, line);
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
        Shader shader;
        assert_false(open_program(
            &shader, VERTEX,
            formatted("precision mediump float;\n%s\nvarying vec4 v_Missing;\nvoid main() {\n"
                      "    gl_FragColor = v_Missing;\n}\n",
                      directives[i])));
        assert_non_null(strstr(failure.text, "v_Missing"));
        assert_false(
            open_program(&shader, VERTEX, formatted("%s\nwrong;\n%s", directives[i], FRAGMENT)));
        assert_true(failure.text[0] != '\0');
    }
}

DRIVER_TEST(a_missing_variable_is_named_with_its_program)
{
    Shader shader;
    GLint location = 7;
    require(open_program(&shader,
                         "attribute vec4 a_Color;\nattribute vec4 a_Position;\n"
                         "uniform vec4 u_Used, u_Unused;\nvoid main() {\n"
                         "    gl_Position = a_Position + a_Color + u_Used;\n}\n",
                         FRAGMENT),
            &failure);
    assert_string_equal(shader.name, "main");
    assert_true(shader_attribute(&shader, "a_Position", &location, NULL));
    assert_int_equal(location, 0); /* in any order of declaration */
    assert_true(shader_attribute(&shader, "a_Color", &location, NULL));
    assert_true(location > 0);
    assert_true(shader_uniform(&shader, "u_Used", &location, NULL));
    assert_true(location >= 0);

    FAILS_WITH(shader_uniform(&shader, "u_Unused", &location, message),
               "main: the linked program has no uniform u_Unused");
    FAILS_WITH(shader_uniform(&shader, "u_Nope", &location, message),
               "main: the linked program has no uniform u_Nope");
    FAILS_WITH(shader_attribute(&shader, "a_Nope", &location, message),
               "main: the linked program has no attribute a_Nope");

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
    static const char vertex[] =
        "attribute vec4 a_Position;\nuniform vec4 u_LightColour, u_Unused;\n"
        "uniform float u_Other;\nvoid main() {\n"
        "    gl_Position = a_Position * u_Other + u_LightColour;\n}\n";
    require(open_program(&shader, vertex, FRAGMENT), &failure);
    FAILS_WITH(shader_locations(&shader, wanted, message),
               "main: the linked program has no uniform u_Unused");
    shader_close(&shader);

    loader.warning = &warning;
    require(open_program(&shader, vertex, FRAGMENT), &failure);
    assert_true(shader_locations(&shader, wanted, &failure));
    assert_string_equal(failure.text, "");
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

    warning = (Message){0};
    require(open_program(&shader, vertex, "void main() {\n    // gl_FragColor = vec4(1.0);\n}\n"),
            &failure);
    assert_string_equal(warning.text, "./main.frag: warning: gl_FragColor is never written: any "
                                      "colour may be drawn");
    shader_close(&shader);
}

DRIVER_TEST(closing_nothing_is_fine)
{
    shader_close(NULL);
    shader_close(&(Shader){0});
}

int main(void)
{
    seed = (unsigned)testing_seed((unsigned long long)time(NULL));
    int failed = testing_run(0, "shader log", NULL, NULL);
    failure = (Message){0};
    if (!canvas_open(&canvas, &(CanvasOptions){.width = 4, .height = 4}, &failure)) {
        printf("compiling and linking is skipped: %s\n", failure.text);
        return failed ? failed : EXIT_SKIPPED;
    }
    failed += testing_run(1, "shaders in the driver", NULL, NULL);
    canvas_close(&canvas);
    return failed;
}
