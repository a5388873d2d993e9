/*
 * The first shader that a process compiles takes Mesa 6 to 13 ms, because it first makes all of
 * GLSL's built-in functions; to load a program that was linked before takes a fraction of one.
 * GL_OES_get_program_binary gives the driver's own form of a linked program, with the names and
 * locations of its variables, which the cache (base/cache.h) keeps. Only programs that did link are
 * kept, so errors are found by compiling, each time; and the driver checks that the binary is of
 * this very build of it, so at worst a program is compiled again.
 *
 * A driver is not written to withstand a binary made to harm it: what the cache returns is trusted
 * because nobody but the user can have written it.
 */
#include "core/shader_binary.h"

#include "base/version.h"

#include <stdlib.h>
#include <string.h>

enum { BINARY_MAX = 4 << 20 };

static const char KIND[] = "program";

static void add_text(CacheKey *key, const char *text)
{
    cache_key_add(key, text, text ? strlen(text) : 0);
}

CacheKey shader_binary_key(const ShaderSource sources[2])
{
    static const GLenum names[] = {GL_VENDOR, GL_RENDERER, GL_VERSION};
    CacheKey key = {{0, 0}};
    add_text(&key, VERSION);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        add_text(&key, (const char *)glGetString(names[i]));
    for (int stage = 0; stage < 2; stage++)
        cache_key_add(&key, sources[stage].text, sources[stage].size);
    return key;
}

/* The driver may have the functions and no format. */
static bool has_binaries(void)
{
    GLint formats = 0;
    if (glProgramBinaryOES && glGetProgramBinaryOES)
        glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS_OES, &formats);
    return formats > 0;
}

GLuint shader_binary_open(const CacheKey *key)
{
    size_t size = 0;
    GLenum format;
    GLint linked = GL_FALSE;
    char *kept = has_binaries() ? cache_read(KIND, key, &size) : NULL;
    if (!kept)
        return 0;
    GLuint program = glCreateProgram();
    if (size > sizeof format && size <= BINARY_MAX) {
        memcpy(&format, kept, sizeof format);
        glProgramBinaryOES(program, format, kept + sizeof format, (GLint)(size - sizeof format));
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
    }
    free(kept);
    if (linked)
        return program;
    glGetError(); /* a format that the driver no longer has */
    glDeleteProgram(program);
    return 0;
}

void shader_binary_keep(const CacheKey *key, GLuint program)
{
    GLint size = 0;
    GLsizei length = 0;
    GLenum format = 0;
    if (has_binaries())
        glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH_OES, &size);
    char *kept = size > 0 && size < BINARY_MAX ? malloc(sizeof format + (size_t)size) : NULL;
    if (!kept)
        return;
    glGetProgramBinaryOES(program, size, &length, &format, kept + sizeof format);
    memcpy(kept, &format, sizeof format);
    if (length > 0)
        cache_write(KIND, key, kept, sizeof format + (size_t)length);
    free(kept);
}
