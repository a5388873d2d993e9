/*
 * The OSMesa backend: Mesa's off-screen renderer, without EGL. Its context is desktop OpenGL, whose
 * compatibility profile accepts OpenGL ES 2's functions and shaders that begin with "#version 100".
 * libOSMesa is loaded at run time; Mesa 25.1 removed it. Its header is not included because it
 * brings desktop OpenGL's types.
 */
#include "core/canvas.h"

#include "base/memory.h"
#include "base/plugin.h"

#include <dlfcn.h>
#include <stdlib.h>

#define OSMESA_PACKAGE "libosmesa6"

/* From GL/osmesa.h. */
enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_DEPTH_BITS = 0x30,
    OSMESA_PROFILE = 0x33,
    OSMESA_COMPAT_PROFILE = 0x35,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37,
};
typedef struct osmesa_context *OsmesaHandle;

static struct {
    void *library; /* stays loaded: drivers crash when unloaded */
    OsmesaHandle (*CreateContextAttribs)(const int *attributes, OsmesaHandle shared);
    unsigned char (*MakeCurrent)(OsmesaHandle context, void *buffer, GLenum type, GLsizei width,
                                 GLsizei height);
    OsmesaHandle (*GetCurrentContext)(void);
    GlFunction (*GetProcAddress)(const char *name);
    void (*DestroyContext)(OsmesaHandle context);
} osmesa;

/* OSMesa needs a buffer: one pixel, because the canvas has framebuffers of its own. */
typedef struct OsmesaContext {
    OsmesaHandle handle;
    unsigned char pixel[4];
} OsmesaContext;

static bool osmesa_load(Message *message)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !osmesa.library; i++)
        osmesa.library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    if (!osmesa.library)
        return message_set(message,
                           "OSMesa: libOSMesa.so.8 not found; install the package " OSMESA_PACKAGE
                           " (Mesa 25.1 removed it), or use another backend");
#define LOAD(name)                                                                                 \
    *(void **)&osmesa.name = dlsym(osmesa.library, "OSMesa" #name);                                \
    if (!osmesa.name)                                                                              \
        return message_set(message, "OSMesa: the library has no OSMesa" #name                      \
                                    "; install a newer " OSMESA_PACKAGE);
    LOAD(CreateContextAttribs)
    LOAD(MakeCurrent)
    LOAD(GetCurrentContext)
    LOAD(GetProcAddress)
    LOAD(DestroyContext)
#undef LOAD
    return true;
}

static void osmesa_close(void *opened)
{
    OsmesaContext *context = opened;
    if (!context)
        return;
    osmesa.DestroyContext(context->handle);
    free(context);
}

static bool osmesa_open(void **opened, const CanvasOptions *options, const char **platform,
                        Message *message)
{
    static const int attributes[] = {OSMESA_FORMAT,
                                     GL_RGBA,
                                     OSMESA_DEPTH_BITS,
                                     24,
                                     OSMESA_PROFILE,
                                     OSMESA_COMPAT_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     0,
                                     0};
    (void)options;
    if (!osmesa_load(message))
        return false;
    OsmesaContext *context = memory_new(1, sizeof *context);
    context->handle = osmesa.CreateContextAttribs(attributes, NULL);
    if (!context->handle) {
        free(context);
        return message_set(message, "OSMesa: no context of OpenGL 3.0; install the "
                                    "package libgl1-mesa-dri");
    }
    if (!osmesa.MakeCurrent(context->handle, context->pixel, GL_UNSIGNED_BYTE, 1, 1)) {
        osmesa_close(context);
        return message_set(message, "OSMesa: its context cannot be made current");
    }
    *opened = context;
    *platform = "off-screen";
    return true;
}

static GlFunction osmesa_address(const char *name)
{
    return osmesa.GetProcAddress(name);
}

static bool osmesa_current(void *opened)
{
    const OsmesaContext *context = opened;
    return osmesa.GetCurrentContext() == context->handle;
}

static bool osmesa_package(Message *findings)
{
    Message missing = {0};
    const bool found = osmesa_load(&missing);
    return package_tell(findings, "OSMesa", NULL, "pictures without a display and without EGL",
                        found ? NULL : missing.text);
}

static bool osmesa_probe(Message *findings)
{
    Message message = {0};
    const char *platform;
    void *context;
    if (!osmesa_open(&context, NULL, &platform, &message)) {
        message_add(findings, "  no: %s\n", message.text);
        return false;
    }
    const bool loaded = gl_probe(osmesa_address, findings);
    osmesa_close(context);
    return loaded;
}

const CanvasBackend CANVAS_OSMESA = {
    .name = "osmesa",
    .summary = CANVAS_OSMESA_SUMMARY,
    .open = osmesa_open,
    .address = osmesa_address,
    .current = osmesa_current,
    .close = osmesa_close,
    .package = osmesa_package,
    .probe = osmesa_probe,
};
