/*
 * The window backend: GLFW makes a window with an OpenGL ES 2 context of EGL.
 *
 * Input comes as events, through callbacks, and is asked for as a state, once a frame. Between the
 * two a key can go down and up again: so events are collected, and what went down since the last
 * frame counts as down in this one. A drag is summed while the button is held, in the order of the
 * events. A display that is asked costs a round trip: nothing is asked unless there was an event.
 */
#include "window/window.h"

#include "base/memory.h"
#include "base/plugin.h"
#include "window/glfw_library.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SIDE = 16384 };

struct Window {
    GLFWwindow *handle;
    void *context; /* EGL's: GLFW does not notice what others make current */
    char platform[64];
    int place[4];        /* x, y, width, height in screen units, before full screen */
    WindowInput pending; /* collected by the callbacks; drags in screen units */
    bool held;           /* the left button, in the order of events */
    double x, y;         /* of the pointer, in the order of events */
    double press_x, press_y;
    WindowInput state; /* of the last input, without events */
};

static WindowInput *pending(GLFWwindow *handle)
{
    Window *window = glfw.GetWindowUserPointer(handle);
    window->pending.touched = true;
    return &window->pending;
}

/* Events whose values window_input asks for. */

static void on_change(GLFWwindow *handle)
{
    pending(handle);
}

static void on_state(GLFWwindow *handle, int state)
{
    (void)state;
    pending(handle);
}

static void on_size(GLFWwindow *handle, int width, int height)
{
    (void)width, (void)height;
    pending(handle);
}

static void on_scale(GLFWwindow *handle, float x, float y)
{
    (void)x, (void)y;
    pending(handle);
}

static const int KEYS[WINDOW_KEY_COUNT] = {
    [WINDOW_KEY_ESCAPE] = GLFW_KEY_ESCAPE,
    [WINDOW_KEY_ENTER] = GLFW_KEY_ENTER,
    [WINDOW_KEY_TAB] = GLFW_KEY_TAB,
    [WINDOW_KEY_BACKSPACE] = GLFW_KEY_BACKSPACE,
    [WINDOW_KEY_DELETE] = GLFW_KEY_DELETE,
    [WINDOW_KEY_LEFT] = GLFW_KEY_LEFT,
    [WINDOW_KEY_RIGHT] = GLFW_KEY_RIGHT,
    [WINDOW_KEY_UP] = GLFW_KEY_UP,
    [WINDOW_KEY_DOWN] = GLFW_KEY_DOWN,
    [WINDOW_KEY_HOME] = GLFW_KEY_HOME,
    [WINDOW_KEY_END] = GLFW_KEY_END,
    [WINDOW_KEY_A] = GLFW_KEY_A,
    [WINDOW_KEY_C] = GLFW_KEY_C,
    [WINDOW_KEY_V] = GLFW_KEY_V,
    [WINDOW_KEY_X] = GLFW_KEY_X,
    [WINDOW_KEY_PAGE_UP] = GLFW_KEY_PAGE_UP,
    [WINDOW_KEY_PAGE_DOWN] = GLFW_KEY_PAGE_DOWN,
};

static void add_typed(WindowInput *input, unsigned typed)
{
    if (input->typed_count < WINDOW_MAX_TYPED)
        input->typed[input->typed_count++] = typed;
}

static void on_key(GLFWwindow *handle, int key, int scancode, int action, int modifiers)
{
    WindowInput *input = pending(handle);
    (void)scancode, (void)modifiers;
    if (key == GLFW_KEY_KP_ENTER)
        key = GLFW_KEY_ENTER;
    for (int i = 0; i < WINDOW_KEY_COUNT; i++) {
        if (KEYS[i] == key && action != GLFW_RELEASE) {
            input->down[i] = true;
            add_typed(input, WINDOW_TYPED_KEY + (unsigned)i);
        }
    }
}

static void on_character(GLFWwindow *handle, unsigned character)
{
    add_typed(pending(handle), character);
}

static void on_button(GLFWwindow *handle, int button, int action, int modifiers)
{
    (void)modifiers;
    Window *window = glfw.GetWindowUserPointer(handle);
    WindowInput *input = pending(handle);
    if (button < WINDOW_BUTTONS && action == GLFW_PRESS)
        input->buttons[button] = true;
    if (button != GLFW_MOUSE_BUTTON_LEFT)
        return;
    window->held = action == GLFW_PRESS;
    if (window->held) {
        window->press_x = window->x;
        window->press_y = window->y;
    }
}

static void on_pointer(GLFWwindow *handle, double x, double y)
{
    Window *window = glfw.GetWindowUserPointer(handle);
    WindowInput *input = pending(handle);
    if (window->held) {
        input->drag_x += x - window->x;
        input->drag_y += y - window->y;
    }
    window->x = x;
    window->y = y;
}

static void on_scroll(GLFWwindow *handle, double x, double y)
{
    (void)x;
    pending(handle)->scroll += y;
}

static void window_close(void *opened)
{
    Window *window = opened;
    if (!window)
        return;
    /* GLFW stays initialized: EGL keeps state for each display connection and fails after about 200
     * of them. Poll to drop the window's remaining events. */
    if (window->handle)
        glfw.DestroyWindow(window->handle);
    glfw.PollEvents();
    free(window);
}

static int between(int value, int min, int max)
{
    return value < min ? min : value > max ? max : value;
}

static void *current_context(void)
{
    void *(*get)(void) = (void *(*)(void))glfw.GetProcAddress("eglGetCurrentContext");
    return get ? get() : NULL;
}

static void set_hints(void)
{
    glfw.WindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
    glfw.WindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfw.WindowHint(GLFW_CONTEXT_VERSION_MAJOR, 2);
    glfw.WindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    /* The canvas has a depth buffer and samples of its own. */
    glfw.WindowHint(GLFW_DEPTH_BITS, 0);
    glfw.WindowHint(GLFW_STENCIL_BITS, 0);
    glfw.WindowHint(GLFW_ALPHA_BITS, 0);
    glfw.WindowHint(GLFW_VISIBLE, GLFW_FALSE);
    /* GLFW uses each only if both are set. */
    glfw.WindowHintString(GLFW_X11_CLASS_NAME, "lighting");
    glfw.WindowHintString(GLFW_X11_INSTANCE_NAME, "lighting");
}

static void set_callbacks(GLFWwindow *handle)
{
    glfw.SetKeyCallback(handle, on_key);
    glfw.SetCharCallback(handle, on_character);
    glfw.SetCursorPosCallback(handle, on_pointer);
    glfw.SetMouseButtonCallback(handle, on_button);
    glfw.SetScrollCallback(handle, on_scroll);
    glfw.SetCursorEnterCallback(handle, on_state);
    glfw.SetFramebufferSizeCallback(handle, on_size);
    glfw.SetWindowCloseCallback(handle, on_change);
    glfw.SetWindowContentScaleCallback(handle, on_scale);
    glfw.SetWindowFocusCallback(handle, on_state);
    glfw.SetWindowIconifyCallback(handle, on_state);
    glfw.SetWindowRefreshCallback(handle, on_change);
}

static bool window_open(void **opened, const CanvasOptions *options, const char **platform,
                        Message *message)
{
    char why[256];
    const char *title = options->title ? options->title : "lighting";
    if (options->lost) {
        glfw.lost = options->lost;
        snprintf(glfw.title, sizeof glfw.title, "%s", title);
    }
    if (!glfw_open(message))
        return false;
    set_hints();
    Window *window = memory_new(1, sizeof *window);
    /* The canvas rejects sizes beyond the driver's limit. */
    window->handle = glfw.CreateWindow(between(options->width, 1, MAX_SIDE),
                                       between(options->height, 1, MAX_SIDE), title, NULL, NULL);
    if (!window->handle) {
        window_close(window);
        return message_set(message, "window: %s", glfw_take_error(why));
    }
    glfw.SetWindowUserPointer(window->handle, window);
    glfw.MakeContextCurrent(window->handle);
    window->context = current_context();
    set_callbacks(window->handle);
    window->pending.touched = true;
    snprintf(window->platform, sizeof window->platform, "GLFW %s", glfw.GetVersionString());
    window_wait_for_screen(window, true);
    *opened = window;
    *platform = window->platform;
    return true;
}

static GlFunction window_address(const char *name)
{
    return (GlFunction)glfw.GetProcAddress(name);
}

static bool window_current(void *opened)
{
    const Window *window = opened;
    return current_context() == window->context;
}

Window *window_of(const Canvas *canvas)
{
    return canvas->backend == &CANVAS_WINDOW ? canvas->context : NULL;
}

/* Ignores errors about what a platform does not support (Wayland: window positions, focus). */
static void forget_error(void)
{
    glfw.error[0] = '\0';
}

void window_show(Window *window)
{
    glfw.ShowWindow(window->handle);
    forget_error();
}

/* Where things are and what is held, as the display has it. */
static WindowInput ask(Window *window)
{
    WindowInput state = {.closed = glfw.WindowShouldClose(window->handle)};
    float scale_x = 1, scale_y = 1;
    glfw.GetFramebufferSize(window->handle, &state.width, &state.height);
    if (glfw.GetWindowAttrib(window->handle, GLFW_ICONIFIED))
        state.width = state.height = 0;
    glfw.GetWindowContentScale(window->handle, &scale_x, &scale_y);
    state.scale = fmax(1, (double)scale_y);
    glfw.GetCursorPos(window->handle, &state.x, &state.y);
    for (int i = 0; i < WINDOW_BUTTONS; i++)
        state.buttons[i] = glfw.GetMouseButton(window->handle, i) == GLFW_PRESS;
    for (int i = 0; i < WINDOW_KEY_COUNT; i++)
        state.down[i] = glfw.GetKey(window->handle, KEYS[i]) == GLFW_PRESS;
    state.control = glfw.GetKey(window->handle, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                    glfw.GetKey(window->handle, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
    state.shift = glfw.GetKey(window->handle, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                  glfw.GetKey(window->handle, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
    return state;
}

/* Framebuffer pixels per screen unit. */
static void pixels_per_unit(Window *window, double *x, double *y)
{
    int width = 0, height = 0;
    int pixels[2] = {0, 0};
    glfw.GetWindowSize(window->handle, &width, &height);
    glfw.GetFramebufferSize(window->handle, &pixels[0], &pixels[1]);
    *x = width > 0 && pixels[0] > 0 ? (double)pixels[0] / width : 1;
    *y = height > 0 && pixels[1] > 0 ? (double)pixels[1] / height : 1;
}

void window_input(Window *window, double seconds, WindowInput *input)
{
    WindowInput *events = &window->pending;
    if (seconds > 0 && !events->touched)
        glfw.WaitEventsTimeout(seconds);
    else
        glfw.PollEvents();
    if (events->touched || window->state.width == 0) { /* hidden: not every change is an event */
        double x, y;
        window->state = ask(window);
        pixels_per_unit(window, &x, &y);
        window->state.x *= x;
        window->state.y *= y;
        window->state.press_x = x * window->press_x;
        window->state.press_y = y * window->press_y;
        events->drag_x *= x;
        events->drag_y *= y;
    }
    *input = window->state;
    input->touched = events->touched;
    input->drag_x = events->drag_x;
    input->drag_y = events->drag_y;
    input->scroll = events->scroll;
    input->typed_count = events->typed_count;
    memcpy(input->typed, events->typed, sizeof input->typed);
    for (int i = 0; i < WINDOW_BUTTONS; i++)
        input->buttons[i] |= events->buttons[i];
    for (int i = 0; i < WINDOW_KEY_COUNT; i++)
        input->down[i] |= events->down[i];
    *events = (WindowInput){.touched = false};
}

void window_swap(Window *window)
{
    /* Mesa's software renderer writes to a display that was lost during drawing again and again,
     * for many seconds; polling notices the loss. What happened is for the next window_input. */
    glfw.PollEvents();
    glfw.SwapBuffers(window->handle);
}

void window_wait_for_screen(Window *window, bool wait)
{
    /* Wayland does not tear, and a hidden window would wait forever. */
    const bool wayland = strstr(window->platform, "Wayland") && !strstr(window->platform, "X11");
    glfw.SwapInterval(wait && !wayland ? 1 : 0); /* of the current context */
}

static const GLFWvidmode *video_mode(GLFWmonitor **monitor)
{
    *monitor = glfw.GetPrimaryMonitor();
    return *monitor ? glfw.GetVideoMode(*monitor) : NULL;
}

double window_refresh_rate(Window *window)
{
    enum { USUAL = 60 };
    GLFWmonitor *monitor;
    const GLFWvidmode *mode = video_mode(&monitor);
    (void)window;
    return mode && mode->refreshRate > 0 ? mode->refreshRate : USUAL;
}

void window_title(Window *window, const char *title)
{
    glfw.SetWindowTitle(window->handle, title);
}

void window_resize(Window *window, int *width, int *height)
{
    GLFWmonitor *monitor;
    const GLFWvidmode *mode = video_mode(&monitor);
    int now[2];
    double x, y;
    pixels_per_unit(window, &x, &y);
    glfw.GetWindowSize(window->handle, &now[0], &now[1]);
    const int most[2] = {mode && mode->width > now[0] ? mode->width : now[0],
                         mode && mode->height > now[1] ? mode->height : now[1]};
    const int asked[2] = {between((int)lrint(*width / x), 1, most[0]),
                          between((int)lrint(*height / y), 1, most[1])};
    glfw.SetWindowSize(window->handle, asked[0], asked[1]);
    *width = (int)lrint(asked[0] * x);
    *height = (int)lrint(asked[1] * y);
    forget_error();
}

void window_full_screen(Window *window, bool full)
{
    int *place = window->place;
    GLFWmonitor *monitor;
    const GLFWvidmode *mode = video_mode(&monitor);
    if (full && mode) {
        glfw.GetWindowPos(window->handle, &place[0], &place[1]);
        glfw.GetWindowSize(window->handle, &place[2], &place[3]);
        glfw.SetWindowMonitor(window->handle, monitor, 0, 0, mode->width, mode->height,
                              mode->refreshRate);
    } else if (!full && place[2] > 0) {
        glfw.SetWindowMonitor(window->handle, NULL, place[0], place[1], place[2], place[3],
                              GLFW_DONT_CARE);
    }
    forget_error();
}

const char *window_clipboard(Window *window)
{
    const char *text = glfw.GetClipboardString(window->handle);
    forget_error(); /* a clipboard without text is not an error */
    return text ? text : "";
}

void window_set_clipboard(Window *window, const char *text)
{
    glfw.SetClipboardString(window->handle, text);
}

bool window_check(Window *window, Message *message)
{
    char why[256];
    (void)window;
    return !glfw.error[0] || message_set(message, "window: %s", glfw_take_error(why));
}

static bool window_package(Message *findings)
{
    Message missing = {0};
    const bool found = glfw_load(&missing);
    return package_tell(findings, "GLFW", found ? glfw.GetVersionString() : NULL, "windows",
                        found ? NULL : missing.text);
}

static bool window_probe(Message *findings)
{
    static const CanvasOptions tiny = {.width = 1, .height = 1};
    Message message = {0};
    const char *platform;
    void *window;
    if (!window_open(&window, &tiny, &platform, &message)) {
        message_add(findings, "  no: %s\n", message.text);
        return false;
    }
    message_add(findings, "  library    %s\n", platform);
    const bool loaded = gl_probe(window_address, findings);
    window_close(window);
    return loaded;
}

const CanvasBackend CANVAS_WINDOW = {
    .name = "window",
    .summary = CANVAS_WINDOW_SUMMARY,
    .presents = true,
    .open = window_open,
    .address = window_address,
    .current = window_current,
    .close = window_close,
    .package = window_package,
    .probe = window_probe,
};
