/*
 * example: what an example is, and the program around it.
 *
 * An example is a descriptor: its name, what it teaches, and three functions. `main` (main.c) hands
 * it to example_main, which reads the options, opens a canvas, draws and writes the picture.
 * Nothing in an example reads a clock: `draw` is given its moment, so every picture can be made
 * again.
 */
#ifndef EXAMPLE_H
#define EXAMPLE_H

#include "gl.h"
#include "shader.h"

/* What there is to draw. */
typedef struct Frame {
    double seconds; /* the moment, from the animation's beginning */
    double aspect;  /* width / height of the picture */
} Frame;

typedef struct Example {
    const char *name;     /* also the name of the program and of its picture */
    const char *summary;  /* one line: what it teaches */
    float clear_color[3]; /* of the background; zero: black */

    /* Loads shaders, fills buffers, finds locations. What it opened is closed by `finish`, which is
     * called after a failure too. */
    bool (*init)(const ShaderLoader *loader, Message *message);
    /* Draws one frame into the canvas, which is cleared already. False where the moment or the
     * aspect has no picture: a matrix cannot be made for it. */
    bool (*draw)(const Frame *frame);
    void (*finish)(void);
} Example;

/* The whole program. Returns its exit code: 0, EXIT_FAILED or EXIT_USAGE. */
int example_main(const Example *example, int argc, char *argv[]);

#endif
