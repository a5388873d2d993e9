/*
 * example_kind: what a program is drawn by: a table of operations, one for each kind of program.
 *
 * An example names its kind, and the kind's file refers to what it needs, so that the linker brings
 * that along and nothing else. `app` calls the operations and knows no kind but the lecture's,
 * whose programs draw themselves.
 */
#ifndef EXAMPLE_KIND_H
#define EXAMPLE_KIND_H

#include "core/canvas.h"
#include "core/example.h"
#include "core/orbit.h"
#include "core/shader.h"
#include "probe/exact_pixel.h"
#include "scene/parameter.h"
#include "scene/scene.h"

/* What to draw, as what draws is told: the command line's answer, resolved. options_request
 * (options.h) makes it; programs and tests without a command line write it as it is. Zeroed, it
 * asks for one picture as the program has it, its scenes without shadows. */
typedef struct DrawRequest {
    ShaderLoader shaders;
    bool verbose; /* what runs where, and how long it takes, goes to standard error */
    bool alpha;   /* the background is transparent */
    Orbit orbit;
    /* All moments that will be asked for: of a window, which goes on, any. */
    double seconds, fps;
    int frames;
    bool endless;

    /* Of scenes. */
    bool full;         /* the program that has every effect */
    bool clamp_vertex; /* see scene.h */
    bool signed_dots;
    bool linear;
    bool show_clipped;
    bool normals; /* as lines over the picture */
    SceneTerms terms;
    ShadowSettings shadows;
    LightPlaces places;
    LightTints tints;
    bool cheap;     /* as cheaply as an error of `error` steps of 1/255 allows */
    double error;   /* in steps of 1/255 */
    unsigned fixed; /* with `cheap`, the axes of quality that stay: bits of 1 << QualityAxis */
} DrawRequest;

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

    /* --save-scene; without a canvas. After success a message is a warning. */
    bool (*save)(const Example *example, const DrawRequest *request, const char *path,
                 Message *message);

    /* --explain, on standard output. */
    bool (*explain)(Renderer *renderer, const DrawRequest *request, Message *message);

    /* What is exactly at a pixel's centre. False: unknown. */
    bool (*exact)(Renderer *renderer, const DrawRequest *request, const int pixel[2],
                  ExactPixel *exact);

    /* Turns so many pages, as far as there are; false: none. */
    bool (*turn_page)(const Example *example, int pages);

    const struct PanelKind *panel; /* what a window's panel shows of it; see panel_kind.h */
};

/* Of programs of the lecture: an example without a kind. */
extern const ExampleKind LECTURE_KIND;

const ExampleKind *example_kind(const Example *example);

#endif
