/*
 * canvas: a place to draw, and the way to read back what was drawn.
 *
 * A backend makes an OpenGL ES 2 context current; the canvas draws into framebuffer objects of its
 * own, so that every backend has the same formats, size and antialiasing. One canvas is open at a
 * time.
 */
#ifndef CANVAS_H
#define CANVAS_H

#include "gl.h"
#include "image.h"
#include "matrix.h"

typedef struct CanvasOptions CanvasOptions;

/* What a backend is: one table of functions. `open` leaves a context current, loads nothing else,
 * and puts what it holds in *context; `platform` is for --verbose ("surfaceless"). */
typedef struct CanvasBackend {
    const char *name;
    const char *summary;
    bool presents; /* framebuffer 0 is a window's, for canvas_present */
    bool (*open)(void **context, const CanvasOptions *options, const char **platform,
                 Message *message);
    GlFunction (*address)(const char *name);
    bool (*current)(void *context); /* whether it is still the one that GL functions act on */
    void (*close)(void *context);
    /* Says on standard output what each platform and library answers and what to install; true
     * where the backend works. For --doctor. */
    bool (*doctor)(void);
} CanvasBackend;

extern const CanvasBackend CANVAS_EGL, CANVAS_OSMESA, CANVAS_WINDOW;

/* NULL-terminated: every backend there is. */
extern const CanvasBackend *const CANVAS_BACKENDS[];

/* The backend of that name; NULL, with a message that names those there are. */
const CanvasBackend *canvas_backend(const char *name, Message *message);

/* The one that the environment's LIGHTING_BACKEND names, or EGL; NULL, with a message, where there
 * is none of that name. */
const CanvasBackend *canvas_default_backend(Message *message);

struct CanvasOptions {
    const CanvasBackend *backend; /* NULL: the default one */
    int width, height;            /* 1.. what the driver allows */
    int samples;       /* 0 or 1: none. More: a multisampled framebuffer that is resolved,
                          or supersampling where the driver has none */
    int supersample;   /* 0 or 1: none. K: K x K pixels for each, averaged */
    bool real;         /* colours as floats, not clamped, where the driver can */
    const char *title; /* of a window */
};

typedef struct Canvas {
    const CanvasBackend *backend;
    void *context;
    bool beside; /* another canvas owns the context */
    const char *platform;
    const char *renderer, *version; /* GL_RENDERER, GL_VERSION */
    int width, height;
    int samples;     /* as the driver gave them; 0 for none */
    int supersample; /* 1 for none */
    bool real;
    int red_bits, green_bits, blue_bits, alpha_bits, depth_bits;
    GLuint framebuffer, color, depth;          /* drawn to */
    GLuint resolve_framebuffer, resolve_color; /* read from, with samples */
} Canvas;

/* Opens a canvas with 8-bit RGBA (or float) colour and at least 24 bits of depth, and checks that
 * it got them. `canvas` is zeroed on failure. */
bool canvas_open(Canvas *canvas, const CanvasOptions *options, Message *message);

/* Opens another canvas in the context of `first`, of its own size and kind; options->backend does
 * not count. It is to be closed before `first`. */
bool canvas_open_beside(Canvas *canvas, const Canvas *first, const CanvasOptions *options,
                        Message *message);

/* Gives an open canvas another size, in the same context. On failure it can only be closed. */
bool canvas_resize(Canvas *canvas, int width, int height, Message *message);

/* Binds the canvas's framebuffer and sets the viewport to all of it: the beginning of every frame.
 */
void canvas_begin(const Canvas *canvas);

/* The same, and clears all of it to a colour, and to the depth that is farthest away. */
void canvas_clear(const Canvas *canvas, Vec3 color, double alpha);

/* Limits drawing, until canvas_begin, to the rectangle whose upper left pixel is (x, y), row 0
 * being the top. */
void canvas_view(const Canvas *canvas, int x, int y, int width, int height);

/* Whether GL functions still act on the canvas's context, and the driver has not lost it: the
 * latter where a driver tells, which GLFW cannot have it do for a window. */
bool canvas_check(const Canvas *canvas, Message *message);

/* Copies what was drawn, or an image of bytes, to framebuffer 0, that of a window, whose size is
 * given, and leaves that bound. Where the sizes differ, as with supersampling, pixels are
 * interpolated. */
void canvas_present(const Canvas *canvas, int width, int height);
bool canvas_present_image(const Image *image, int width, int height, Message *message);

/* Resolves, reads back and turns the rows the right way up: row 0 is the top. `image` must have the
 * canvas's size; its type must be IMAGE_FLOAT for a real canvas, else IMAGE_BYTE. Reports any GL
 * error since the last call. */
bool canvas_read(const Canvas *canvas, Image *image, Message *message);

/* NULL or a zeroed canvas is fine. */
void canvas_close(Canvas *canvas);

#endif
