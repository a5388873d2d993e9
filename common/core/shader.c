/*
 * Compiling, linking, locations; and from the driver's log back to files: each driver writes places
 * in a form of its own, of which the source string and the line are those of our #line directives.
 * To show a line, the source is read from its beginning, following them. Linear in the source.
 */
#include "core/shader.h"

#include "base/clock.h"
#include "base/text.h"
#include "core/shader_binary.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_MAX = sizeof((Message *)NULL)->text, NAME_SIZE = 128 };

static void print_source(const ShaderLoader *loader, const ShaderSource *source, ShaderStage stage)
{
    const int both = SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT;
    const int mine = stage == SHADER_VERTEX ? SHADER_PRINT_VERTEX : SHADER_PRINT_FRAGMENT;
    if (!loader->printed || !(loader->print & mine))
        return;
    if ((loader->print & both) == both)
        fprintf(loader->printed, "// %s shader: %s\n",
                stage == SHADER_VERTEX ? "vertex" : "fragment", source->files[0]);
    fputs(source->text, loader->printed);
}

/* Whether a line of a source is a #line directive, and the file and line it gives the next. */
static bool read_line_directive(const char *text, int *file, int *line)
{
    char *end;
    if (strncmp(text, "#line ", 6) != 0)
        return false;
    *line = (int)(strtol(text + 6, &end, 10) % SHADER_LINES_OF_FILE);
    *file = (int)strtol(end, &end, 10);
    return true;
}

const char *shader_find_line(const char *text, int file, int line, int *length)
{
    int at_file = -1, at_line = 0;
    for (const char *p = text; p && *p;) {
        const char *newline = strchr(p, '\n');
        const int n = newline ? (int)(newline - p) : (int)strlen(p);
        if (!read_line_directive(p, &at_file, &at_line)) {
            if (at_file == file && at_line == line) {
                *length = n;
                return p;
            }
            at_line++;
        }
        p = newline ? newline + 1 : NULL;
    }
    return NULL;
}

/* Reads "0:12(3): rest" (Mesa), "ERROR: 0:12: rest" (ANGLE) or "0(12) : rest" (NVIDIA). */
static const char *parse_position(const char *log, int *file, int *line)
{
    int places[3] = {0}, used;
    if (strncmp(log, "ERROR: ", 7) == 0)
        log += 7;
    else if (strncmp(log, "WARNING: ", 9) == 0)
        log += 9;
    if (!(used = text_numbers(log, "#:#(#):", places)) &&
        !(used = text_numbers(log, "#:#:", places)))
        used = text_numbers(log, "#(#) :", places);
    *file = places[0];
    *line = places[1];
    if (used && *line > SHADER_LINES_OF_FILE) {
        *file = *line / SHADER_LINES_OF_FILE;
        *line %= SHADER_LINES_OF_FILE;
    }
    return used ? log + used : NULL;
}

static void show_line(const ShaderSource *source, int file, int line, Message *message)
{
    int length;
    const char *text = shader_find_line(source->text, file, line, &length);
    if (text)
        message_add(message, "\n  %d | %.*s", line, length < 200 ? length : 200, text);
}

/* How long the place is that a log gives what is missing, ANGLE's and NVIDIA's; 0: it is another.
 */
static int nowhere(const char *log)
{
    static const char *const places[] = {"ERROR: -1:-1: ", "(0) : "};
    for (int i = 0; i < 2; i++)
        if (strncmp(log, places[i], strlen(places[i])) == 0)
            return (int)strlen(places[i]);
    return 0;
}

/* NVIDIA lists, indented, the 160 products of the language where the types of one do not fit. */
static bool is_candidate(const char *log)
{
    return log[0] == ' ' && nowhere(log + strspn(log, " "));
}

bool shader_explain_log(const ShaderSource *source, const char *log, Message *message)
{
    if (!message || message->text[0])
        return false;
    bool shown = false;
    while (*log) {
        const char *newline = strchr(log, '\n');
        const int length = newline ? (int)(newline - log) : (int)strlen(log);
        int file, line;
        const char *rest = parse_position(log, &file, &line);
        const char *separator = message->text[0] ? "\n" : "";
        if (rest && rest <= log + length && file >= 0 && file < source->file_count) {
            while (*rest == ' ')
                rest++;
            if (!message->text[0])
                message->located = true;
            message_add(message, "%s%s:%d: %.*s", separator, source->files[file], line,
                        (int)(log + length - rest), rest);
            if (!shown)
                show_line(source, file, line, message);
            shown = true;
        } else if (nowhere(log)) {
            message_add(message, "%s%s: %.*s", separator, source->files[0], length - nowhere(log),
                        log + nowhere(log));
        } else if (length > 0 && !is_candidate(log)) {
            message_add(message, "%s%.*s", separator, length, log);
        }
        log += length + (newline ? 1 : 0);
    }
    return false;
}

static GLuint compile(const ShaderSource *source, ShaderStage stage, Message *message)
{
    const GLchar *text = source->text;
    const GLint size = (GLint)source->size;
    GLint compiled = GL_FALSE;
    if (!shader_bounded(source, stage, 0, message))
        return 0;
    GLuint shader = glCreateShader(stage == SHADER_VERTEX ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    glShaderSource(shader, 1, &text, &size);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return shader;
    char log[LOG_MAX] = "";
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    glDeleteShader(shader);
    if (log[0])
        shader_explain_log(source, log, message);
    else
        message_set(message, "%s: the driver rejected it without a reason", source->files[0]);
    return 0;
}

/* Whether a line declares `word`, followed by a separator: "varying vec3 v_Normal;". */
static bool declares(const char *line, int length, const char *word, int word_length)
{
    static const char *const kinds[] = {"attribute", "uniform", "varying"};
    bool declaration = false;
    for (int i = 0; i < length;) {
        int n = 0;
        while (i + n < length && text_is_word(line[i + n]))
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

typedef struct Declaration {
    const char *file, *text; /* the text of its line, of this length */
    int line, length;
} Declaration;

static bool find_declaration(const ShaderSource *source, const char *word, int word_length,
                             Declaration *found)
{
    int file = 0, line = 0;
    for (const char *p = source->text; p && *p;) {
        const char *newline = strchr(p, '\n');
        const int length = newline ? (int)(newline - p) : (int)strlen(p);
        const bool numbered = read_line_directive(p, &file, &line);
        if (!numbered && declares(p, length, word, word_length)) {
            *found = (Declaration){source->files[file], p, line, length};
            return true;
        }
        line += !numbered;
        p += length + (newline ? 1 : 0);
    }
    return false;
}

/* A link error names variables, not lines: finds the declaration of one of them. */
static bool locate_link_error(const ShaderSource *source, const char *log, Message *message)
{
    Declaration found;
    for (const char *word = log; *word;) {
        int length = 0;
        while (text_is_word(word[length]))
            length++;
        if (length > 1 && find_declaration(source, word, length, &found)) {
            message_set(message, "%s:%d: linking: %s\n  %d | %.*s", found.file, found.line, log,
                        found.line, found.length < 200 ? found.length : 200, found.text);
            if (message)
                message->located = true;
            return true;
        }
        word += length ? length : 1;
    }
    return false;
}

bool shader_explain_link(const ShaderSource sources[2], char *log, Message *message)
{
    /* NVIDIA's, of the stage whose lines follow. */
    static const char *const headings[] = {[SHADER_VERTEX] = "Vertex info\n-----------\n",
                                           [SHADER_FRAGMENT] = "Fragment info\n-------------\n"};
    const ShaderSource *vertex = &sources[SHADER_VERTEX], *fragment = &sources[SHADER_FRAGMENT];
    int file, line;
    for (size_t end = strlen(log); end > 0 && isspace((unsigned char)log[end - 1]); end--)
        log[end - 1] = '\0';
    for (int stage = 0; stage < 2; stage++) {
        if (strncmp(log, headings[stage], strlen(headings[stage])) != 0)
            continue;
        log += strlen(headings[stage]);
        if (parse_position(log, &file, &line) || nowhere(log))
            return shader_explain_log(&sources[stage], log, message);
    }
    if (locate_link_error(fragment, log, message) || locate_link_error(vertex, log, message))
        return false;
    return message_set(message, "%s, %s: linking: %s", vertex->files[0], fragment->files[0],
                       log[0] ? log : "the driver rejected it without a reason");
}

static bool link_program(GLuint program, const ShaderSource sources[2], Message *message)
{
    char log[LOG_MAX] = "";
    GLint linked = GL_FALSE;
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked)
        glGetProgramInfoLog(program, sizeof log, NULL, log);
    return linked || shader_explain_link(sources, log, message);
}

/* Whether fragment shaders may say highp: asked of the compiler, because what the driver says of
 * its precision need not be so. */
static bool has_highp(void)
{
    static const GLchar *const text = "#version 100\nprecision highp float;\nvoid main() {}\n";
    GLint compiled = GL_FALSE;
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    glDeleteShader(shader);
    return compiled;
}

/* After a fragment shader was refused. */
static void explain_precision(const ShaderLoader *loader, Message *message)
{
    if (!message || !loader->precision || strcmp(loader->precision, "highp") != 0 || has_highp())
        return;
    *message = (Message){0};
    message_set(message, "precision highp: %s has none in fragment shaders",
                (const char *)glGetString(GL_RENDERER));
}

static void close_sources(Shader *shader)
{
    shader_source_close(&shader->sources[SHADER_VERTEX]);
    shader_source_close(&shader->sources[SHADER_FRAGMENT]);
}

/* Reads and prints NAME.vert and NAME.frag. */
static bool open_sources(ShaderSource sources[2], const ShaderLoader *loader, const char *name,
                         Message *message)
{
    static const char *const endings[] = {[SHADER_VERTEX] = "vert", [SHADER_FRAGMENT] = "frag"};
    for (ShaderStage stage = SHADER_VERTEX; stage <= SHADER_FRAGMENT; stage++) {
        char file[160];
        snprintf(file, sizeof file, "%s.%s", name, endings[stage]);
        if (!shader_source_open(&sources[stage], loader, file, stage, message))
            return false;
    }
    print_source(loader, &sources[SHADER_VERTEX], SHADER_VERTEX);
    print_source(loader, &sources[SHADER_FRAGMENT], SHADER_FRAGMENT);
    return true;
}

/* The program, compiled and linked; 0 on failure. */
static GLuint build(const ShaderSource sources[2], const ShaderLoader *loader, Message *message)
{
    GLuint program = 0;
    const GLuint vertex = compile(&sources[SHADER_VERTEX], SHADER_VERTEX, message);
    const GLuint fragment =
        vertex ? compile(&sources[SHADER_FRAGMENT], SHADER_FRAGMENT, message) : 0;
    if (fragment) {
        program = glCreateProgram();
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
        glBindAttribLocation(program, 0, "a_Position");
        if (!link_program(program, sources, message)) {
            glDeleteProgram(program);
            program = 0;
        }
    }
    if (!program && loader->advise)
        shader_advise(sources,
                      fragment ? SHADER_LINKING
                      : vertex ? SHADER_FRAGMENT
                               : SHADER_VERTEX,
                      message);
    if (vertex && !fragment)
        explain_precision(loader, message);
    /* Deleted when the program is; 0 is ignored. */
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return program;
}

bool shader_open(Shader *shader, const ShaderLoader *loader, const char *name, Message *message)
{
    const double start = clock_now();
    bool kept = false;
    *shader = (Shader){.warning = loader->warning};
    snprintf(shader->name, sizeof shader->name, "%s", name);
    if (open_sources(shader->sources, loader, name, message)) {
        const CacheKey key = loader->keeps ? shader_binary_key(shader->sources) : (CacheKey){{0}};
        shader->program = loader->keeps ? shader_binary_open(&key) : 0;
        kept = shader->program != 0;
        if (!kept)
            shader->program = build(shader->sources, loader, message);
        if (!kept && shader->program && loader->keeps)
            shader_binary_keep(&key, shader->program);
    }
    if (!shader->program) {
        shader_close(shader);
        return false;
    }
    if (loader->log)
        fprintf(loader->log, "%s: %s and %s: %s in %.1f ms\n", name,
                shader->sources[SHADER_VERTEX].files[0], shader->sources[SHADER_FRAGMENT].files[0],
                kept ? "linked before, loaded" : "compiled and linked",
                1e3 * (clock_now() - start));
    if (!loader->warning)
        close_sources(shader);
    else
        shader_warn_of_color(&shader->sources[SHADER_FRAGMENT], loader->warning);
    return true;
}

static bool is_attribute(const char *name)
{
    return strncmp(name, "a_", 2) == 0;
}

/* The variable of the linked program that `name` is probably meant to be: of a similar name, and
 * not one that the caller knows. Empty if there is none. */
static void find_similar(const Shader *shader, const char *name, const ShaderLocation *known,
                         char similar[NAME_SIZE])
{
    const bool attribute = is_attribute(name);
    GLint count = 0;
    similar[0] = '\0';
    glGetProgramiv(shader->program, attribute ? GL_ACTIVE_ATTRIBUTES : GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count && !similar[0]; i++) {
        char active[NAME_SIZE] = "";
        const char *names[] = {active, NULL};
        GLint size;
        GLenum type;
        (attribute ? glGetActiveAttrib : glGetActiveUniform)(shader->program, (GLuint)i, NAME_SIZE,
                                                             NULL, &size, &type, active);
        bool taken = !text_nearest(name, names);
        for (const ShaderLocation *other = known; other->name; other++)
            taken |= strcmp(other->name, active) == 0;
        if (!taken)
            memcpy(similar, active, NAME_SIZE);
    }
}

static bool missing(const Shader *shader, const char *kind, const char *name, Message *message)
{
    static const ShaderLocation unknown[] = {{NULL, NULL}};
    char similar[NAME_SIZE];
    find_similar(shader, name, unknown, similar);
    return message_set(message,
                       "%s: the linked program has no %s %s: it is not declared, or no output "
                       "depends on it%s%s",
                       shader->name, kind, name, similar[0] ? "; there is " : "", similar);
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

/* Adds a clause to the warning, which begins with the place of the first variable in it. */
static void warn_of_missing(const Shader *shader, const char *name, const ShaderLocation *known)
{
    const ShaderSource *vertex = &shader->sources[SHADER_VERTEX];
    const ShaderSource *fragment = &shader->sources[SHADER_FRAGMENT];
    Message *warning = shader->warning;
    char similar[NAME_SIZE];
    Declaration found;
    find_similar(shader, name, known, similar);
    const char *there = similar[0] ? similar : name;
    const bool declared = find_declaration(vertex, there, (int)strlen(there), &found) ||
                          find_declaration(fragment, there, (int)strlen(there), &found);
    if (warning->text[0])
        message_add(warning, ", ");
    else if (declared)
        message_add(warning, "%s:%d: warning: ", found.file, found.line);
    else
        message_add(warning, "%s, %s: warning: ", vertex->files[0], fragment->files[0]);
    warning->located = true;
    if (similar[0])
        message_add(warning, "%s: %s?", similar, name);
    else
        message_add(warning, declared ? "%s is not used" : "%s is not declared", name);
}

bool shader_complain(const Shader *shader, const char *variable, const char *text, Message *message)
{
    Declaration found;
    for (int stage = 0; stage < 2 && message && !message->text[0]; stage++) {
        if (!find_declaration(&shader->sources[stage], variable, (int)strlen(variable), &found))
            continue;
        message->located = true;
        return message_set(message, "%s:%d: error: %s", found.file, found.line, text);
    }
    return message_set(message, "%s", text);
}

bool shader_locations(const Shader *shader, const ShaderLocation *locations, Message *message)
{
    for (const ShaderLocation *one = locations; one->name; one++) {
        const bool found = (is_attribute(one->name) ? shader_attribute : shader_uniform)(
            shader, one->name, one->location, shader->warning ? NULL : message);
        if (!found && !shader->warning)
            return false;
        if (!found)
            warn_of_missing(shader, one->name, locations);
    }
    return true;
}

void shader_set_attribute(GLint location, Vec3 value)
{
    float rounded[3];
    vec3_to_float(value, rounded);
    if (location >= 0)
        glVertexAttrib3fv((GLuint)location, rounded);
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
    close_sources(shader);
    *shader = (Shader){0};
}
