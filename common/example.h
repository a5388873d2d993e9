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
#include "image.h"
#include "marks.h"
#include "orbit.h"
#include "parameter.h"
#include "scene.h"
#include "shader.h"

/* What there is to draw. */
typedef struct Frame {
    double seconds; /* the moment, from the animation's beginning */
    double aspect;  /* width / height of the picture */
    Orbit orbit;    /* how the camera has been moved */
} Frame;

/* The lines and points that explain a scene, in the world. */
typedef struct Annotations {
    MarkList lines, points;
} Annotations;

typedef struct Example {
    const char *name;     /* also the name of the program and of its picture */
    const char *summary;  /* one line: what it teaches */
    float clear_color[3]; /* of the background; zero: black. A scene has its own */
    int width, height;    /* of the picture; zero: 400 */

    /* Loads shaders, makes meshes, finds locations. What it opened is closed by `finish`, which is
     * called after a failure too. */
    bool (*init)(const ShaderLoader *loader, Message *message);
    void (*finish)(void);

    /* Either: draws one frame into the canvas, which is cleared already. False where the moment or
     * the aspect has no picture: a matrix cannot be made for it. */
    bool (*draw)(const Frame *frame);

    /* Or: the scene of a moment, which common/lighting draws. What it points to is the example's,
     * and lasts until the next call. With several views, each has a part of the picture, row after
     * row. */
    void (*scene)(double seconds, int view, Scene *scene);
    void (*layout)(int *columns, int *rows); /* of the views; NULL: one view */
    void (*annotate)(double seconds, int view, const Scene *scene, Annotations *annotations);
    const char *(*label)(int view); /* a line of text at the foot of a view; NULL: none */
    void (*retouch)(Image *image);  /* the last word on the picture, in bytes */

    const Parameter *parameters; /* its own options, ended by a NULL name */
} Example;

/* What the lecture's pages show: the axes, of length 2, and the lights as points. */
void example_annotate(double seconds, int view, const Scene *scene, Annotations *annotations);

/* mat4_look_at from where the frame's orbit has moved the eye. */
bool frame_look_at(const Frame *frame, Vec3 eye, Vec3 center, Vec3 up, Mat4 *eye_from_world);

/* A point, or an object, turned about the y axis at the pace of 30 degrees a second. */
Vec3 example_turn(Vec3 point, double seconds);
Mat4 example_turned(double seconds);

/* The whole program. Returns its exit code: 0, EXIT_FAILED or EXIT_USAGE. */
int example_main(const Example *example, int argc, char *argv[]);

#endif
