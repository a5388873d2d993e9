/*
 * ShadingModels: two reflection models, four kinds of shading, 24 materials, two lights.
 *
 * The lecture's shading page. One light is fixed, the other turns about the y axis; points mark
 * them. Lighting is in eye coordinates. --reflection original is Phong as that page has it: with
 * --interpolation gouraud its shader computes Blinn's half vector, by mistake.
 *
 * Look at the highlight of a coarse sphere with --interpolation gouraud, at how little Phong and
 * Blinn-Phong differ, and at --explain, which says what each choice costs.
 */
#include "scene/scene_example.h"
#include "scene/shape.h"

static const Vec3 FIXED_LIGHT = {0, 1.5, 1.5}, TURNING_LIGHT = {1.5, 1.5, 0};

/* The options, with their defaults. */
static int shape_kind = SHAPE_SPHERE;
static ShapeModel model;
static Surface surface = {.name = MATERIAL_GOLD_INDEX, .material = MATERIAL_GOLD};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};
static LightColors light_colors = {{0.1, 0.1, 0.1}, {1, 1, 1}, {1, 1, 1}};
static Vec3 global_ambient = {0, 0, 0};
static int kinds[2] = {LIGHT_POINT, LIGHT_POINT};
static bool lights_on[2] = {true, true};
static bool rotating;

static const char *const LIGHT_KINDS[] = {"directional", "point", NULL};

enum { REFLECTION_ORIGINAL = REFLECTION_PHONG + 1 };
static const char *const REFLECTIONS[] = {"blinn-phong", "phong", "original", NULL};

static const Parameter parameters[] = {
    SHAPE_PARAMETERS(shape_kind, model),
    SURFACE_PARAMETERS(surface),
    {"reflection", "the model of the highlight; original: Phong as the lecture's page has it",
     PARAMETER_CHOICE, .value = &shading.reflection, .choices = REFLECTIONS},
    INTERPOLATION_PARAMETERS(shading),
    {"fixed-light", "the fixed light", PARAMETER_SWITCH, .value = &lights_on[0],
     .fixes = 1U << AXIS_LIGHTS},
    {"fixed-kind", "directional, or a point light", PARAMETER_CHOICE, .value = &kinds[0],
     .choices = LIGHT_KINDS, .fixes = 1U << AXIS_LIGHTS},
    {"turning-light", "the light that turns", PARAMETER_SWITCH, .value = &lights_on[1],
     .fixes = 1U << AXIS_LIGHTS},
    {"turning-kind", "directional, or a point light", PARAMETER_CHOICE, .value = &kinds[1],
     .choices = LIGHT_KINDS, .fixes = 1U << AXIS_LIGHTS},
    {"rotating", "turn the object, opposite to the light", PARAMETER_SWITCH, .value = &rotating},
    LIGHT_PARAMETERS(light_colors, global_ambient),
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
    return shape_open(&state.shape, (ShapeKind)shape_kind, SHAPE_LECTURE, &model, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    const Vec3 places[2] = {FIXED_LIGHT, example_turn(TURNING_LIGHT, seconds)};
    (void)view;
    for (int i = 0; i < 2; i++) {
        state.lights[i] = (Light){.kind = (LightKind)kinds[i],
                                  .off = !lights_on[i],
                                  .position = places[i],
                                  .direction = places[i]}; /* if directional */
        light_colors_apply(&light_colors, &state.lights[i]);
    }
    state.object =
        shape_object(&state.shape, example_turned(rotating ? -seconds : 0), surface.material);
    *scene =
        (Scene){.camera = {.eye = {2, 1, 3}, .up = {0, 1, 0}, .fovy = 50, .near = 1, .far = 100},
                .background = {0.2, 0.2, 0.2},
                .lights = state.lights,
                .light_count = 2,
                .objects = &state.object,
                .object_count = 1,
                .global_ambient = global_ambient};
    if (shape_kind == SHAPE_CUBE && !model.path) /* whose corners the original cuts */
        scene->camera.eye = vec3_scale(scene->camera.eye, 1.15);
    scene_shading_apply(&shading, scene);
    if (shading.reflection == REFLECTION_ORIGINAL)
        scene->reflection = shading.interpolation == INTERPOLATION_GOURAUD ? REFLECTION_BLINN_PHONG
                                                                           : REFLECTION_PHONG;
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example ShadingModels = {
    .name = "ShadingModels",
    .summary = "Phong and Blinn-Phong, four kinds of shading, 24 materials, two lights",
    .width = 512,
    .height = 512,
    .tries = {"--shape teapot --interpolation gouraud", "--terms specular --interpolation constant",
              "--material pearl --reflection blinn-phong --show-clipped"},
    .looks = {"colours are interpolated: highlights between vertices are lost",
              "one colour for each triangle: the highlight is a few faces",
              "magenta: more light than can be shown"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .annotate = example_annotate},
    .parameters = parameters,
};
