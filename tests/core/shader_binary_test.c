/*
 * Linked programs kept in the cache: the same as compiled ones in what they draw, their variables
 * and what is reported of them; compiled anew whenever the kept one is not right.
 */
#include "core/canvas.h"
#include "core/shader.h"
#include "core/shader_binary.h"
#include "support/testing.h"

enum { SIZE = 16 };

static const char VERTEX[] = "attribute vec4 a_Color;\nattribute vec4 a_Position;\n"
                             "uniform vec4 u_LightColour, u_Unused;\nuniform mat4 u_Turn[2];\n"
                             "varying vec4 v_Color;\nvoid main() {\n"
                             "    gl_Position = u_Turn[1] * a_Position;\n"
                             "    v_Color = a_Color * u_LightColour;\n}\n";
static const char FRAGMENT[] = "precision mediump float;\nvarying vec4 v_Color;\n"
                               "uniform float u_Red;\nvoid main() {\n"
                               "    gl_FragColor = vec4(u_Red * v_Color.r, v_Color.gba);\n}\n";

static Canvas canvas;
static ShaderText texts[] = {{"main.vert", VERTEX}, {"main.frag", FRAGMENT}, {NULL, NULL}};
static ShaderLoader loader;
static Message warning;

/* How often the driver has compiled a shader, loaded a program and been asked for one. */
static int compiled, loaded, asked;
static PFNGLCOMPILESHADERPROC compile;
static PFNGLPROGRAMBINARYOESPROC load;
static PFNGLGETPROGRAMBINARYOESPROC ask;

static void GL_APIENTRY count_compile(GLuint shader)
{
    compiled++;
    compile(shader);
}

static void GL_APIENTRY count_load(GLuint program, GLenum format, const void *bytes, GLint size)
{
    loaded++;
    load(program, format, bytes, size);
}

static void GL_APIENTRY count_ask(GLuint program, GLsizei max, GLsizei *size, GLenum *format,
                                  void *bytes)
{
    asked++;
    ask(program, max, size, format, bytes);
}

static int enter(void **state)
{
    warning = (Message){0};
    loader = (ShaderLoader){
        .texts = texts, .only_texts = true, .advise = true, .keeps = true, .warning = &warning};
    texts[0].text = VERTEX;
    texts[1].text = FRAGMENT;
    glCompileShader = count_compile;
    glProgramBinaryOES = load ? count_load : NULL;
    glGetProgramBinaryOES = ask ? count_ask : NULL;
    return testing_enter_cache(state);
}

#define KEPT_TEST(name) TEST_WITH(0, name, enter, testing_leave_cache)

/* What a program shows of itself. */
typedef struct Seen {
    unsigned char pixels[4 * SIZE * SIZE];
    GLint locations[6];
    GLint counts[2];
    char names[8][32];
    Message warning, error;
} Seen;

/* Opens the program, after so many calls of the driver, and looks at it. */
static void open_and_see(int compiles, int loads, int asks, Seen *seen)
{
    Shader shader;
    Image image;
    GLuint buffer;
    static const float corners[] = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
    static const float turns[32] = {[16] = 1, [21] = 0.5f, [26] = 1, [31] = 1};
    *seen = (Seen){.counts = {0, 0}};
    const ShaderLocation wanted[] = {{"a_Position", &seen->locations[0]},
                                     {"a_Color", &seen->locations[1]},
                                     {"u_Red", &seen->locations[2]},
                                     {"u_Turn[1]", &seen->locations[3]},
                                     {"u_Unused", &seen->locations[4]},
                                     {"u_LightColor", &seen->locations[5]},
                                     {NULL, NULL}};
    compiled = loaded = asked = 0;
    warning = (Message){0};
    SUCCEEDS(shader_open(&shader, &loader, "main", message));
    assert_int_equal(compiled, compiles);
    assert_int_equal(loaded, loads);
    assert_int_equal(asked, asks);
    SUCCEEDS(shader_locations(&shader, wanted, message));
    seen->warning = warning;
    shader_complain(&shader, "u_Red", "is wrong", &seen->error);
    glGetProgramiv(shader.program, GL_ACTIVE_UNIFORMS, &seen->counts[0]);
    glGetProgramiv(shader.program, GL_ACTIVE_ATTRIBUTES, &seen->counts[1]);
    for (int i = 0; i < seen->counts[0] + seen->counts[1]; i++) {
        GLint size;
        GLenum type;
        const bool uniform = i < seen->counts[0];
        (uniform ? glGetActiveUniform
                 : glGetActiveAttrib)(shader.program, (GLuint)(uniform ? i : i - seen->counts[0]),
                                      32, NULL, &size, &type, seen->names[i]);
    }
    glUseProgram(shader.program);
    glUniform1fv(seen->locations[2], 1, (const float[]){0.5f});
    glUniformMatrix4fv(seen->locations[3], 1, GL_FALSE, turns + 16);
    glUniform4fv(glGetUniformLocation(shader.program, "u_LightColour"), 1,
                 (const float[]){1, 0.25f, 0.75f, 1});
    glVertexAttrib4fv((GLuint)seen->locations[1], (const float[]){1, 1, 1, 1});
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(0);
    canvas_clear(&canvas, (Vec3){0, 0, 0}, 1);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisableVertexAttribArray(0);
    glDeleteBuffers(1, &buffer);
    SUCCEEDS(image_open(&image, SIZE, SIZE, IMAGE_BYTE, message));
    SUCCEEDS(canvas_read(&canvas, &image, message)); /* no GL error is left */
    memcpy(seen->pixels, image.pixels, sizeof seen->pixels);
    image_close(&image);
    shader_close(&shader);
}

KEPT_TEST(a_kept_program_is_the_same_as_a_compiled_one)
{
    Seen first, again, plain;
    if (!load)
        skip();
    open_and_see(2, 0, 1, &first);
    open_and_see(0, 1, 0, &again);
    loader.keeps = false;
    open_and_see(2, 0, 0, &plain);
    assert_memory_equal(&first, &again, sizeof first);
    assert_memory_equal(&first, &plain, sizeof first);
    assert_string_equal(first.warning.text, "main.vert:3: warning: u_Unused is not used, "
                                            "u_LightColour: u_LightColor?");
    assert_string_equal(first.error.text, "main.frag:3: error: is wrong");
    assert_int_equal(first.pixels[4 * (SIZE / 2 * SIZE + SIZE / 2)], 128);
}

KEPT_TEST(another_source_or_define_is_another_program)
{
    static const char *const defines[] = {"UNUSED", NULL};
    Seen seen;
    if (!load)
        skip();
    open_and_see(2, 0, 1, &seen);
    loader.defines = defines;
    open_and_see(2, 0, 1, &seen);
    loader.defines = NULL;
    texts[1].text = "precision mediump float;\nvarying vec4 v_Color;\nuniform float u_Red;\n"
                    "void main() {\n    gl_FragColor = u_Red * v_Color;\n}\n";
    open_and_see(2, 0, 1, &seen);
    loader.precision = "highp";
    open_and_see(2, 0, 1, &seen);
    texts[1].text = FRAGMENT;
    loader.precision = NULL;
    open_and_see(0, 1, 0, &seen);
}

KEPT_TEST(errors_are_found_by_compiling)
{
    Shader shader;
    texts[1].text = "precision mediump float;\nvarying vec3 v_Color;\nvoid main() {\n"
                    "    gl_FragColor = vec4(v_Color, 1.0);\n}\n";
    for (int i = 0; i < 2; i++) {
        Message message = {0};
        compiled = 0;
        assert_false(shader_open(&shader, &loader, "main", &message));
        assert_int_equal(compiled, 2);
        assert_non_null(strstr(message.text, "main.frag:2: linking: "));
    }
    assert_int_equal(testing_entries(testing_folder), 0);
}

/* What the cache returns as it was written, and the driver has not made. */
KEPT_TEST(what_the_driver_refuses_is_compiled_anew)
{
    Seen first, seen;
    ShaderSource sources[2];
    size_t size;
    if (!load)
        skip();
    open_and_see(2, 0, 1, &first);
    for (int stage = 0; stage < 2; stage++)
        SUCCEEDS(shader_source_open(&sources[stage], &loader, texts[stage].name, (ShaderStage)stage,
                                    message));
    const CacheKey key = shader_binary_key(sources);
    char *kept = cache_read("program", &key, &size);
    assert_non_null(kept);
    const struct {
        size_t flipped, size;
        int loads;
    } cases[] = {{0, size, 1},        {4, size, 1},        {12, size, 1},
                 {size / 2, size, 1}, {size - 1, size, 1}, {4, size / 2, 1},
                 {4, 5, 1},           {0, 4, 0},           {0, 1, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        kept[cases[i].flipped] ^= 1;
        cache_write("program", &key, kept, cases[i].size);
        kept[cases[i].flipped] ^= 1;
        open_and_see(2, cases[i].loads, 1, &seen);
        assert_memory_equal(&first, &seen, sizeof first);
        open_and_see(0, 1, 0, &seen);
    }
    free(kept);
    shader_source_close(&sources[0]);
    shader_source_close(&sources[1]);
}

KEPT_TEST(without_the_extension_or_a_cache_nothing_is_kept)
{
    Seen seen;
    const char *const folders[] = {"/dev/null", "/nonexistent/folder"};
    for (int i = 0; i < 2; i++) {
        setenv("XDG_CACHE_HOME", folders[i], 1);
        for (int time = 0; time < 2; time++)
            open_and_see(2, 0, load != NULL, &seen);
    }
    setenv("XDG_CACHE_HOME", testing_folder, 1);
    glProgramBinaryOES = NULL;
    for (int time = 0; time < 2; time++)
        open_and_see(2, 0, 0, &seen);
    assert_int_equal(testing_entries(testing_folder), 0);
}

int main(void)
{
    Message message = {0};
    GLint formats = 0;
    if (!canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, &message)) {
        printf("skipped: %s\n", message.text);
        return EXIT_SKIPPED;
    }
    compile = glCompileShader;
    if (glProgramBinaryOES)
        glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS_OES, &formats);
    if (formats > 0) {
        load = glProgramBinaryOES;
        ask = glGetProgramBinaryOES;
    }
    const int failed = testing_run(0, "shader_binary", NULL, NULL);
    canvas_close(&canvas);
    return failed;
}
