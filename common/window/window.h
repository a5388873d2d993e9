/*
 * window: a window on the screen and its input, through GLFW: the canvas backend "window".
 *
 * GLFW is loaded on first use, and with it X11 or Wayland, so that programs without a window do not
 * need them. canvas_open with CANVAS_WINDOW opens a window, which is the canvas's context:
 * window_of. It has an OpenGL ES 2 context of EGL, like that of the headless backend.
 */
#ifndef WINDOW_H
#define WINDOW_H

#include "core/canvas.h"

extern const CanvasBackend CANVAS_WINDOW;
#define CANVAS_WINDOW_SUMMARY "on a display, in a window of GLFW"

typedef struct Window Window;

/* The window of a canvas; NULL if it has none. */
Window *window_of(const Canvas *canvas);

/* Keys that type no characters. */
typedef enum WindowKey {
    WINDOW_KEY_ESCAPE,
    WINDOW_KEY_ENTER,
    WINDOW_KEY_TAB,
    WINDOW_KEY_BACKSPACE,
    WINDOW_KEY_DELETE,
    WINDOW_KEY_LEFT,
    WINDOW_KEY_RIGHT,
    WINDOW_KEY_UP,
    WINDOW_KEY_DOWN,
    WINDOW_KEY_HOME,
    WINDOW_KEY_END,
    WINDOW_KEY_PAGE_UP,
    WINDOW_KEY_PAGE_DOWN,
    /* with control, to edit text */
    WINDOW_KEY_A,
    WINDOW_KEY_C,
    WINDOW_KEY_V,
    WINDOW_KEY_X,
    WINDOW_KEY_COUNT,
} WindowKey;

/* Where it stands among what was typed, a key is above all Unicode characters. */
enum { WINDOW_MAX_TYPED = 256, WINDOW_TYPED_KEY = 0x110000, WINDOW_BUTTONS = 3 };

/* Events since the last call, and the current state. Lengths are framebuffer pixels, of which a
 * screen unit may have several; y is 0 at the top. */
typedef struct WindowInput {
    bool touched;                     /* there was an event, of any kind */
    bool closed;                      /* the user closed the window */
    int width, height;                /* of the framebuffer; 0 while minimized */
    double scale;                     /* of text, 1 on a standard screen */
    double x, y;                      /* of the pointer */
    bool buttons[WINDOW_BUTTONS];     /* left, right, middle: down, or pressed and released since */
    double press_x, press_y;          /* of the pointer when the left one last went down */
    double drag_x, drag_y;            /* pointer movement while the left one was down */
    double scroll;                    /* notches, positive away from the user */
    bool control, shift;              /* held */
    bool down[WINDOW_KEY_COUNT];      /* down, or pressed and released since */
    unsigned typed[WINDOW_MAX_TYPED]; /* characters, and WINDOW_TYPED_KEY + keys, in order */
    int typed_count;
} WindowInput;

/* Windows are hidden until shown. */
void window_show(Window *window);

/* Waits at most `seconds`, which may be 0, for an event, and returns the input. Without an event
 * the display is asked nothing. */
void window_input(Window *window, double seconds, WindowInput *input);

/* Shows framebuffer 0; waits for the vertical blank unless window_wait_for_screen disabled that or
 * the platform does not support it. */
void window_swap(Window *window);
void window_wait_for_screen(Window *window, bool wait);

/* Of the screen, per second. */
double window_refresh_rate(Window *window);

void window_title(Window *window, const char *title);

/* Asks for a size in framebuffer pixels, and sets it to what is asked for: no larger than the
 * screen, unless the window is. What a window manager makes of that, window_input tells. */
void window_resize(Window *window, int *width, int *height);

/* Full screen, or the position and size before that. */
void window_full_screen(Window *window, bool full);

/* The clipboard's text; "" if it has none. Valid until the next call. */
const char *window_clipboard(Window *window);
void window_set_clipboard(Window *window, const char *text);

/* False, with a message, if GLFW reported an error since the last call. */
bool window_check(Window *window, Message *message);

#endif
