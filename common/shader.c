/*
 * The half of shader.h that needs a driver: compiling, linking, locations.
 */
#include "shader.h"

#include "progress.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Never longer than a Message; what is cut is the driver's repetition. */
enum { LOG_MOST = 4096 };

static void print_source(const ShaderLoader *loader, const ShaderSource *source, ShaderStage stage)
{
    const int both = SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT;
    const int mine = stage == SHADER_VERTEX ? SHADER_PRINT_VERTEX : SHADER_PRINT_FRAGMENT;
    if (!(loader->print & mine))
        return;
    if ((loader->print & both) == both)
        printf("// %s shader: %s\n", stage == SHADER_VERTEX ? "vertex" : "fragment",
               source->files[0]);
    fputs(source->text, stdout);
}

static GLuint compile(const ShaderSource *source, ShaderStage stage, Message *message)
{
    const GLchar *text = source->text;
    const GLint size = (GLint)source->size;
    GLint compiled = GL_FALSE;
    GLuint shader = glCreateShader(stage == SHADER_VERTEX ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    glShaderSource(shader, 1, &text, &size);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return shader;
    char log[LOG_MOST] = "";
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    glDeleteShader(shader);
    if (log[0])
        shader_explain_log(source, log, message);
    else
        message_set(message, "%s: the driver refused it without a reason", source->files[0]);
    return 0;
}

static bool in_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* Whether a line declares `word`: "varying vec3 v_Normal;", where a separator follows the name. */
static bool declares(const char *line, int length, const char *word, int word_length)
{
    static const char *const kinds[] = {"attribute", "uniform", "varying"};
    bool declaration = false;
    for (int i = 0; i < length;) {
        int n = 0;
        while (i + n < length && in_name(line[i + n]))
            n++;
        for (int k = 0; k < 3; k++)
            declaration |=
                n == (int)strlen(kinds[k]) && strncmp(line + i, kinds[k], (size_t)n) == 0;
        int after = i + n;
        while (after < length && isspace((unsigned char)line[after]))
            after++;
        if (declaration && n == word_length && strncmp(line + i, word, (size_t)n) == 0 &&
            after < length && strchr(";,[", line[after]))
            return true;
        i += n ? n : 1;
    }
    return false;
}

/* A link error names variables, not lines: finds where one of them is declared. */
static bool locate_link_error(const ShaderSource *source, const char *log, Message *message)
{
    int file = 0, line = 0;
    for (const char *p = source->text; *p;) {
        const char *newline = strchr(p, '\n');
        const int length = newline ? (int)(newline - p) : (int)strlen(p);
        const bool numbered = shader_line_directive(p, &file, &line);
        for (const char *w = log; *w && !numbered;) {
            int n = 0;
            while (in_name(w[n]))
                n++;
            if (n > 1 && declares(p, length, w, n)) {
                message_set(message, "%s:%d: linking: %s\n  %d | %.*s", source->files[file], line,
                            log, line, length < 200 ? length : 200, p);
                if (message)
                    message->located = true;
                return true;
            }
            w += n ? n : 1;
        }
        line += !numbered;
        p += length + (newline ? 1 : 0);
    }
    return false;
}

static bool link_program(GLuint program, const ShaderSource *vertex, const ShaderSource *fragment,
                         Message *message)
{
    GLint linked = GL_FALSE;
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked)
        return true;
    char log[LOG_MOST] = "";
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    for (size_t end = strlen(log); end > 0 && isspace((unsigned char)log[end - 1]); end--)
        log[end - 1] = '\0';
    if (locate_link_error(fragment, log, message) || locate_link_error(vertex, log, message))
        return false;
    return message_set(message, "%s, %s: linking: %s", vertex->files[0], fragment->files[0],
                       log[0] ? log : "the driver refused without a reason");
}

static bool check_precision(const ShaderLoader *loader, Message *message)
{
    if (!loader->precision || strcmp(loader->precision, "highp") != 0)
        return true;
    GLint range[2] = {0, 0}, precision = 0;
    glGetShaderPrecisionFormat(GL_FRAGMENT_SHADER, GL_HIGH_FLOAT, range, &precision);
    if (range[1] > 0)
        return true;
    return message_set(message, "--precision highp: %s has no highp in fragment shaders",
                       (const char *)glGetString(GL_RENDERER));
}

bool shader_open(Shader *shader, const ShaderLoader *loader, const char *name, Message *message)
{
    ShaderSource vertex_source = {0}, fragment_source = {0};
    GLuint vertex = 0, fragment = 0;
    char file[160];
    bool done = false;
    const double start = progress_now();

    *shader = (Shader){0};
    snprintf(shader->name, sizeof shader->name, "%s", name);
    snprintf(file, sizeof file, "%s.vert", name);
    if (!check_precision(loader, message) ||
        !shader_source_open(&vertex_source, loader, file, SHADER_VERTEX, message))
        goto end;
    snprintf(file, sizeof file, "%s.frag", name);
    if (!shader_source_open(&fragment_source, loader, file, SHADER_FRAGMENT, message))
        goto end;
    print_source(loader, &vertex_source, SHADER_VERTEX);
    print_source(loader, &fragment_source, SHADER_FRAGMENT);

    if (!(vertex = compile(&vertex_source, SHADER_VERTEX, message)) ||
        !(fragment = compile(&fragment_source, SHADER_FRAGMENT, message)))
        goto end;
    shader->program = glCreateProgram();
    glAttachShader(shader->program, vertex);
    glAttachShader(shader->program, fragment);
    glBindAttribLocation(shader->program, 0, "a_Position");
    done = link_program(shader->program, &vertex_source, &fragment_source, message);
    if (done && loader->verbose)
        fprintf(stderr, "%s: %s and %s: compiled and linked in %.1f ms\n", name,
                vertex_source.files[0], fragment_source.files[0], 1e3 * (progress_now() - start));
end:
    /* Deleted now, they live as long as the program that they are attached to. */
    if (vertex)
        glDeleteShader(vertex);
    if (fragment)
        glDeleteShader(fragment);
    if (!done)
        shader_close(shader);
    shader_source_close(&vertex_source);
    shader_source_close(&fragment_source);
    return done;
}

static bool missing(const Shader *shader, const char *kind, const char *name, Message *message)
{
    return message_set(message,
                       "%s: the linked program has no %s %s: it is not declared, or no output "
                       "depends on it",
                       shader->name, kind, name);
}

/* Location 0 is valid; -1 is the failure. */
bool shader_uniform(const Shader *shader, const char *name, GLint *location, Message *message)
{
    *location = glGetUniformLocation(shader->program, name);
    return *location >= 0 ? true : missing(shader, "uniform", name, message);
}

bool shader_attribute(const Shader *shader, const char *name, GLint *location, Message *message)
{
    *location = glGetAttribLocation(shader->program, name);
    return *location >= 0 ? true : missing(shader, "attribute", name, message);
}

void shader_set_vec3(GLint location, Vec3 value)
{
    float rounded[3];
    vec3_to_float(value, rounded);
    glUniform3fv(location, 1, rounded);
}

void shader_set_mat4(GLint location, Mat4 value)
{
    float rounded[16];
    mat4_to_float(value, rounded);
    glUniformMatrix4fv(location, 1, GL_FALSE, rounded);
}

void shader_close(Shader *shader)
{
    if (!shader)
        return;
    if (shader->program)
        glDeleteProgram(shader->program);
    *shader = (Shader){0};
}
