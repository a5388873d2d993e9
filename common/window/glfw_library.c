/*
 * GLFW is loaded at run time, so that programs without a window need neither it nor X11 or Wayland.
 * A table names the functions used, once; from it come the pointers and the code that looks them
 * up.
 */
#include "window/glfw_library.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GLFW_PACKAGE "libglfw3"

struct GlfwLibrary glfw;

static void keep_error(int code, const char *text)
{
    (void)code;
    if (!glfw.error[0])
        snprintf(glfw.error, sizeof glfw.error, "%s", text);
}

const char *glfw_take_error(char text[256])
{
    snprintf(text, 256, "%s", glfw.error[0] ? glfw.error : "no reason given");
    for (size_t end = strlen(text); end > 0 && strchr(" .\n", text[end - 1]); end--)
        text[end - 1] = '\0';
    glfw.error[0] = '\0';
    return text;
}

static int display_lost(void *display)
{
    (void)display;
    glfw.lost(glfw.title);
    return 0;
}

/* Through dlsym, without X11's headers. GLFW 3.4 loads the library in glfwInit, which is too late
 * for a display that is lost there; the library stays loaded, like GLFW. */
static void handle_lost_display(void)
{
    typedef int (*Handler)(void *display);
    Handler (*set)(Handler);
    void *library = getenv("DISPLAY") ? dlopen("libX11.so.6", RTLD_LAZY) : NULL;
    if (!library)
        return;
    *(void **)&set = dlsym(library, "XSetIOErrorHandler");
    if (set)
        set(display_lost);
}

/* Whether libwayland knows where to look for a display (wl_display_connect). Otherwise it says so
 * on standard error. */
static bool has_wayland_path(void)
{
    const char *socket = getenv("WAYLAND_SOCKET"), *display = getenv("WAYLAND_DISPLAY");
    const char *folder = getenv("XDG_RUNTIME_DIR");
    return socket || (display && display[0] == '/') || (folder && folder[0] == '/');
}

/* GLFW 3.4 tries Wayland first, unless it is told to use X11. */
static bool choose_platform(Message *message)
{
    const char *version = glfw.GetVersionString();
    if (has_wayland_path() || !strstr(version, "Wayland"))
        return true;
    if (!strstr(version, "X11"))
        return message_set(message, "window: no display (XDG_RUNTIME_DIR is not set)");
    glfw.InitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
    return true;
}

bool glfw_load(Message *message)
{
    if (glfw.library)
        return true;
    void *library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return message_set(message,
                           "window: libglfw.so.3 not found; install the package " GLFW_PACKAGE);
#define GLFW_LOAD(name)                                                                            \
    *(void **)&glfw.name = dlsym(library, "glfw" #name);                                           \
    if (!glfw.name) {                                                                              \
        dlclose(library);                                                                          \
        return message_set(message, "window: libglfw.so.3 has no glfw" #name                       \
                                    "; install a newer " GLFW_PACKAGE);                            \
    }
    GLFW_FUNCTIONS(GLFW_LOAD)
#undef GLFW_LOAD
    /* What Mesa lacks for acceleration, as DRI3 on Xvfb, is no warning to a user. */
    setenv("EGL_LOG_LEVEL", "fatal", 0);
    glfw.library = library;
    return true;
}

bool glfw_open(Message *message)
{
    char why[256];
    if (!glfw_load(message) || !choose_platform(message))
        return false;
    if (glfw.lost)
        handle_lost_display();
    glfw.error[0] = '\0';
    glfw.SetErrorCallback(keep_error);
    return glfw.Init() || message_set(message, "window: no display (%s)", glfw_take_error(why));
}
