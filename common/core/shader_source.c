/*
 * Shader preprocessing, no GL: finds files, resolves #include, emits #line, maps driver logs to
 * file:line.
 */
#include "core/shader_source.h"

#include "base/paths.h"
#include "base/text.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    MAX_INCLUDES = 1000,
    MAX_DEPTH = 32,     /* of includes */
    MAX_TEXT = 4 << 20, /* of a whole shader: nested includes can grow exponentially */
};

/* A shader being assembled. */
typedef struct Assembly {
    const ShaderLoader *loader;
    ShaderSource *source;
    size_t capacity;
    int chain[MAX_DEPTH]; /* files being read, outermost first, as numbers in source->files */
    int depth;
    int includes;
    Message *message;
} Assembly;

/* Text. */

static bool append(Assembly *assembly, const char *text, size_t size)
{
    ShaderSource *source = assembly->source;
    if (source->size + size > MAX_TEXT)
        return message_set(assembly->message, "%s: with its includes longer than %d bytes",
                           source->files[0], MAX_TEXT);
    if (source->size + size + 1 > assembly->capacity) {
        const size_t capacity = 2 * (source->size + size) + 4096;
        char *larger = realloc(source->text, capacity);
        if (!larger)
            return message_set(assembly->message, "%s: not enough memory", source->files[0]);
        source->text = larger;
        assembly->capacity = capacity;
    }
    memcpy(source->text + source->size, text, size);
    source->size += size;
    source->text[source->size] = '\0';
    return true;
}

/* Line numbers encode the file, a million lines each, because Mesa reports the source string only
 * for syntax errors: "#line 1000003 1" is line 3 of file 1. */
enum { LINES_OF_FILE = SHADER_FILE_MAX + 1 };

static bool append_line_directive(Assembly *assembly, int line, int file)
{
    char text[64];
    const int length =
        snprintf(text, sizeof text, "#line %d %d\n", file * LINES_OF_FILE + line, file);
    return append(assembly, text, (size_t)length);
}

/* The number of a path, the same for each inclusion; -1 if out of memory. */
static int file_number(Assembly *assembly, const char *path)
{
    ShaderSource *source = assembly->source;
    for (int i = 0; i < source->file_count; i++)
        if (strcmp(source->files[i], path) == 0)
            return i;
    char **files = realloc(source->files, ((size_t)source->file_count + 1) * sizeof *files);
    char *copy = files ? strdup(path) : NULL;
    if (files)
        source->files = files;
    if (!copy) {
        message_set(assembly->message, "%s: not enough memory", path);
        return -1;
    }
    source->files[source->file_count] = copy;
    return source->file_count++;
}

/* Files. */

/* A copy of the text at a path. On failure *text is NULL; a missing file sets *missing and no
 * message. */
static bool read_file(ShaderFiles *files, const char *path, char **text, size_t *size,
                      bool *missing, Message *message)
{
    *text = NULL;
    *missing = false;
    const ShaderFile *file = shader_files_get(files, path, message);
    if (!file)
        return false;
    if (file->problem)
        return message_set(message, "%s", file->problem);
    *missing = !file->text;
    if (*missing)
        return false;
    *size = file->size;
    *text = malloc(file->size + 1);
    if (!*text)
        return message_set(message, "%s: not enough memory", path);
    memcpy(*text, file->text, file->size + 1);
    return true;
}

/* One entry of the search order. */
typedef struct Place {
    char folder[PATH_MAX];
    bool by_name; /* also look for the file's name alone */
} Place;

enum { MAX_PLACES = 2 + PATHS_PLACE_COUNT };

static int find_places(const ShaderLoader *loader, Place places[MAX_PLACES])
{
    int count = 0;
    const char *environment = getenv("LIGHTING_SHADERS");
    if (loader->folder)
        snprintf(places[count].folder, PATH_MAX, "%s", loader->folder),
            places[count++].by_name = true;
    if (environment && environment[0])
        snprintf(places[count].folder, PATH_MAX, "%s", environment), places[count++].by_name = true;
    for (int i = 0; i < PATHS_PLACE_COUNT; i++)
        if (paths_data((PathsPlace)i, "shaders", "shaders", places[count].folder))
            places[count++].by_name = false;
    return count;
}

static bool is_folder(const ShaderLoader *loader, const char *path)
{
    struct stat status;
    if (loader->files) /* recorded, so that the owner notices when it appears or disappears */
        shader_files_get(loader->files, path, NULL);
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

bool shader_loader_check(const ShaderLoader *loader, Message *message)
{
    const char *environment = getenv("LIGHTING_SHADERS");
    if (loader->folder && !is_folder(loader, loader->folder))
        return message_set(message, "%s: no such shader folder", loader->folder);
    if (environment && environment[0] && !is_folder(loader, environment))
        return message_set(message,
                           "LIGHTING_SHADERS=%s: there is no such folder; correct or unset it",
                           environment);
    return true;
}

/* Tries one path; appends it to `tried` if it is missing. */
static bool try_file(ShaderFiles *files, const char *path, char **text, size_t *size, char *tried,
                     size_t tried_size, Message *message)
{
    bool missing;
    if (read_file(files, path, text, size, &missing, message))
        return true;
    const size_t used = strlen(tried);
    if (missing)
        snprintf(tried + used, tried_size - used, "\n  tried %s", path);
    return false;
}

/* Finds and reads `name`, first beside the file `from` unless that is NULL. */
static bool find_file(const ShaderLoader *loader, const char *name, const char *from,
                      char path[PATH_MAX], char **text, size_t *size, Message *message)
{
    for (const ShaderReplacement *r = loader->replacements; r && r->name; r++) {
        if (strcmp(r->name, name) == 0) {
            name = r->by;
            break;
        }
    }
    for (const ShaderText *made = loader->texts; made && made->name; made++) {
        if (strcmp(made->name, name) != 0)
            continue;
        *size = strlen(made->text);
        *text = strdup(made->text);
        snprintf(path, PATH_MAX, "%s", name);
        return *text ? true : message_set(message, "%s: not enough memory", name);
    }
    if (loader->only_texts)
        return message_set(message, "%s: no such file beside it", name);

    char tried[3000] = "";
    Message own = {0};
    const char *slash = from ? strrchr(from, '/') : NULL;
    const char *last = strrchr(name, '/');
    Place places[MAX_PLACES];
    const int count = name[0] == '/' ? 0 : find_places(loader, places);
    *text = NULL;

    bool found = false;
    if (from || name[0] == '/') {
        const int folder = slash && name[0] != '/' ? (int)(slash - from) + 1 : 0;
        if (snprintf(path, PATH_MAX, "%.*s%s", folder, from ? from : "", name) < PATH_MAX)
            found = try_file(loader->files, path, text, size, tried, sizeof tried, &own);
    }
    for (int i = 0; i < count && !found && !own.text[0]; i++) {
        if (snprintf(path, PATH_MAX, "%s/%s", places[i].folder, name) < PATH_MAX)
            found = try_file(loader->files, path, text, size, tried, sizeof tried, &own);
        if (!found && !own.text[0] && places[i].by_name && last &&
            snprintf(path, PATH_MAX, "%s/%s", places[i].folder, last + 1) < PATH_MAX)
            found = try_file(loader->files, path, text, size, tried, sizeof tried, &own);
    }
    if (found)
        return true;
    if (own.text[0])
        return message_set(message, "%s", own.text);
    return message_set(message, "%s: no such shader file%s", name, tried);
}

/* Lines. */

static bool located(Message *message, const char *path, int line, const char *text)
{
    if (message && !message->text[0])
        message->located = true;
    return message_set(message, "%s:%d: %s", path, line, text);
}

/* Rejects zeros and control characters; CRLF and CR become LF. */
static bool clean_text(char *text, size_t *size, const char *path, Message *message)
{
    size_t from = 0, to = 0;
    bool blank = true;
    int line = 1;
    if (*size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0)
        from = 3; /* byte order mark */
    for (; from < *size; from++) {
        unsigned char c = (unsigned char)text[from];
        if (c == '\r') {
            if (from + 1 < *size && text[from + 1] == '\n')
                continue;
            c = '\n';
        }
        if ((c < 32 && !isspace(c)) || c == 127) {
            char what[64];
            snprintf(what, sizeof what, "byte 0x%02X: the file is not text", c);
            return located(message, path, line, what);
        }
        blank = blank && isspace(c);
        line += c == '\n';
        text[to++] = (char)c;
    }
    *size = to;
    if (blank)
        return located(message, path, 1, "the file is empty");
    return true;
}

/* Whether a comment that is open at the start of a line is still open at its end. */
static bool comment_after(const char *line, size_t length, bool inside)
{
    for (size_t i = 0; i < length; i++) {
        const char next = i + 1 < length ? line[i + 1] : '\0';
        if (inside && line[i] == '*' && next == '/') {
            inside = false;
            i++;
        } else if (!inside && line[i] == '/' && next == '*') {
            inside = true;
            i++;
        } else if (!inside && line[i] == '/' && next == '/') {
            return false;
        }
    }
    return inside;
}

/* The argument of "# name argument", or NULL if the line is no such directive. */
static const char *directive(const char *line, size_t length, const char *name, size_t *rest)
{
    size_t i = 0;
    while (i < length && isspace((unsigned char)line[i]))
        i++;
    if (i == length || line[i++] != '#')
        return NULL;
    while (i < length && isspace((unsigned char)line[i]))
        i++;
    const size_t n = strlen(name);
    if (length - i < n || strncmp(line + i, name, n) != 0)
        return NULL;
    i += n;
    if (i < length && text_is_word(line[i]))
        return NULL;
    while (i < length && isspace((unsigned char)line[i]))
        i++;
    *rest = length - i;
    return line + i;
}

static bool assemble(Assembly *assembly, const char *path, const char *text, size_t size);

/* Whether the files being read may include a file. */
static bool check_chain(const Assembly *assembly, const char *path, Message *message)
{
    char **files = assembly->source->files;
    for (int i = 0; i < assembly->depth; i++) {
        const char *reading = files[assembly->chain[i]];
        if (strcmp(reading, path) != 0 &&
            !shader_files_same(assembly->loader->files, reading, path))
            continue;
        message_set(message, "%s: includes itself", path);
        for (int j = i + 1; j < assembly->depth; j++)
            message_add(message, "%s%s", j == i + 1 ? ", through " : " and ",
                        files[assembly->chain[j]]);
        return false;
    }
    if (assembly->includes == MAX_INCLUDES)
        return message_set(message, "%s: exceeds the limit of %d includes", path, MAX_INCLUDES);
    if (assembly->depth == MAX_DEPTH)
        return message_set(message, "%s: included more than %d deep", path, MAX_DEPTH);
    return true;
}

static bool include(Assembly *assembly, const char *path, int line, const char *argument,
                    size_t length)
{
    const char *end = length > 1 ? memchr(argument + 1, '"', length - 1) : NULL;
    char name[PATH_MAX], found[PATH_MAX];
    if (argument[0] != '"' || !end || end == argument + 1 || end - argument > 255)
        return located(assembly->message, path, line,
                       "#include needs a file's name in double quotes");
    memcpy(name, argument + 1, (size_t)(end - argument) - 1);
    name[end - argument - 1] = '\0';

    char *text;
    size_t size;
    Message reason = {0};
    if (!find_file(assembly->loader, name, path, found, &text, &size, &reason))
        return located(assembly->message, path, line, reason.text);
    const bool allowed = check_chain(assembly, found, &reason);
    assembly->includes++;
    const bool done = allowed ? clean_text(text, &size, found, assembly->message) &&
                                    assemble(assembly, found, text, size)
                              : located(assembly->message, path, line, reason.text);
    free(text);
    return done;
}

/* Appends a file's lines and its includes. */
static bool assemble(Assembly *assembly, const char *path, const char *text, size_t size)
{
    const int file = file_number(assembly, path);
    if (file < 0 || !append_line_directive(assembly, 1, file))
        return false;
    assembly->chain[assembly->depth++] = file;

    bool in_comment = false;
    int number = 0;
    for (const char *line = text, *end = text + size; line < end;) {
        const char *newline = memchr(line, '\n', (size_t)(end - line));
        const size_t length = newline ? (size_t)(newline - line) : (size_t)(end - line);
        size_t rest = 0;
        const char *argument;
        bool removed = false;
        number++;
        if (!in_comment && (argument = directive(line, length, "include", &rest))) {
            if (!include(assembly, path, number, argument, rest) ||
                !append_line_directive(assembly, number, file))
                return false;
            removed = true;
        } else if (!in_comment && (argument = directive(line, length, "version", &rest))) {
            if (rest < 3 || strncmp(argument, "100", 3) != 0 ||
                (rest > 3 && !isspace((unsigned char)argument[3])))
                return located(assembly->message, path, number,
                               "only #version 100, GLSL ES 1.00, runs everywhere here");
            removed = true; /* already the first line */
        } else if (directive(line, length, "line", &rest)) {
            /* Removed: line numbers are the file's. */
            removed = !in_comment;
            if (in_comment &&
                !append(assembly, " ", 1)) /* or find_line would take it for one of ours */
                return false;
        }
        in_comment = comment_after(line, length, in_comment);
        if (removed) {
            /* Keep a comment that begins after it. */
            if (!append(assembly, in_comment ? "/*\n" : "\n", in_comment ? 3 : 1))
                return false;
        } else if (!append(assembly, line, length) || !append(assembly, "\n", 1)) {
            return false;
        }
        line += length + (newline ? 1 : 0);
    }
    assembly->depth--;
    return true;
}

static bool append_header(Assembly *assembly, ShaderStage stage)
{
    const ShaderLoader *loader = assembly->loader;
    if (!append(assembly, "#version 100\n", 13))
        return false;
    if (stage == SHADER_FRAGMENT && loader->precision) {
        const bool high = strcmp(loader->precision, "highp") == 0;
        const char *text = high ? "#define mediump highp\n" : "#define highp mediump\n";
        if (!append(assembly, text, strlen(text)))
            return false;
    }
    for (const char *const *define = loader->defines; define && *define; define++)
        if (!append(assembly, "#define ", 8) || !append(assembly, *define, strlen(*define)) ||
            !append(assembly, "\n", 1))
            return false;
    return true;
}

/* `loader` has a cache of files. */
static bool parse(ShaderSource *source, const ShaderLoader *loader, const char *path,
                  const char *text, size_t size, ShaderStage stage, Message *message)
{
    *source = (ShaderSource){0};
    Assembly assembly = {.loader = loader, .source = source, .message = message};
    char *copy = malloc(size + 1);
    if (!copy)
        return message_set(message, "%s: not enough memory", path);
    memcpy(copy, text, size);
    const bool done = clean_text(copy, &size, path, message) && file_number(&assembly, path) == 0 &&
                      append_header(&assembly, stage) && assemble(&assembly, path, copy, size);
    free(copy);
    if (!done)
        shader_source_close(source);
    return done;
}

/* The loader, or a copy with the cache `own`. */
static ShaderLoader with_files(const ShaderLoader *loader, ShaderFiles *own)
{
    ShaderLoader caching = *loader;
    *own = (ShaderFiles){0};
    if (!caching.files)
        caching.files = own;
    return caching;
}

bool shader_source_parse(ShaderSource *source, const ShaderLoader *loader, const char *path,
                         const char *text, size_t size, ShaderStage stage, Message *message)
{
    ShaderFiles own;
    const ShaderLoader caching = with_files(loader, &own);
    const bool done = parse(source, &caching, path, text, size, stage, message);
    shader_files_close(&own);
    return done;
}

bool shader_source_open(ShaderSource *source, const ShaderLoader *loader, const char *name,
                        ShaderStage stage, Message *message)
{
    char path[PATH_MAX], *text;
    size_t size;
    ShaderFiles own;
    const ShaderLoader caching = with_files(loader, &own);
    *source = (ShaderSource){0};
    bool done = find_file(&caching, name, NULL, path, &text, &size, message);
    if (done) {
        done = parse(source, &caching, path, text, size, stage, message);
        free(text);
    }
    shader_files_close(&own);
    return done;
}

void shader_source_close(ShaderSource *source)
{
    if (!source)
        return;
    for (int i = 0; i < source->file_count; i++)
        free(source->files[i]);
    free(source->files);
    free(source->text);
    *source = (ShaderSource){0};
}

/* The driver's log. */

bool shader_line_directive(const char *text, int *file, int *line)
{
    char *end;
    if (strncmp(text, "#line ", 6) != 0)
        return false;
    *line = (int)(strtol(text + 6, &end, 10) % LINES_OF_FILE);
    *file = (int)strtol(end, &end, 10);
    return true;
}

/* Line `line` of source string `file`, found by following our own #line directives. */
static const char *find_line(const ShaderSource *source, int file, int line, int *length)
{
    int at_file = -1, at_line = 0;
    for (const char *p = source->text; p && *p;) {
        const char *newline = strchr(p, '\n');
        const int n = newline ? (int)(newline - p) : (int)strlen(p);
        if (!shader_line_directive(p, &at_file, &at_line)) {
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
    int used = 0, column = 0;
    if (strncmp(log, "ERROR: ", 7) == 0)
        log += 7;
    else if (strncmp(log, "WARNING: ", 9) == 0)
        log += 9;
    const bool found = (sscanf(log, "%d:%d(%d):%n", file, line, &column, &used) == 3 && used) ||
                       (sscanf(log, "%d:%d:%n", file, line, &used) == 2 && used) ||
                       (sscanf(log, "%d(%d) :%n", file, line, &used) == 2 && used);
    if (found && *line > LINES_OF_FILE) {
        *file = *line / LINES_OF_FILE;
        *line %= LINES_OF_FILE;
    }
    return found ? log + used : NULL;
}

static void show_line(const ShaderSource *source, int file, int line, Message *message)
{
    int length;
    const char *text = find_line(source, file, line, &length);
    if (text)
        message_add(message, "\n  %d | %.*s", line, length < 200 ? length : 200, text);
}

/* ANGLE's place of what is missing. */
static const char NOWHERE[] = "ERROR: -1:-1: ";

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
        } else if (strncmp(log, NOWHERE, strlen(NOWHERE)) == 0) {
            message_add(message, "%s%s: %.*s", separator, source->files[0],
                        length - (int)strlen(NOWHERE), log + strlen(NOWHERE));
        } else if (length > 0) {
            message_add(message, "%s%.*s", separator, length, log);
        }
        log += length + (newline ? 1 : 0);
    }
    return false;
}
