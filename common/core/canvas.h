/*
 * canvas: a framebuffer to draw into and to read back.
 *
 * A backend makes an OpenGL ES 2 context current; the canvas draws into framebuffer objects of its
 * own, so that all backends have the same formats, size and antialiasing. One canvas is open at a
 * time.
 */
#ifndef CANVAS_H
#define CANVAS_H

#include "base/image.h"
#include "core/gl.h"
#include "core/matrix.h"

typedef struct CanvasOptions CanvasOptions;

/* `open` leaves a context current and stores its state in *context; `platform` names what it runs
 * on ("surfaceless"). */
typedef struct CanvasBackend {
    const char *name;
    const char *summary;
    bool presents; /* framebuffer 0 is a window's, for canvas_present */
    bool (*open)(void **context, const CanvasOptions *options, const char **platform,
                 Message *message);
    GlFunction (*address)(const char *name);
    bool (*current)(void *context); /* whether GL functions still act on it */
    void (*close)(void *context);
    /* Loads its library and appends package_tell's line. True if it is there. */
    bool (*package)(Message *findings);
    /* Appends lines to `findings`: what each platform answers, what to install. True if the backend
     * works. */
    bool (*probe)(Message *findings);
    /* Of one in a plugin, which has only the first three: it. */
    const struct CanvasBackend *(*load)(void);
} CanvasBackend;

const CanvasBackend *canvas_backend_load(const CanvasBackend *backend);

extern const CanvasBackend CANVAS_EGL, CANVAS_OSMESA;
#define CANVAS_OSMESA_SUMMARY "headless, Mesa's off-screen renderer without EGL"

/* Those of this platform that need no display, the default first; ended by NULL. */
extern const CanvasBackend *const CANVAS_HEADLESS[];

/* The backend of that name in a NULL-terminated list; NULL, with a message that lists the names. */
const CanvasBackend *canvas_backend(const CanvasBackend *const *backends, const char *name,
                                    Message *message);

/* The backend named by LIGHTING_BACKEND in the environment, or the first of the list; NULL, with a
 * message, if that names none. */
const CanvasBackend *canvas_default_backend(const CanvasBackend *const *backends, Message *message);

struct CanvasOptions {
    const CanvasBackend *backend; /* NULL: the default of CANVAS_HEADLESS */
    int width, height;            /* 1 to the driver's limit */
    int samples;       /* 0 or 1: none. More: a multisampled framebuffer that is resolved, or
                          supersampling if the driver has none */
    bool supersampled; /* never a multisampled framebuffer */
    int supersample;   /* 0 or 1: none. K: the mean of K x K pixels */
    bool real;         /* unclamped float colours, if the driver can draw to them */
    const char *title; /* of a window */
    /* Called when a window's connection to the display is lost. Must not return: Xlib would end the
     * process. NULL: Xlib's own handler. */
    void (*lost)(const char *title);
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
    bool supersampled;
    bool real;
    int red_bits, green_bits, blue_bits, alpha_bits, depth_bits;
    GLuint framebuffer, color, depth;          /* drawn to */
    GLuint resolve_framebuffer, resolve_color; /* read from, with samples */
} Canvas;

/* Opens a canvas of 8-bit RGBA (or float) colour and at least 24 bits of depth, and checks that the
 * driver provides them. `canvas` is zeroed on failure. */
bool canvas_open(Canvas *canvas, const CanvasOptions *options, Message *message);

/* Opens another canvas in the context of `first`, with its own size and type; options->backend is
 * ignored. Must be closed before `first`. */
bool canvas_open_beside(Canvas *canvas, const Canvas *first, const CanvasOptions *options,
                        Message *message);

/* Resizes an open canvas, in the same context. After a failure it can only be closed. */
bool canvas_resize(Canvas *canvas, int width, int height, Message *message);

/* The most samples that the driver or supersampling has, and another number of them, as
 * CanvasOptions has them. False, and the canvas as before, if there are not so many; after another
 * failure it can only be closed. */
int canvas_max_samples(const Canvas *canvas);
bool canvas_set_samples(Canvas *canvas, int samples, bool supersampled, Message *message);

/* Starts a frame: binds the framebuffer and sets the viewport to all of it. */
void canvas_begin(const Canvas *canvas);

/* canvas_begin, then clears colour and depth. */
void canvas_clear(const Canvas *canvas, Vec3 color, double alpha);

/* Limits drawing, until canvas_begin, to a rectangle with its upper left pixel at (x, y); row 0 is
 * the top. */
void canvas_view(const Canvas *canvas, int x, int y, int width, int height);

/* A vertex attribute as it is set, so that what others rely on can be put back. */
typedef struct CanvasAttribute {
    GLuint location;
    GLint enabled, size, type, normalized, stride, buffer;
    void *pointer;
    bool valued;      /* in desktop OpenGL attribute 0 has none */
    GLfloat value[4]; /* without an array; undefined after a draw with one */
} CanvasAttribute;
CanvasAttribute canvas_attribute(GLuint location);
void canvas_set_attribute(const CanvasAttribute *attribute); /* binds its buffer */

/* Whether GL functions still act on the canvas's context and the driver has not reset it. Resets
 * are not reported for a window: GLFW cannot request that. */
bool canvas_check(const Canvas *canvas, Message *message);

/* Copies what was drawn, or an image's first columns, to framebuffer 0 of a window and leaves that
 * bound: to a rectangle x, y, width, height, from the lower left. Interpolates if the sizes differ.
 */
void canvas_present(const Canvas *canvas, const int place[4]);
bool canvas_present_image(const Image *image, int columns, const int place[4], Message *message);

/* Resolves, reads back and flips the rows: row 0 is the top. `image` must have the canvas's size,
 * and the type IMAGE_FLOAT for a real canvas, else IMAGE_BYTE. Reports any GL error since the last
 * call. */
bool canvas_read(const Canvas *canvas, Image *image, Message *message);

/* NULL or zeroed is fine. */
void canvas_close(Canvas *canvas);

/* A texture of one level, not bound, whose texels are not set. It shows the nearest of them, beyond
 * its edges the last. */
GLuint canvas_texture(GLenum format, GLenum type, int width, int height);

#endif
