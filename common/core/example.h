/*
 * example: a program of the chapter: its name, what it teaches, and three functions.
 *
 * `main` (common/main.c) passes it to example_main (app/run.h), which reads the options, opens a
 * canvas, draws and writes the picture. `draw` gets the time and reads no clock, so every picture
 * is reproducible.
 */
#ifndef EXAMPLE_H
#define EXAMPLE_H

#include "core/gl.h"
#include "core/orbit.h"
#include "core/shader.h"

/* What to draw. */
typedef struct Frame {
    double seconds; /* since the start of the animation */
    double aspect;  /* width / height of the picture */
    Orbit orbit;    /* how the user has moved the camera */
} Frame;

typedef struct Example {
    const char *name;     /* of the program and of its picture */
    const char *summary;  /* one line: what it teaches */
    float clear_color[3]; /* of the background; zero: black */
    int width, height;    /* of the picture; zero: 400 */
    const char *tries[4]; /* arguments that --help suggests; ended by NULL; none: common ones */
    const char *looks[4]; /* what to look for in each */

    /* Loads shaders, makes meshes, finds locations. `finish` closes what it opened, also after a
     * failure. Both NULL for a diagram. */
    bool (*init)(const ShaderLoader *loader, Message *message);
    void (*finish)(void);

    /* Draws one frame into the canvas, which is already cleared. */
    void (*draw)(const Frame *frame);

    /* Of a program that does not draw itself: what draws, and what it is given. NULL: `draw`. */
    const struct ExampleKind *kind;     /* see app/example_kind.h */
    const void *content;                /* of the type that the kind says */
    const struct Parameter *parameters; /* its own options, ended by a NULL name; NULL: none */
} Example;

/* The lecture's animations turn at this rate, so that --angle selects a time. */
enum { DEGREES_PER_SECOND = 30 };

/* mat4_look_at from where the frame's orbit has moved the eye. */
static inline Mat4 frame_look_at(const Frame *frame, Vec3 eye, Vec3 center, Vec3 up)
{
    orbit_move(frame->orbit, &eye, center, &up);
    return mat4_look_at(eye, center, up);
}

#endif
