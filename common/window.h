/*
 * window: a window on the screen, through GLFW: what the backend "window" of a canvas is, and what
 * people do in it.
 *
 * GLFW is loaded at the first need, and with it X11 or Wayland: a program that draws without a
 * window needs none of them. A window is made by canvas_open with CANVAS_WINDOW and is that
 * canvas's context: window_of. It has an OpenGL ES 2 context of EGL, like that of the headless
 * backend.
 */
#ifndef WINDOW_H
#define WINDOW_H

#include "canvas.h"

#include <stdbool.h>

typedef struct Window Window;

/* The window that a canvas is in; NULL where it is in none. */
Window *window_of(const Canvas *canvas);

/* Keys that are no characters. */
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
    /* with control: to edit text */
    WINDOW_KEY_A,
    WINDOW_KEY_C,
    WINDOW_KEY_V,
    WINDOW_KEY_X,
    WINDOW_KEY_COUNT,
} WindowKey;

enum { WINDOW_MOST_TYPED = 64, WINDOW_BUTTONS = 3 };

/* What has happened since the last call, and how things are now. Lengths are pixels of the picture,
 * not units of the screen, of which one may be several pixels; y is 0 at the top. */
typedef struct WindowInput {
    bool closed;                   /* somebody closed the window */
    int width, height;             /* of its picture; 0 while there is nothing to see of it */
    double scale;                  /* of text, 1 on an ordinary screen */
    double x, y;                   /* of the pointer */
    bool buttons[WINDOW_BUTTONS];  /* left, right, middle: down, or pressed and released since */
    double drag_x, drag_y;         /* how far the pointer went while the left one was down */
    double scroll;                 /* notches, away from the hand */
    bool control, shift;           /* held */
    bool down[WINDOW_KEY_COUNT];   /* down, or pressed and released since */
    int pressed[WINDOW_KEY_COUNT]; /* how often, repetitions included */
    unsigned typed[WINDOW_MOST_TYPED]; /* Unicode characters, in order */
    int typed_count;
} WindowInput;

/* Shows a window, which is hidden when it is opened. */
void window_show(Window *window);

/* Waits for something to happen, but for no longer than `seconds`, which may be 0, and says what
 * has happened. */
void window_input(Window *window, double seconds, WindowInput *input);

/* Shows what was drawn into framebuffer 0; waits for the screen to take it, if it is one to wait
 * for and window_wait_for_screen has not said otherwise. */
void window_swap(Window *window);
void window_wait_for_screen(Window *window, bool wait);

/* Pictures a second that the screen shows. */
double window_refresh_rate(Window *window);

void window_title(Window *window, const char *title);

/* The whole screen, or its place and size before that. */
void window_full_screen(Window *window, bool full);

/* The clipboard's text; "" where it has none. Valid until the next call. */
const char *window_clipboard(Window *window);
void window_set_clipboard(Window *window, const char *text);

/* What has gone wrong in GLFW since the last call; false, with its message, if something has. */
bool window_check(Window *window, Message *message);

#endif
