/*
 * Materials: what diffuse colour, specular colour and shininess make of an object.
 *
 * One white light at the viewer. The colours are the options', or those of a named material
 * (--preset); --sheet on shows all 24 of these.
 *
 * Look at: metals, whose highlights have the colour of the metal, and plastics, whose highlights
 * are white.
 */
#include "example.h"
#include "shape.h"

static int shape_kind = SHAPE_TEAPOT;
static const char *model;
static bool sheet;
static int preset = MATERIAL_COUNT; /* none */
static Vec3 diffuse = {0.6, 0.6, 0.6}, specular = {1, 1, 1};
static double shininess = 16;

static const Parameter parameters[] = {
    {.name = "object",
     .help = "what is lit",
     .kind = PARAMETER_CHOICE,
     .value = &shape_kind,
     .choices = SHAPE_NAMES},
    {.name = "model",
     .help = "a model file (OBJ, PLY, glTF, 3DS...) in the place of the solid",
     .kind = PARAMETER_TEXT,
     .value = &model},
    {.name = "preset",
     .help = "a named material, in the place of the colours",
     .kind = PARAMETER_CHOICE,
     .value = &preset,
     .choices = MATERIAL_NAMES},
    {.name = "diffuse",
     .help = "its colour",
     .kind = PARAMETER_COLOR,
     .value = &diffuse,
     .least = 0,
     .most = 1},
    {.name = "specular",
     .help = "its highlight's colour",
     .kind = PARAMETER_COLOR,
     .value = &specular,
     .least = 0,
     .most = 1},
    {.name = "shininess",
     .help = "the highlight's exponent",
     .kind = PARAMETER_NUMBER,
     .value = &shininess,
     .least = 0,
     .most = 128},
    {.name = "sheet", .help = "all named materials", .kind = PARAMETER_SWITCH, .value = &sheet},
    {.name = NULL},
};

static const Light LIGHT = {.kind = LIGHT_POINT,
                            .position = {0, 1, 4},
                            .ambient = {0.1, 0.1, 0.1},
                            .diffuse = {1, 1, 1},
                            .specular = {0.4, 0.4, 0.4}};

static struct {
    Shape shape;
    Object object;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return shape_open(&state.shape, (ShapeKind)shape_kind, model, message);
}

static Material material(int view)
{
    if (sheet)
        return MATERIALS[view].material;
    if (preset < MATERIAL_COUNT)
        return MATERIALS[preset].material;
    return (Material){.ambient = diffuse,
                      .diffuse = diffuse,
                      .specular = specular,
                      .alpha = 1,
                      .shininess = shininess};
}

static void scene(double seconds, int view, Scene *scene)
{
    state.object = shape_object(&state.shape, example_turned(seconds), material(view));
    *scene =
        (Scene){.camera = {.eye = {0, 1, 4}, .up = {0, 1, 0}, .fovy = 40, .near = 1, .far = 100},
                .background = {1, 1, 1},
                .lights = &LIGHT,
                .light_count = 1,
                .objects = &state.object,
                .object_count = 1,
                .reflection = REFLECTION_PHONG};
    if (sheet)
        scene->background = (Vec3){0.2, 0.2, 0.2}; /* for the labels, which are white */
}

static void layout(int *columns, int *rows)
{
    *columns = sheet ? 6 : 1;
    *rows = sheet ? 4 : 1;
}

static const char *label(int view)
{
    return sheet ? MATERIALS[view].name : NULL;
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example Materials = {
    .name = "Materials",
    .summary = "diffuse and specular colour and shininess, and 24 named materials",
    .width = 600,
    .height = 400,
    .init = init,
    .finish = finish,
    .scene = scene,
    .layout = layout,
    .label = label,
    .parameters = parameters,
};
