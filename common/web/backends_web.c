/* A page has no windows of the system. */
#include "window/backends.h"

const CanvasBackend *backend_find(const char *name, Message *message)
{
    return canvas_backend(CANVAS_HEADLESS, name, message);
}

const CanvasBackend *backend_default(Message *message)
{
    return canvas_default_backend(CANVAS_HEADLESS, message);
}
