/* Each function's pointer, by name; those of extensions only if the context lists the extension. */
#include "core/gl.h"

#include "base/text.h"

#include <string.h>

#define GL_DEFINE(TYPE, name) PFNGL##TYPE##PROC gl##name;
GL_FUNCTIONS(GL_DEFINE)
#undef GL_DEFINE
#define GL_DEFINE(TYPE, name) PFNGL##TYPE##EXTPROC gl##name##EXT;
GL_TIMER_FUNCTIONS(GL_DEFINE)
#undef GL_DEFINE
#define GL_DEFINE(TYPE, name) PFNGL##TYPE##OESPROC gl##name##OES;
GL_BINARY_FUNCTIONS(GL_DEFINE)
#undef GL_DEFINE
GlRenderbufferStorageMultisample glRenderbufferStorageMultisample;
GlBlitFramebuffer glBlitFramebuffer;
PFNGLGETGRAPHICSRESETSTATUSEXTPROC glGetGraphicsResetStatus;

bool gl_load(GlFunction (*address)(const char *name), Message *message)
{
#define GL_LOAD(TYPE, name)                                                                        \
    gl##name = (PFNGL##TYPE##PROC)address("gl" #name);                                             \
    if (!gl##name)                                                                                 \
        return message_set(message, "OpenGL ES 2: the driver has no gl" #name);
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD

    /* A driver may return a stub for a function that the context lacks: check the context, not the
     * pointer. */
    const bool es3 = gl_version() >= 30;
    glRenderbufferStorageMultisample = NULL;
    glBlitFramebuffer = NULL;
    if (es3) {
        glRenderbufferStorageMultisample =
            (GlRenderbufferStorageMultisample)address("glRenderbufferStorageMultisample");
        glBlitFramebuffer = (GlBlitFramebuffer)address("glBlitFramebuffer");
    } else if (gl_has("GL_ANGLE_framebuffer_multisample") && gl_has("GL_ANGLE_framebuffer_blit")) {
        glRenderbufferStorageMultisample =
            (GlRenderbufferStorageMultisample)address("glRenderbufferStorageMultisampleANGLE");
        glBlitFramebuffer = (GlBlitFramebuffer)address("glBlitFramebufferANGLE");
    }
    const char *reset = gl_has("GL_EXT_robustness")    ? "glGetGraphicsResetStatusEXT"
                        : !gl_has("GL_KHR_robustness") ? NULL
                        : gl_desktop()                 ? "glGetGraphicsResetStatus"
                                                       : "glGetGraphicsResetStatusKHR";
    glGetGraphicsResetStatus = reset ? (PFNGLGETGRAPHICSRESETSTATUSEXTPROC)address(reset) : NULL;
    const bool timer = gl_has("GL_EXT_disjoint_timer_query");
#define GL_LOAD(TYPE, name)                                                                        \
    gl##name##EXT = timer ? (PFNGL##TYPE##EXTPROC)address("gl" #name "EXT") : NULL;
    GL_TIMER_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    const bool binaries = gl_has("GL_OES_get_program_binary");
#define GL_LOAD(TYPE, name)                                                                        \
    gl##name##OES = binaries ? (PFNGL##TYPE##OESPROC)address("gl" #name "OES") : NULL;
    GL_BINARY_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return true;
}

int gl_version(void)
{
    const char *text = (const char *)glGetString(GL_VERSION);
    int version[2];
    if (!text)
        return 0;
    if (text_numbers(text, "OpenGL ES #.#", version))
        return 10 * version[0] + version[1];
    return text_numbers(text, "#.#", version) && version[0] >= 3 ? 30 : 20;
}

bool gl_desktop(void)
{
    const char *text = (const char *)glGetString(GL_VERSION);
    return text && strncmp(text, "OpenGL ES", 9) != 0;
}

bool gl_draws_floats(void)
{
    return gl_version() >= 30 && (gl_desktop() || gl_has("GL_EXT_color_buffer_float"));
}

bool gl_lists(const char *names, const char *name)
{
    const size_t length = strlen(name);
    for (const char *p = names; p && (p = strstr(p, name)); p += length)
        if ((p == names || p[-1] == ' ') && (p[length] == ' ' || p[length] == '\0'))
            return true;
    return false;
}

bool gl_has(const char *extension)
{
    return gl_lists((const char *)glGetString(GL_EXTENSIONS), extension);
}

const char *gl_error_name(GLenum error)
{
    switch (error) {
    case GL_NO_ERROR:
        return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    default:
        return "an unknown GL error";
    }
}

bool gl_is_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "SwiftShader",
                                        "Software Rasterizer"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strstr(renderer, names[i]))
            return true;
    return false;
}

bool gl_probe(GlFunction (*address)(const char *name), Message *findings)
{
    enum { INDENT = 18 };
    Message reason = {0};
    if (!gl_load(address, &reason)) {
        message_add(findings, "%*s no: %s\n", INDENT, "", reason.text);
        return false;
    }
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    message_add(findings, "%*s works: renderer %s (%s), %s%s\n", INDENT, "", renderer,
                gl_is_software(renderer) ? "software" : "hardware", gl_desktop() ? "OpenGL " : "",
                (const char *)glGetString(GL_VERSION));
    return true;
}
