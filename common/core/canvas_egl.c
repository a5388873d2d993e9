/*
 * The EGL backend: an OpenGL ES 2 context without a window or display server. Tries Mesa's
 * surfaceless platform, then each device of the device platform, then the default display. libEGL
 * is loaded at run time so that a missing one is reported with the package to install.
 */
#include "core/canvas.h"

#include "base/memory.h"
#include "base/plugin.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#define EGL_FUNCTIONS(X)                                                                           \
    X(BINDAPI, BindAPI)                                                                            \
    X(CHOOSECONFIG, ChooseConfig)                                                                  \
    X(CREATECONTEXT, CreateContext)                                                                \
    X(CREATEPBUFFERSURFACE, CreatePbufferSurface)                                                  \
    X(DESTROYCONTEXT, DestroyContext)                                                              \
    X(DESTROYSURFACE, DestroySurface)                                                              \
    X(GETCONFIGATTRIB, GetConfigAttrib)                                                            \
    X(GETCURRENTCONTEXT, GetCurrentContext)                                                        \
    X(GETDISPLAY, GetDisplay)                                                                      \
    X(GETERROR, GetError)                                                                          \
    X(GETPROCADDRESS, GetProcAddress)                                                              \
    X(INITIALIZE, Initialize)                                                                      \
    X(MAKECURRENT, MakeCurrent)                                                                    \
    X(QUERYSTRING, QueryString)                                                                    \
    X(TERMINATE, Terminate)

static struct {
    void *library; /* stays loaded: drivers crash when unloaded */
#define EGL_DECLARE(TYPE, name) PFNEGL##TYPE##PROC name;
    EGL_FUNCTIONS(EGL_DECLARE)
#undef EGL_DECLARE
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay;
    PFNEGLQUERYDEVICESEXTPROC QueryDevices;
} egl;

enum { MAX_DEVICES = 16 };

typedef struct Route {
    char name[32];
    EGLenum platform; /* 0: the default display */
    void *native;
} Route;

typedef struct EglContext {
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface; /* 1x1, only if a context needs one */
    char platform[32];
} EglContext;

static const char *egl_error(void)
{
    switch (egl.GetError()) {
    case EGL_SUCCESS:
        return "no reason given";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED (no driver answered)";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC (out of memory)";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_DISPLAY:
        return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    default:
        return "an EGL error";
    }
}

enum { REMEDY_SIZE = 256 };

/* What to do where no driver answers: the variables that choose one come before the packages. */
static const char *egl_remedy(char remedy[REMEDY_SIZE])
{
    static const char *const choosing[] = {"GALLIUM_DRIVER",
                                           "MESA_LOADER_DRIVER_OVERRIDE",
                                           "MESA_GLES_VERSION_OVERRIDE",
                                           "LIBGL_DRIVERS_PATH",
                                           "GBM_BACKENDS_PATH",
                                           "EGL_PLATFORM",
                                           "__EGL_VENDOR_LIBRARY_FILENAMES",
                                           "__EGL_VENDOR_LIBRARY_DIRS"};
    for (size_t i = 0; i < sizeof choosing / sizeof choosing[0]; i++) {
        const char *value = getenv(choosing[i]);
        snprintf(remedy, REMEDY_SIZE, "%s is \"%.100s\": unset it", choosing[i],
                 value ? value : "");
        if (value)
            return remedy;
    }
    return "install the packages libegl1 libegl-mesa0 libgl1-mesa-dri";
}

/* Mesa's LLVM alone is 120 MB, and each thread takes 72 MB of addresses; without memory Mesa is not
 * loaded, says so in many lines, or crashes, and with two processors so do a few pictures with 800
 * MB. */
static bool egl_has_memory(Message *message)
{
    enum { LEAST = 1024 }; /* MB */
    struct rlimit limit;
    return getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur >> 20 >= LEAST ||
           message_set(message, "EGL: the limit of memory is %d MB (ulimit -v): raise it to %d",
                       (int)(limit.rlim_cur >> 20), LEAST);
}

/* With 7 bits llvmpipe writes over its memory. */
static bool egl_has_vectors(Message *message)
{
    const char *name = "LP_NATIVE_VECTOR_WIDTH", *bits = getenv(name);
    const long width = bits ? strtol(bits, NULL, 0) : 128;
    return width == 128 || width == 256 || width == 512 ||
           message_set(message, "EGL: %s is \"%.100s\", not 128, 256 or 512: unset it", name, bits);
}

static bool egl_load(Message *message)
{
    if (egl.library)
        return true;
    if (!egl_has_memory(message) || !egl_has_vectors(message))
        return false;
    void *library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return message_set(message, "EGL: %s; %s", dlerror(), egl_remedy((char[REMEDY_SIZE]){0}));
#define EGL_LOAD(TYPE, name)                                                                       \
    egl.name = (PFNEGL##TYPE##PROC)dlsym(library, "egl" #name);                                    \
    if (!egl.name) {                                                                               \
        dlclose(library);                                                                          \
        return message_set(message,                                                                \
                           "EGL: libEGL.so.1 has no egl" #name "; install the package libegl1");   \
    }
    EGL_FUNCTIONS(EGL_LOAD)
#undef EGL_LOAD
    egl.library = library;
    egl.GetPlatformDisplay =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl.GetProcAddress("eglGetPlatformDisplayEXT");
    egl.QueryDevices = (PFNEGLQUERYDEVICESEXTPROC)egl.GetProcAddress("eglQueryDevicesEXT");
    return true;
}

/* All routes, in the order to try. */
static int find_routes(Route routes[2 + MAX_DEVICES])
{
    int count = 0;
    const char *client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (egl.GetPlatformDisplay && gl_lists(client, "EGL_MESA_platform_surfaceless"))
        routes[count++] = (Route){"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, NULL};
    if (egl.GetPlatformDisplay && egl.QueryDevices && gl_lists(client, "EGL_EXT_platform_device")) {
        EGLDeviceEXT devices[MAX_DEVICES];
        EGLint found = 0;
        if (!egl.QueryDevices(MAX_DEVICES, devices, &found))
            found = 0;
        for (int i = 0; i < found; i++) {
            routes[count] = (Route){"", EGL_PLATFORM_DEVICE_EXT, devices[i]};
            snprintf(routes[count].name, sizeof routes[count].name, "device %d", i);
            count++;
        }
    }
    routes[count++] = (Route){"default display", 0, NULL};
    return count;
}

/* A config with 8 bits per channel and at least 24 of depth. eglChooseConfig treats sizes as
 * minima, so the result is checked. */
static bool choose_config(EGLDisplay display, EGLConfig *config, Message *message)
{
    static const struct {
        EGLint attribute, min;
        bool exactly;
        const char *name;
    } wanted[] = {
        {EGL_RED_SIZE, 8, true, "red"},       {EGL_GREEN_SIZE, 8, true, "green"},
        {EGL_BLUE_SIZE, 8, true, "blue"},     {EGL_ALPHA_SIZE, 8, true, "alpha"},
        {EGL_DEPTH_SIZE, 24, false, "depth"},
    };
    enum { WANTED = sizeof wanted / sizeof wanted[0] };
    EGLint attributes[2 * WANTED + 5];
    int n = 0;
    for (int i = 0; i < WANTED; i++) {
        attributes[n++] = wanted[i].attribute;
        attributes[n++] = wanted[i].min;
    }
    attributes[n++] = EGL_RENDERABLE_TYPE;
    attributes[n++] = EGL_OPENGL_ES2_BIT;
    attributes[n++] = EGL_SURFACE_TYPE;
    attributes[n++] = EGL_PBUFFER_BIT;
    attributes[n] = EGL_NONE;
    EGLint count = 0;
    if (!egl.ChooseConfig(display, attributes, config, 1, &count))
        return message_set(message, "eglChooseConfig: %s", egl_error());
    if (count < 1)
        return message_set(message,
                           "no config with 8-bit RGBA, 24-bit depth and OpenGL ES 2 rendering");
    for (int i = 0; i < WANTED; i++) {
        EGLint bits = 0;
        egl.GetConfigAttrib(display, *config, wanted[i].attribute, &bits);
        if (bits < wanted[i].min || (wanted[i].exactly && bits > wanted[i].min))
            return message_set(message, "the driver's best config has %d bits of %s, not %d",
                               (int)bits, wanted[i].name, (int)wanted[i].min);
    }
    return true;
}

static void route_close(EglContext *context)
{
    if (context->display == EGL_NO_DISPLAY)
        return;
    egl.MakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context->surface != EGL_NO_SURFACE)
        egl.DestroySurface(context->display, context->surface);
    if (context->context != EGL_NO_CONTEXT)
        egl.DestroyContext(context->display, context->context);
    egl.Terminate(context->display);
    *context = (EglContext){.display = EGL_NO_DISPLAY};
}

/* A current context by one route. The message has no subject: the caller adds the route. */
static bool route_open(const Route *route, EglContext *context, Message *message)
{
    static const EGLint version_2[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    static const EGLint with_resets[] = {EGL_CONTEXT_CLIENT_VERSION, 2,
                                         EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                                         EGL_LOSE_CONTEXT_ON_RESET_EXT, EGL_NONE};
    static const EGLint tiny[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    *context = (EglContext){
        .display = EGL_NO_DISPLAY, .context = EGL_NO_CONTEXT, .surface = EGL_NO_SURFACE};
    snprintf(context->platform, sizeof context->platform, "%s", route->name);
    EGLDisplay display = route->platform
                             ? egl.GetPlatformDisplay(route->platform, route->native, NULL)
                             : egl.GetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY)
        return message_set(message, "no display: %s", egl_error());
    if (!egl.Initialize(display, NULL, NULL))
        return message_set(message, "eglInitialize: %s", egl_error());
    context->display = display;
    EGLConfig config;
    if (!choose_config(display, &config, message))
        goto fail;
    if (!egl.BindAPI(EGL_OPENGL_ES_API)) {
        message_set(message, "eglBindAPI: %s", egl_error());
        goto fail;
    }
    const char *extensions = egl.QueryString(display, EGL_EXTENSIONS);
    if (gl_lists(extensions, "EGL_EXT_create_context_robustness"))
        context->context = egl.CreateContext(display, config, EGL_NO_CONTEXT, with_resets);
    if (context->context == EGL_NO_CONTEXT)
        context->context = egl.CreateContext(display, config, EGL_NO_CONTEXT, version_2);
    if (context->context == EGL_NO_CONTEXT) {
        message_set(message, "eglCreateContext for OpenGL ES 2: %s", egl_error());
        goto fail;
    }
    if (!gl_lists(extensions, "EGL_KHR_surfaceless_context")) {
        context->surface = egl.CreatePbufferSurface(display, config, tiny);
        if (context->surface == EGL_NO_SURFACE) {
            message_set(message, "eglCreatePbufferSurface: %s", egl_error());
            goto fail;
        }
    }
    if (!egl.MakeCurrent(display, context->surface, context->surface, context->context)) {
        message_set(message, "eglMakeCurrent: %s", egl_error());
        goto fail;
    }
    return true;
fail:
    route_close(context);
    return false;
}

static GlFunction egl_address(const char *name)
{
    return (GlFunction)egl.GetProcAddress(name);
}

static bool egl_open(void **opened, const CanvasOptions *options, const char **platform,
                     Message *message)
{
    (void)options;
    if (!egl_load(message))
        return false;
    EglContext *context = memory_new(1, sizeof *context);
    Route routes[2 + MAX_DEVICES];
    const int count = find_routes(routes);
    Message reasons = {0};
    for (int i = 0; i < count; i++) {
        Message reason = {0};
        if (route_open(&routes[i], context, &reason)) {
            *opened = context;
            *platform = context->platform;
            return true;
        }
        message_add(&reasons, "%s%s: %s", i ? "; " : "", routes[i].name, reason.text);
    }
    free(context);
    return message_set(message, "EGL: no platform gives an OpenGL ES 2 context (%s); %s",
                       reasons.text, egl_remedy((char[REMEDY_SIZE]){0}));
}

static bool egl_current(void *opened)
{
    const EglContext *context = opened;
    return egl.GetCurrentContext() == context->context;
}

static void egl_close(void *opened)
{
    if (!opened)
        return;
    route_close(opened);
    free(opened);
}

static bool egl_package(Message *findings)
{
    Message missing = {0};
    const bool found = egl_load(&missing);
    return package_tell(findings, "EGL",
                        found ? egl.QueryString(EGL_NO_DISPLAY, EGL_VERSION) : NULL,
                        "pictures without a display", found ? NULL : missing.text);
}

static bool egl_probe(Message *findings)
{
    Message message = {0};
    if (!egl_load(&message)) {
        message_add(findings, "  no: %s\n", message.text);
        return false;
    }
    Route routes[2 + MAX_DEVICES];
    const int count = find_routes(routes);
    bool any = false;
    for (int i = 0; i < count; i++) {
        EglContext context;
        Message reason = {0};
        if (!route_open(&routes[i], &context, &reason)) {
            message_add(findings, "  %-16s no: %s\n", routes[i].name, reason.text);
            continue;
        }
        message_add(findings, "  %-16s EGL %s, config with RGBA 8888 and 24-bit depth\n",
                    routes[i].name, egl.QueryString(context.display, EGL_VERSION));
        any |= gl_probe(egl_address, findings);
        route_close(&context);
    }
    if (!any)
        message_add(findings, "  %s\n", egl_remedy((char[REMEDY_SIZE]){0}));
    return any;
}

const CanvasBackend CANVAS_EGL = {
    .name = "egl",
    .summary = "headless, on EGL and Mesa",
    .open = egl_open,
    .address = egl_address,
    .current = egl_current,
    .close = egl_close,
    .package = egl_package,
    .probe = egl_probe,
};

const CanvasBackend *const CANVAS_HEADLESS[] = {&CANVAS_EGL, &CANVAS_OSMESA, NULL};
