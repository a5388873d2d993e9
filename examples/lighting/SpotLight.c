/*
 * SpotLight: a light that shines only within a cone.
 *
 * The light turns about the object, aimed at it. Its cone is half as wide as --cutoff says twice;
 * --exponent makes it weaker from its axis outwards.
 *
 * Look at: the hard edge of the cone, and how --exponent softens it; --interpolation gouraud, where
 * the edge can only follow the mesh.
 */
#include "example.h"
#include "shape.h"

static int shape_kind = SHAPE_SPHERE;
static const char *model;
static int interpolation = INTERPOLATION_PHONG;
static double cutoff = 30, exponent = 0;

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
    {.name = "cutoff",
     .help = "half the cone's angle, in degrees",
     .kind = PARAMETER_NUMBER,
     .value = &cutoff,
     .least = 0,
     .most = 90},
    {.name = "exponent",
     .help = "how fast it falls off within the cone",
     .kind = PARAMETER_NUMBER,
     .value = &exponent,
     .least = 0,
     .most = 128},
    {.name = "interpolation",
     .help = "of normals, of colours, or neither",
     .kind = PARAMETER_CHOICE,
     .value = &interpolation,
     .choices = INTERPOLATION_NAMES},
    {.name = NULL},
};

static struct {
    Shape shape;
    Light light;
    Object object;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return shape_open(&state.shape, (ShapeKind)shape_kind, model, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    const Vec3 place = example_turn((Vec3){0, 0, 1.5}, seconds);
    (void)view;
    state.light = (Light){.kind = LIGHT_SPOT,
                          .position = place,
                          .direction = vec3_scale(place, -1),
                          .cutoff = cutoff,
                          .exponent = exponent,
                          .diffuse = {1, 1, 1},
                          .specular = {1, 1, 1}};
    state.object = shape_object(&state.shape, mat4_identity(), *material_find("silver"));
    *scene =
        (Scene){.camera = {.eye = {3, 3, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100},
                .background = {0.2, 0.2, 0.2},
                .global_ambient = {0.3, 0.3, 0.3},
                .lights = &state.light,
                .light_count = 1,
                .objects = &state.object,
                .object_count = 1,
                .reflection = REFLECTION_PHONG,
                .interpolation = (Interpolation)interpolation};
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example SpotLight = {
    .name = "SpotLight",
    .summary = "a light with a cone, its cutoff and its fall-off",
    .init = init,
    .finish = finish,
    .scene = scene,
    .annotate = example_annotate,
    .parameters = parameters,
};
