#include "core/shader_folder.h"

ShaderLoader loader;
ShaderSource source;
Message failure;

int enter_folder(void **state)
{
    unsetenv("LIGHTING_SHADERS");
    loader = (ShaderLoader){.folder = "."};
    return testing_enter_folder(state);
}

int leave_folder(void **state)
{
    shader_source_close(&source);
    return testing_leave_folder(state);
}

bool load(const char *name)
{
    shader_source_close(&source);
    failure = (Message){0};
    return shader_source_open(&source, &loader, name, SHADER_VERTEX, &failure);
}

void found(const char *name, const char *path)
{
    if (!load(name))
        fail_msg("%s: %s", name, failure.text);
    assert_string_equal(source.files[0], path);
    assert_int_equal(source.size, strlen(source.text));
}

void refused(const char *name, const char *start, const char *said)
{
    if (load(name))
        fail_msg("accepted: %s", name);
    if (strncmp(failure.text, start, strlen(start)) != 0 || !strstr(failure.text, said))
        fail_msg("%s: expected \"%s... %s\" in \"%s\"", name, start, said, failure.text);
    assert_null(source.text);
    assert_null(source.files);
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

void text_is(const char *expected)
{
    char *plain = squeeze(source.text), *wanted = squeeze(expected);
    assert_string_equal(plain, wanted);
    free(plain);
    free(wanted);
}

void driver_place(const char *line, int *file, int *number)
{
    *file = 0;
    *number = 1;
    for (const char *p = source.text; p < line; p += strcspn(p, "\n") + 1)
        if (sscanf(p, "#line %d %d", number, file) != 2)
            ++*number;
}

void make_tree(int broken_file, int broken_line, const char *broken)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (int file = 0; file < FILES; file++) {
        const char *end = ends[rand() % 3];
        char text[2048] = "";
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
        make(formatted("part%d.glsl", file), text);
    }
}
