/*
 * glfw_library: GLFW, loaded when it is needed, and its functions as pointers.
 */
#ifndef GLFW_LIBRARY_H
#define GLFW_LIBRARY_H

#include "base/message.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#ifndef GLFW_PLATFORM /* before 3.4; the library that is loaded may be newer */
#define GLFW_PLATFORM 0x00050003
#define GLFW_PLATFORM_X11 0x00060004
#endif

#define GLFW_FUNCTIONS(X)                                                                          \
    X(CreateWindow)                                                                                \
    X(DestroyWindow)                                                                               \
    X(GetClipboardString)                                                                          \
    X(GetCursorPos)                                                                                \
    X(GetFramebufferSize)                                                                          \
    X(GetKey)                                                                                      \
    X(GetMouseButton)                                                                              \
    X(GetPrimaryMonitor)                                                                           \
    X(GetProcAddress)                                                                              \
    X(GetVersionString)                                                                            \
    X(GetVideoMode)                                                                                \
    X(GetWindowAttrib)                                                                             \
    X(GetWindowContentScale)                                                                       \
    X(GetWindowPos)                                                                                \
    X(GetWindowSize)                                                                               \
    X(GetWindowUserPointer)                                                                        \
    X(Init)                                                                                        \
    X(InitHint)                                                                                    \
    X(MakeContextCurrent)                                                                          \
    X(PollEvents)                                                                                  \
    X(SetCharCallback)                                                                             \
    X(SetClipboardString)                                                                          \
    X(SetCursorEnterCallback)                                                                      \
    X(SetCursorPosCallback)                                                                        \
    X(SetErrorCallback)                                                                            \
    X(SetFramebufferSizeCallback)                                                                  \
    X(SetKeyCallback)                                                                              \
    X(SetMouseButtonCallback)                                                                      \
    X(SetScrollCallback)                                                                           \
    X(SetWindowCloseCallback)                                                                      \
    X(SetWindowContentScaleCallback)                                                               \
    X(SetWindowFocusCallback)                                                                      \
    X(SetWindowIconifyCallback)                                                                    \
    X(SetWindowMonitor)                                                                            \
    X(SetWindowRefreshCallback)                                                                    \
    X(SetWindowSize)                                                                               \
    X(SetWindowTitle)                                                                              \
    X(SetWindowUserPointer)                                                                        \
    X(ShowWindow)                                                                                  \
    X(SwapBuffers)                                                                                 \
    X(SwapInterval)                                                                                \
    X(WaitEventsTimeout)                                                                           \
    X(WindowHint)                                                                                  \
    X(WindowHintString)                                                                            \
    X(WindowShouldClose)

/* One, as GLFW itself. */
extern struct GlfwLibrary {
    void *library; /* stays loaded, like drivers */
#define GLFW_DECLARE(name) __typeof__(&glfw##name) name;
    GLFW_FUNCTIONS(GLFW_DECLARE)
#undef GLFW_DECLARE
    char error[256]; /* the first since the last glfw_take_error */
    void (*lost)(const char *title);
    char title[64]; /* of the latest window, for `lost` */
} glfw;

/* Loads it, which needs no display. */
bool glfw_load(Message *message);

/* Loads and initializes it; from then on `glfw.lost` is called, if it is set, when the display is
 * lost. */
bool glfw_open(Message *message);

/* Returns and clears the kept error, without a final full stop or newline. */
const char *glfw_take_error(char text[256]);

#endif
