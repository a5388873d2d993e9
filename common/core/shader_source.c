/*
 * A shader is assembled like C's preprocessor does it, but only for #include: the driver resolves
 * all else. Each file's lines are copied one by one; an #include is replaced by the lines of its
 * file, by recursion, and #line directives around them keep the numbers right. Every file has a
 * number, in the order of first inclusion, and #line carries it as the source string, so that a
 * driver's "2:14: error" becomes "part.glsl:14". Comments are followed only as far as to know
 * whether a line begins inside one, where a directive is none.
 *
 * A tree of n files that include each other may have 2^n lines, and a file may include itself: the
 * chain of files being read is compared with each included one, and three limits (includes, depth,
 * bytes) end all else. No GL.
 */
#include "core/shader_source.h"

#include "base/memory.h"
#include "base/paths.h"
#include "base/text.h"
#include "core/shader_files.h"

#include <ctype.h>
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
        source->text = memory_grow(source->text, capacity, 1);
        assembly->capacity = capacity;
    }
    memcpy(source->text + source->size, text, size);
    source->size += size;
    source->text[source->size] = '\0';
    return true;
}

_Static_assert((int)SHADER_LINES_OF_FILE > (int)SHADER_FILE_MAX, "each line has at least a byte");

static bool append_line_directive(Assembly *assembly, int line, int file)
{
    char text[64];
    const int length =
        snprintf(text, sizeof text, "#line %d %d\n", file * SHADER_LINES_OF_FILE + line, file);
    return append(assembly, text, (size_t)length);
}

/* The number of a path, the same for each inclusion. */
static int file_number(ShaderSource *source, const char *path)
{
    for (int i = 0; i < source->file_count; i++)
        if (strcmp(source->files[i], path) == 0)
            return i;
    source->files =
        memory_grow(source->files, (size_t)source->file_count + 1, sizeof *source->files);
    source->files[source->file_count] = memory_text(path);
    return source->file_count++;
}

/* Files. */

/* A file that is searched, and what is found of it. */
typedef struct Search {
    ShaderFiles *files;
    char path[PATH_MAX]; /* where it is */
    char *text;          /* a copy, to be freed; NULL: not found */
    size_t size;
    char tried[3000]; /* the paths where it is not */
    Message problem;  /* why one cannot be read, which ends the search */
} Search;

static void set_text(Search *search, const char *text, size_t size)
{
    search->text = memory_copy(text, size);
    search->size = size;
}

/* Looks at the path of a folder, with its slash, and a name. */
static void try_path(Search *search, const char *folder, int length, const char *name)
{
    if (search->text || search->problem.text[0] ||
        snprintf(search->path, PATH_MAX, "%.*s%s", length, folder, name) >= PATH_MAX)
        return;
    const ShaderFile *file = shader_files_get(search->files, search->path);
    const size_t used = strlen(search->tried);
    if (file->problem)
        message_set(&search->problem, "%s", file->problem);
    else if (file->text)
        set_text(search, file->text, file->size);
    else
        snprintf(search->tried + used, sizeof search->tried - used, "\n  tried %s", search->path);
}

/* One entry of the search order. */
typedef struct Place {
    char folder[PATH_MAX + 1]; /* with its slash */
    bool by_name;              /* also look for the file's name alone */
} Place;

enum { MAX_PLACES = 2 + PATHS_PLACE_COUNT };

static int find_places(const ShaderLoader *loader, Place places[MAX_PLACES])
{
    const char *const given[] = {loader->folder, getenv("LIGHTING_SHADERS")};
    int count = 0;
    for (int i = 0; i < 2; i++)
        if (given[i] && (i == 0 || given[i][0])) {
            snprintf(places[count].folder, PATH_MAX, "%s", given[i]);
            places[count++].by_name = true;
        }
    for (int i = 0; i < PATHS_PLACE_COUNT; i++)
        if (paths_data((PathsPlace)i, "shaders", "shaders", places[count].folder))
            places[count++].by_name = false;
    for (int i = 0; i < count; i++)
        strcat(places[i].folder, "/");
    return count;
}

static bool is_folder(const ShaderLoader *loader, const char *path)
{
    struct stat status;
    if (loader->files) /* recorded, so that the owner notices when it appears or disappears */
        shader_files_get(loader->files, path);
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

static const char *replacement(const ShaderLoader *loader, const char *name)
{
    for (const ShaderReplacement *r = loader->replacements; r && r->name; r++)
        if (strcmp(r->name, name) == 0)
            return r->by;
    return name;
}

/* Finds and reads `name`, first in memory. */
static bool find_file(Search *search, const ShaderLoader *loader, const char *name,
                      const char *from, Message *message)
{
    *search = (Search){.files = loader->files};
    name = replacement(loader, name);
    for (const ShaderText *made = loader->texts; made && made->name; made++) {
        if (strcmp(made->name, name) != 0)
            continue;
        set_text(search, made->text, strlen(made->text));
        snprintf(search->path, PATH_MAX, "%s", name);
        return true;
    }
    if (loader->only_texts)
        return message_set(message, "%s: no such file beside it", name);
    /* Looks beside the file `from`, unless that is NULL, and where all shaders are. */
    const char *slash = from ? strrchr(from, '/') : NULL, *last = strrchr(name, '/');
    const bool absolute = name[0] == '/';
    Place places[MAX_PLACES];
    const int count = absolute ? 0 : find_places(loader, places);
    if (from || absolute)
        try_path(search, from ? from : "", slash && !absolute ? (int)(slash - from) + 1 : 0, name);
    for (int i = 0; i < count; i++) {
        try_path(search, places[i].folder, PATH_MAX, name);
        if (places[i].by_name && last)
            try_path(search, places[i].folder, PATH_MAX, last + 1);
    }
    if (search->problem.text[0])
        return message_set(message, "%s", search->problem.text);
    return search->text || message_set(message, "%s: no such shader file%s", name, search->tried);
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

/* Whether a line ends a part of a condition that may be left out; counts those that are open. */
static bool ends_part(const char *line, size_t length, int *open)
{
    static const char *const WORDS[] = {"if", "ifdef", "ifndef", "else", "elif", "endif"};
    size_t rest;
    for (int i = 0; i < 6; i++)
        if (directive(line, length, WORDS[i], &rest)) {
            *open += i < 3 ? 1 : i == 5 ? -1 : 0;
            return i >= 3;
        }
    return false;
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
    char name[256];
    if (argument[0] != '"' || !end || end == argument + 1 || end - argument > 255)
        return located(assembly->message, path, line,
                       "#include needs a file's name in double quotes");
    memcpy(name, argument + 1, (size_t)(end - argument) - 1);
    name[end - argument - 1] = '\0';

    Search found;
    Message reason = {0};
    if (!find_file(&found, assembly->loader, name, path, &reason))
        return located(assembly->message, path, line, reason.text);
    const bool allowed = check_chain(assembly, found.path, &reason);
    assembly->includes++;
    const bool done = allowed
                          ? clean_text(found.text, &found.size, found.path, assembly->message) &&
                                assemble(assembly, found.path, found.text, found.size)
                          : located(assembly->message, path, line, reason.text);
    free(found.text);
    return done;
}

/* Appends a file's lines and its includes. */
static bool assemble(Assembly *assembly, const char *path, const char *text, size_t size)
{
    const int file = file_number(assembly->source, path);
    if (!append_line_directive(assembly, 1, file))
        return false;
    assembly->chain[assembly->depth++] = file;

    bool in_comment = false, included = false;
    int number = 0, open = 0;
    for (const char *line = text, *end = text + size; line < end;) {
        const char *newline = memchr(line, '\n', (size_t)(end - line));
        const size_t length = newline ? (size_t)(newline - line) : (size_t)(end - line);
        size_t rest = 0;
        const char *argument;
        bool removed = false;
        const bool ended = !in_comment && ends_part(line, length, &open);
        number++;
        if (!in_comment && (argument = directive(line, length, "include", &rest))) {
            if (!include(assembly, path, number, argument, rest) ||
                !append_line_directive(assembly, number, file))
                return false;
            removed = included = true;
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
        /* The #line after an include counts only where the include does. */
        if (included && ended && !in_comment && !append_line_directive(assembly, number + 1, file))
            return false;
        included &= open > 0;
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

/* Of a file that was found, whose text it frees; `loader` has a cache of files. */
static bool parse(ShaderSource *source, const ShaderLoader *loader, Search *found,
                  ShaderStage stage, Message *message)
{
    Assembly assembly = {.loader = loader, .source = source, .message = message};
    const bool done = clean_text(found->text, &found->size, found->path, message) &&
                      file_number(source, found->path) == 0 && append_header(&assembly, stage) &&
                      assemble(&assembly, found->path, found->text, found->size);
    free(found->text);
    if (!done)
        shader_source_close(source);
    return done;
}

/* The loader, or a copy with the cache `own`. */
static ShaderLoader with_files(const ShaderLoader *loader, ShaderFiles *own)
{
    ShaderLoader caching = *loader;
    if (!caching.files)
        caching.files = own;
    return caching;
}

bool shader_source_open(ShaderSource *source, const ShaderLoader *loader, const char *name,
                        ShaderStage stage, Message *message)
{
    ShaderFiles own = {0};
    const ShaderLoader caching = with_files(loader, &own);
    Search found;
    *source = (ShaderSource){0};
    const bool done = find_file(&found, &caching, name, NULL, message) &&
                      parse(source, &caching, &found, stage, message);
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

void shader_warn_of_color(const ShaderSource *fragment, Message *warning)
{
    char *text = memory_text(fragment->text);
    text_strip_comments(text);
    if (!strstr(text, "gl_FragColor") && !strstr(text, "gl_FragData")) {
        message_add(warning, "%s: warning: gl_FragColor is never written: any colour may be drawn",
                    fragment->files[0]);
        warning->located = true;
    }
    free(text);
}
