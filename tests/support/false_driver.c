/*
 * false_driver: a driver that lies about its precision, for tests of programs.
 *
 * An EGL vendor library of GLVND, to be named by __EGL_VENDOR_LIBRARY_FILENAMES: it is Mesa's, but
 * for two functions. LIGHTING_FALSE_DRIVER in the environment says what it does:
 *
 *   highp     claims 23 bits everywhere, and computes highp in fragment shaders as mediump
 *   mediump   claims 10 bits for mediump, and computes it as highp
 *   none      claims to have no highp in fragment shaders, and computes it
 *   more      claims 112 bits everywhere
 *   without   claims 112 bits everywhere, and does not compile highp in fragment shaders
 */
#include <GLES2/gl2.h>

#include <dlfcn.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The beginning of __EGLapiImports (glvnd/libeglabi.h), which is as stable as GLVND's ABI. */
typedef struct Imports {
    void *get_platform_display, *get_supports_api, *get_vendor_string;
    void *(*get_address)(const char *name);
} Imports;
typedef unsigned int Main(uint32_t version, const void *exports, void *vendor, Imports *imports);

Main __egl_Main __attribute__((visibility("default")));

static void *(*address)(const char *name); /* Mesa's */

static const char *lie(void)
{
    const char *name = getenv("LIGHTING_FALSE_DRIVER");
    return name ? name : "";
}

static void claim(GLenum stage, GLenum type, GLint *range, GLint *precision)
{
    const GLint half[] = {15, 15, 10}, single[] = {127, 127, 23}, quad[] = {16383, 16383, 112},
                nothing[] = {0, 0, 0};
    const GLint *claimed = strcmp(lie(), "highp") == 0 ? single : quad;
    if (strcmp(lie(), "mediump") == 0)
        claimed = type == GL_MEDIUM_FLOAT ? half : single;
    else if (strcmp(lie(), "none") == 0)
        claimed = stage == GL_FRAGMENT_SHADER && type == GL_HIGH_FLOAT ? nothing : single;
    memcpy(range, claimed, 2 * sizeof *range);
    *precision = claimed[2];
}

/* Copies `text` to `to`, with all `from` replaced. Returns the end. */
static char *replace(char *to, const char *text, const char *from, const char *by)
{
    for (const char *found; (found = strstr(text, from)); text = found + strlen(from)) {
        memcpy(to, text, (size_t)(found - text));
        to += found - text;
        memcpy(to, by, strlen(by));
        to += strlen(by);
    }
    memcpy(to, text, strlen(text) + 1);
    return to + strlen(text);
}

/* The whole source of a shader, as its driver computes it. */
static void source(GLuint shader, GLsizei count, const GLchar *const *texts, const GLint *lengths)
{
    const PFNGLSHADERSOURCEPROC given = (PFNGLSHADERSOURCEPROC)address("glShaderSource");
    const PFNGLGETSHADERIVPROC ask = (PFNGLGETSHADERIVPROC)address("glGetShaderiv");
    GLint type = 0;
    size_t size = 1;
    ask(shader, GL_SHADER_TYPE, &type);
    const bool without = strcmp(lie(), "without") == 0;
    const char *from = without || strcmp(lie(), "highp") == 0 ? "highp"
                       : strcmp(lie(), "mediump") == 0        ? "mediump"
                                                              : NULL;
    const char *by = without ? "unknown" : strcmp(lie(), "highp") == 0 ? "mediump" : "highp";
    if (type != GL_FRAGMENT_SHADER || !from)
        return given(shader, count, texts, lengths);
    for (GLsizei i = 0; i < count; i++)
        size += lengths && lengths[i] >= 0 ? (size_t)lengths[i] : strlen(texts[i]);
    char *whole = malloc(3 * size), *end = whole; /* the text, and that with longer words */
    for (GLsizei i = 0; i < count && whole; i++) {
        const size_t length = lengths && lengths[i] >= 0 ? (size_t)lengths[i] : strlen(texts[i]);
        memcpy(end, texts[i], length);
        end += length;
    }
    if (whole) {
        *end++ = '\0';
        const char *changed = end;
        replace(end, whole, from, by);
        given(shader, 1, &changed, NULL);
    }
    free(whole);
}

static void *lying_address(const char *name)
{
    void *true_one = address(name);
    if (true_one && strcmp(name, "glGetShaderPrecisionFormat") == 0)
        return (void *)(uintptr_t)claim;
    if (true_one && strcmp(name, "glShaderSource") == 0)
        return (void *)(uintptr_t)source;
    return true_one;
}

unsigned int __egl_Main(uint32_t version, const void *exports, void *vendor, Imports *imports)
{
    void *mesa = dlopen("libEGL_mesa.so.0", RTLD_NOW | RTLD_LOCAL);
    Main *begin = mesa ? (Main *)(uintptr_t)dlsym(mesa, "__egl_Main") : NULL;
    if (!begin || !begin(version, exports, vendor, imports))
        return 0;
    address = imports->get_address;
    imports->get_address = lying_address;
    return 1;
}
