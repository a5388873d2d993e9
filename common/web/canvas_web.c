/*
 * The canvas in a browser: a WebGL 2 context on the HTML canvas that the page has put into
 * Module.canvas. It is never shown: pictures are read back and painted, as natively they are
 * written.
 */
#include "core/canvas.h"

#include <emscripten.h>
#include <stdint.h>
#include <string.h>

/* In JavaScript; GL is of Emscripten's library. */
/* clang-format off */
EM_JS(int, context_open, (void), {
    var canvas = Module["canvas"];
    var handle = canvas ? GL.createContext(canvas, {
        majorVersion: 2, minorVersion: 0, alpha: true, depth: false, stencil: false, antialias: false,
        premultipliedAlpha: true, preserveDrawingBuffer: false, enableExtensionsByDefault: true
    }) : 0;
    if (!handle || GL.contexts[handle].GLctx.isContextLost())
        return 0;
    GL.makeContextCurrent(handle);
    /* Of an array's element that no shader uses Emscripten knows a place, WebGL none. */
    var gl = GL.contexts[handle].GLctx, get = gl.getUniform;
    gl.getUniform = function(program, place) { return place ? get.call(gl, program, place) : 0; };
    return handle;
});

EM_JS(int, context_current, (int handle), {
    var context = GL.contexts[handle];
    return context && GL.currentContext === context && !context.GLctx.isContextLost() ? 1 : 0;
});

EM_JS(void, context_close, (int handle), { GL.deleteContext(handle); });
/* clang-format on */

/* ES 2's own, and what of ES 3 the canvas uses. */
#define DECLARE(TYPE, name) extern __typeof__(*(PFNGL##TYPE##PROC)0) emscripten_gl##name;
GL_FUNCTIONS(DECLARE)
#undef DECLARE
extern __typeof__(*(GlRenderbufferStorageMultisample)0) emscripten_glRenderbufferStorageMultisample;
extern __typeof__(*(GlBlitFramebuffer)0) emscripten_glBlitFramebuffer;

static GlFunction web_address(const char *name)
{
    static const struct {
        const char *name;
        GlFunction function;
    } all[] = {
#define ROW(TYPE, name) {"gl" #name, (GlFunction)emscripten_gl##name},
        GL_FUNCTIONS(ROW)
#undef ROW
            {"glRenderbufferStorageMultisample",
             (GlFunction)emscripten_glRenderbufferStorageMultisample},
        {"glBlitFramebuffer", (GlFunction)emscripten_glBlitFramebuffer},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strcmp(all[i].name, name) == 0)
            return all[i].function;
    return NULL;
}

static bool web_open(void **context, const CanvasOptions *options, const char **platform,
                     Message *message)
{
    (void)options;
    const int handle = context_open();
    *platform = "WebGL 2";
    *context = (void *)(intptr_t)handle;
    return handle || message_set(message, "WebGL 2: this browser gives none; the programs need it");
}

static bool web_current(void *context)
{
    return context_current((int)(intptr_t)context) != 0;
}

static void web_close(void *context)
{
    context_close((int)(intptr_t)context);
}

static bool web_probe(Message *findings)
{
    return message_add(findings, "  WebGL 2\n");
}

static const CanvasBackend CANVAS_WEB = {
    .name = "web",
    .summary = "WebGL 2",
    .open = web_open,
    .address = web_address,
    .current = web_current,
    .close = web_close,
    .probe = web_probe,
};

const CanvasBackend *const CANVAS_HEADLESS[] = {&CANVAS_WEB, NULL};
