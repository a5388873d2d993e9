/* The list of backends, and the choice from it. */
#include "window/backends.h"

#include "window/window.h"

const CanvasBackend *const BACKENDS[] = {&CANVAS_EGL, &CANVAS_OSMESA, &CANVAS_WINDOW, NULL};

const CanvasBackend *backend_find(const char *name, Message *message)
{
    return canvas_backend(BACKENDS, name, message);
}

const CanvasBackend *backend_default(Message *message)
{
    return canvas_default_backend(BACKENDS, message);
}
