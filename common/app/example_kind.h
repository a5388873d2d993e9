/*
 * example_kind: what a program is drawn by: a table of operations, one for each kind of program.
 *
 * An example names its kind, and the kind's file refers to what it needs, so that the linker brings
 * that along and nothing else. `app` calls the operations and knows no kind but the lecture's,
 * whose programs draw themselves.
 */
#ifndef EXAMPLE_KIND_H
#define EXAMPLE_KIND_H

#include "app/draw_request.h"
#include "core/canvas.h"
#include "core/example.h"
#include "scene/parameter.h"

struct Options;
struct PanelKind;
struct Usage;

typedef struct ExampleKind ExampleKind;

/* An example that is open; see renderer.h. */
typedef struct Renderer {
    const Example *example; /* NULL: closed */
    const ExampleKind *kind;
    const Canvas *canvas;
    Message warning; /* of the example's shaders: variables of the program that they do not use */
    void *state;     /* the kind's own */
} Renderer;

/* A picture of lines and curves. */
typedef struct VectorFile {
    const char *path, *format; /* "svg", "pdf" */
    int width, height;         /* in pixels */
    bool alpha;
} VectorFile;

/* An operation that a kind does not need is NULL. */
struct ExampleKind {
    bool without_gl;    /* needs of a canvas only its size */
    bool compiles_late; /* shaders are compiled by the first draw that needs them */
    bool bytes;         /* its pictures are bytes, whatever the canvas stores */

    /* Its command line: PROGRAM_* and its own rows (option_table.h); what
     * --help says, and the defaults, that follow from an example. */
    int program;
    const Parameter *options;
    void (*describe)(const Example *example, struct Usage *usage);

    /* Whether what the request names is there: a light, a term. Runs init and finish. */
    bool (*check)(const Example *example, const DrawRequest *request, Message *message);

    /* The names of options that were given and change nothing; see ineffective_options.h. */
    void (*find_ineffective)(const Example *example, const struct Options *options,
                             const ParameterValue *defaults, char *text, size_t size);

    /* After the example's init: `state`. `forget` drops what was made of the example's parameters,
     * which have changed. `close` may be called after a failure. */
    bool (*open)(Renderer *renderer, const ShaderLoader *loader, Message *message);
    void (*forget)(Renderer *renderer);
    void (*close)(Renderer *renderer);

    /* Clears the canvas and draws one frame. */
    bool (*draw)(Renderer *renderer, const DrawRequest *request, double seconds, Message *message);

    /* --verbose: what drawing a picture took. */
    void (*report)(const Renderer *renderer);

    /* Changes a picture of bytes that was drawn and read back: labels. Only if `retouches`. */
    bool (*retouches)(const Example *example);
    bool (*retouch)(Renderer *renderer, const DrawRequest *request, Image *image, Message *message);

    /* Instead of drawing: paints the picture. */
    bool (*paint)(Renderer *renderer, const DrawRequest *request, double seconds, Image *image,
                  Message *message);

    /* Files of lines and curves: the format that a path names, NULL if it names none; and one. */
    const char *(*vector_format)(const char *path);
    bool (*write_vector)(const Example *example, double seconds, const VectorFile *file,
                         Message *message);

    /* --explain, on standard output. */
    bool (*explain)(Renderer *renderer, const DrawRequest *request, Message *message);

    /* Turns so many pages, as far as there are; false: none. */
    bool (*turn_page)(const Example *example, int pages);

    const struct PanelKind *panel; /* what a window's panel shows of it; see panel_kind.h */
};

/* Of programs of the lecture: an example without a kind. */
extern const ExampleKind LECTURE_KIND;

const ExampleKind *example_kind(const Example *example);

#endif
