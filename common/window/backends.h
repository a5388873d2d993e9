/*
 * backends: all canvas backends, with the window's.
 */
#ifndef BACKENDS_H
#define BACKENDS_H

#include "core/canvas.h"

/* NULL-terminated. */
extern const CanvasBackend *const BACKENDS[];

/* The backend of that name; NULL, with a message that lists the names. */
const CanvasBackend *backend_find(const char *name, Message *message);

/* The backend named by LIGHTING_BACKEND in the environment, or EGL; NULL, with a message, if that
 * names none. */
const CanvasBackend *backend_default(Message *message);

#endif
