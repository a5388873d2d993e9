/*
 * scene_example: what an example hands over that does not draw itself: a scene, which `lighting`
 * draws, a diagram, which cairo draws, or pages, which it paints. It names one of these kinds, and
 * its content is of that kind's type.
 */
#ifndef SCENE_EXAMPLE_H
#define SCENE_EXAMPLE_H

#include "base/image.h"
#include "core/example.h"
#include "scene/overlay.h"
#include "scene/parameter.h"
#include "scene/quality.h"
#include "scene/scene.h"

#include <stdio.h>

/* Lines and points of the overlay, in world coordinates. */
typedef struct Annotations {
    OverlayList lines, points;
} Annotations;

extern const struct ExampleKind SCENE_KIND, DIAGRAM_KIND, PAGES_KIND; /* common/kinds */

/* The kind of programs that draw themselves, and may fail. */
extern const struct ExampleKind FALLIBLE_KIND;
typedef struct FallibleExample {
    bool (*draw)(const Frame *frame, Message *message);
} FallibleExample;

/* SCENE_KIND. The init of such an example may be called with a loader of `only_texts` and without
 * texts, when its scenes are wanted as data: it loads no shader then. */
typedef struct SceneExample {
    /* Fills in the scene at a time. The example owns what it points to, until the next call. */
    void (*make)(double seconds, int view, Scene *scene);
    /* The grid of views in the picture, in row order; 0: 1. NULL: it depends on no option. */
    int columns, rows;
    void (*layout)(int *columns, int *rows);
    /* Changes the size of the picture without --size, where that depends on an option; may be NULL.
     */
    void (*size)(int *width, int *height);
    void (*annotate)(double seconds, int view, const Scene *scene, Annotations *annotations);
    const char *(*label)(int view); /* at the bottom of a view; NULL: none */
    /* Instead where an option of all scenes changes what a view computes; may be NULL. */
    const char *(*plain_label)(int view);
    bool shadows;                  /* its lights have them, unless the option says otherwise */
    void (*retouch)(Image *image); /* changes the finished picture, in bytes */
    const char **operand; /* of a program that needs a file: where its name goes; or NULL */
    /* Writes what is not in the scene, though it should be, a line each; may be NULL. */
    void (*explain)(FILE *file);
} SceneExample;

/* NULL: the example describes no scene. */
const SceneExample *example_scene(const Example *example);

/* What a program lets its user choose about shading, with its own defaults. */
typedef struct SceneShading {
    int reflection, interpolation; /* Reflection, Interpolation */
    int viewer;                    /* VIEWER_* */
} SceneShading;
void scene_shading_apply(const SceneShading *shading, Scene *scene);

#define INTERPOLATION_PARAMETERS(shading)                                                          \
    {"interpolation",                                                                              \
     "of normals, of colours; flat: one normal for each triangle; constant: one colour",           \
     PARAMETER_CHOICE,                                                                             \
     .value = &(shading).interpolation,                                                            \
     .choices = INTERPOLATION_NAMES,                                                               \
     .fixes = 1U << AXIS_INTERPOLATION},                                                           \
    {                                                                                              \
        "viewer", "who sees the highlight: the eye at its place, or a viewer at infinity",         \
            PARAMETER_CHOICE, .value = &(shading).viewer, .choices = VIEWER_NAMES,                 \
                              .fixes = 1U << AXIS_VIEWER                                           \
    }
#define SHADING_PARAMETERS(shading)                                                                \
    {"reflection", "the model of the highlight", PARAMETER_CHOICE, .value = &(shading).reflection, \
     .choices = REFLECTION_NAMES},                                                                 \
        INTERPOLATION_PARAMETERS(shading)

/* A material that starts from a named one, whose colours can then be changed one by one. */
typedef struct Surface {
    int name; /* in MATERIAL_NAMES; MATERIAL_COUNT: none */
    Material material;
} Surface;

#define COLOR_PARAMETER(row_name, row_help, color)                                                 \
    {                                                                                              \
        row_name, row_help, PARAMETER_COLOR, .value = &(color), .min = 0, .max = 1                 \
    }
#define COLOR_PARAMETERS(surface)                                                                  \
    COLOR_PARAMETER("ambient", "ambient colour of the surface", (surface).material.ambient),       \
        COLOR_PARAMETER("diffuse", "diffuse colour", (surface).material.diffuse),                  \
        COLOR_PARAMETER("specular", "specular colour", (surface).material.specular),               \
        COLOR_PARAMETER("emission", "what it emits", (surface).material.emission)
#define MATERIAL_PARAMETER(surface)                                                                \
    {                                                                                              \
        "material", "a named material, whose colours other options change; none changes none",     \
            PARAMETER_CHOICE, .value = &(surface).name, .choices = MATERIAL_NAMES,                 \
                              .changed = scene_surface_named                                       \
    }
/* Its value need not be a surface's. */
#define SHININESS_PARAMETER(exponent)                                                              \
    {                                                                                              \
        "shininess", "the highlight's exponent", PARAMETER_NUMBER, .value = &(exponent), .min = 0, \
                                                                   .max = 128                      \
    }
#define OPACITY_PARAMETER(surface)                                                                 \
    {                                                                                              \
        "opacity", "1 is opaque; less shows only in a picture that keeps alpha", PARAMETER_NUMBER, \
            .value = &(surface).material.alpha, .min = 0, .max = 1                                 \
    }
#define SURFACE_PARAMETERS(surface)                                                                \
    MATERIAL_PARAMETER(surface), COLOR_PARAMETERS(surface),                                        \
        SHININESS_PARAMETER((surface).material.shininess), OPACITY_PARAMETER(surface)

/* Of the row "material": sets the material of the Surface that the row's value is in. */
void scene_surface_named(const Parameter *parameter);

/* What a light emits. */
typedef struct LightColors {
    Vec3 ambient, diffuse, specular;
} LightColors;
void light_colors_apply(const LightColors *colors, Light *light);

#define LIGHT_PARAMETERS(colors, global)                                                           \
    COLOR_PARAMETER("light-ambient", "ambient colour of each light", (colors).ambient),            \
        COLOR_PARAMETER("light-diffuse", "its diffuse colour", (colors).diffuse),                  \
        COLOR_PARAMETER("light-specular", "its specular colour", (colors).specular),               \
        COLOR_PARAMETER("global-ambient", "ambient light of the scene", global)

#define DIVISIONS_PARAMETER(model)                                                                 \
    {                                                                                              \
        "divisions", "parts of a full turn of the shape's mesh; 0: as the original has it",        \
            PARAMETER_WHOLE, .value = &(model).divisions, .max = SOLID_MAX_DIVISIONS,              \
                             .fixes = 1U << AXIS_DIVISIONS                                         \
    }

/* A ShapeKind and a ShapeModel. */
#define SHAPE_PARAMETERS(kind, model)                                                              \
    {"shape", "what is lit", PARAMETER_CHOICE, .value = &(kind), .choices = SHAPE_NAMES},          \
        {"model",                                                                                  \
         "a model file (OBJ, PLY, glTF, 3DS...) instead of the shape",                             \
         PARAMETER_TEXT,                                                                           \
         .value = &(model).path,                                                                   \
         .placeholder = "FILE",                                                                    \
         .min = 1},                                                                                \
        {"up", "the axis of the model file that points up", PARAMETER_CHOICE,                      \
         .value = &(model).up, .choices = SHAPE_UP_NAMES},                                         \
        DIVISIONS_PARAMETER(model)

/* The textbook's camera: looks at the origin from `eye`, and shows what lies within `extent` of it
 * to each side. */
Camera example_camera(Vec3 eye, double extent);

struct Drawing;

/* DIAGRAM_KIND: a figure of lines and text, which needs no OpenGL. */
typedef struct DiagramExample {
    /* Fills an empty drawing (images/drawing.h) of any size. */
    bool (*compose)(double seconds, struct Drawing *drawing, Message *message);
} DiagramExample;

struct Canvas;

/* PAGES_KIND: pages of text and of what is drawn with OpenGL, to be leafed
 * through; the first of the program's own options is a choice: the page. */
typedef struct PageExample {
    /* Paints an image of bytes, of any size; may draw into canvases beside this one. */
    bool (*paint)(const Frame *frame, const struct Canvas *canvas, Image *image, Message *message);
    double seconds; /* --time without that option */
} PageExample;

/* As in the lecture: axes of length 2, and the lights as points. */
void example_annotate(double seconds, int view, const Scene *scene, Annotations *annotations);

/* A point, or an object, rotated about the y axis at 30 degrees per second. */
Vec3 example_turn(Vec3 point, double seconds);
Mat4 example_turned(double seconds);

#endif
