/*
 * ShadingModels: two reflection models, two interpolations, 24 materials, two lights.
 *
 * The lecture's shading page. One light stands still, the other turns about the y axis; the points
 * show where they are. Everything is lit in eye coordinates.
 *
 * Look at: the highlight of a coarse sphere with --interpolation gouraud; how little Phong and
 * Blinn-Phong differ; --explain, which tells what each choice costs.
 */
#include "example.h"
#include "shape.h"

static const Vec3 FIXED_LIGHT = {0, 1.5, 1.5}, TURNING_LIGHT = {1.5, 1.5, 0};

/* The options, with their defaults. */
static int shape_kind = SHAPE_SPHERE;
static const char *model;
static int material = 10; /* gold */
static int reflection = REFLECTION_PHONG;
static int interpolation = INTERPOLATION_PHONG;
static int kinds[2] = {LIGHT_POINT, LIGHT_POINT};
static bool lights_on[2] = {true, true};
static bool rotating;

static const char *const LIGHT_KINDS[] = {"directional", "point", NULL};

static const Parameter parameters[] = {
    {.name = "shape",
     .help = "what is lit",
     .kind = PARAMETER_CHOICE,
     .value = &shape_kind,
     .choices = SHAPE_NAMES},
    {.name = "model",
     .help = "a model file (OBJ, PLY, glTF, 3DS...) in the place of the solid",
     .kind = PARAMETER_TEXT,
     .value = &model},
    {.name = "material",
     .help = "what it is made of",
     .kind = PARAMETER_CHOICE,
     .value = &material,
     .choices = MATERIAL_NAMES},
    {.name = "reflection",
     .help = "the model of the highlight",
     .kind = PARAMETER_CHOICE,
     .value = &reflection,
     .choices = REFLECTION_NAMES},
    {.name = "interpolation",
     .help = "of normals, of colours, or neither",
     .kind = PARAMETER_CHOICE,
     .value = &interpolation,
     .choices = INTERPOLATION_NAMES},
    {.name = "fixed-light",
     .help = "the light that stands still",
     .kind = PARAMETER_SWITCH,
     .value = &lights_on[0]},
    {.name = "fixed-kind",
     .help = "whether it has a place",
     .kind = PARAMETER_CHOICE,
     .value = &kinds[0],
     .choices = LIGHT_KINDS},
    {.name = "turning-light",
     .help = "the light that turns",
     .kind = PARAMETER_SWITCH,
     .value = &lights_on[1]},
    {.name = "turning-kind",
     .help = "whether it has a place",
     .kind = PARAMETER_CHOICE,
     .value = &kinds[1],
     .choices = LIGHT_KINDS},
    {.name = "rotating",
     .help = "the object turns, against the light",
     .kind = PARAMETER_SWITCH,
     .value = &rotating},
    {.name = NULL},
};

static struct {
    Shape shape;
    Light lights[2];
    Object object;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return shape_open(&state.shape, (ShapeKind)shape_kind, model, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    const Vec3 places[2] = {FIXED_LIGHT, example_turn(TURNING_LIGHT, seconds)};
    (void)view;
    for (int i = 0; i < 2; i++)
        state.lights[i] = (Light){.kind = (LightKind)kinds[i],
                                  .off = !lights_on[i],
                                  .position = places[i],
                                  .direction = places[i], /* if it has no place */
                                  .ambient = {0.1, 0.1, 0.1},
                                  .diffuse = {1, 1, 1},
                                  .specular = {1, 1, 1}};
    state.object = shape_object(&state.shape, example_turned(rotating ? -seconds : 0),
                                MATERIALS[material].material);
    *scene =
        (Scene){.camera = {.eye = {2, 1, 3}, .up = {0, 1, 0}, .fovy = 50, .near = 1, .far = 100},
                .background = {0.2, 0.2, 0.2},
                .lights = state.lights,
                .light_count = 2,
                .objects = &state.object,
                .object_count = 1,
                .reflection = (Reflection)reflection,
                .interpolation = (Interpolation)interpolation};
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example ShadingModels = {
    .name = "ShadingModels",
    .summary = "Phong and Blinn-Phong, Gouraud and Phong interpolation, 24 materials",
    .width = 512,
    .height = 512,
    .init = init,
    .finish = finish,
    .scene = scene,
    .annotate = example_annotate,
    .parameters = parameters,
};
