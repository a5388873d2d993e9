/*
 * Materials: the effect of diffuse colour, specular colour and shininess.
 *
 * The textbook's demo: a white light at the viewer, lit at the vertices. --material starts from a
 * named material, whose colours the other options change; --sheet on shows all 24.
 *
 * Look at the highlights: metals reflect in their own colour, plastics in white.
 */
#include "scene/scene_example.h"
#include "scene/shape.h"

#include <math.h>

enum { BLACK_PLASTIC = 12 }; /* in MATERIALS */
/* With shininess 0 the demo's highlight is full wherever V.R > 0, and nothing elsewhere: what any
 * exponent more than 0 comes to. An exponent of 0 means 1 everywhere (0 to the power of 0). */
static const double LEAST_SHININESS = 1e-6;

static int shape_kind = SHAPE_TEAPOT;
static ShapeModel model;
static bool sheet;
static Surface surface = {.name = MATERIAL_COUNT,
                          .material = {.ambient = {0.6, 0.6, 0.6},
                                       .diffuse = {0.6, 0.6, 0.6},
                                       .specular = {1, 1, 1},
                                       .alpha = 1,
                                       .shininess = 16}};
static LightColors light_colors = {.diffuse = {1, 1, 1}, .specular = {0.4, 0.4, 0.4}};
static Vec3 global_ambient = {0, 0, 0};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_GOURAUD, VIEWER_INFINITE};

/* The demo sets ambient and diffuse colour together, and shininess in whole numbers; its black
 * plastic has white highlights. */
static void diffuse_changed(const Parameter *parameter)
{
    (void)parameter;
    surface.material.ambient = surface.material.diffuse;
}

static void material_changed(const Parameter *parameter)
{
    scene_surface_named(parameter);
    surface.material.shininess = round(surface.material.shininess);
    if (surface.name == BLACK_PLASTIC)
        surface.material.specular = (Vec3){1, 1, 1};
    diffuse_changed(parameter);
}

static const Parameter parameters[] = {
    SHAPE_PARAMETERS(shape_kind, model),
    {"material", "a named material, with its diffuse colour as the ambient one", PARAMETER_CHOICE,
     .value = &surface.name, .choices = MATERIAL_NAMES, .changed = material_changed},
    {"diffuse", "diffuse and ambient colour", PARAMETER_COLOR, .value = &surface.material.diffuse,
     .min = 0, .max = 1, .changed = diffuse_changed},
    COLOR_PARAMETER("ambient", "ambient colour alone", surface.material.ambient),
    COLOR_PARAMETER("specular", "specular colour", surface.material.specular),
    COLOR_PARAMETER("emission", "what it emits", surface.material.emission),
    SHININESS_PARAMETER(surface.material.shininess),
    OPACITY_PARAMETER(surface),
    {"sheet", "all named materials instead, as they are", PARAMETER_SWITCH, .value = &sheet},
    SHADING_PARAMETERS(shading),
    LIGHT_PARAMETERS(light_colors, global_ambient),
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
    return shape_open(&state.shape, (ShapeKind)shape_kind, SHAPE_TEXTBOOK, &model, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    Material material = sheet ? MATERIALS[view].material : surface.material;
    material.shininess = fmax(material.shininess, LEAST_SHININESS);
    state.light = (Light){.kind = LIGHT_DIRECTIONAL, .space = LIGHT_EYE, .direction = {0, 0, 1}};
    light_colors_apply(&light_colors, &state.light);
    state.object = shape_object(&state.shape, example_turned(seconds), material);
    *scene = (Scene){.camera = example_camera((Vec3){2, 2, 5}, 0.8),
                     .background = {1, 1, 1},
                     .global_ambient = global_ambient,
                     .lights = &state.light,
                     .light_count = 1,
                     .objects = &state.object,
                     .object_count = 1};
    scene_shading_apply(&shading, scene);
    if (sheet)
        scene->background = (Vec3){0.2, 0.2, 0.2}; /* the labels are white */
}

static void layout(int *columns, int *rows)
{
    *columns = sheet ? 6 : 1;
    *rows = sheet ? 4 : 1;
}

static void size(int *width, int *height)
{
    *width = sheet ? 900 : 300;
    *height = sheet ? 600 : 300;
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
    .tries = {"--diffuse 1,0,0 --specular 0,1,0", "--shape torus --orbit 0,40",
              "--diffuse 0.5,0,0 --shininess 0"},
    .looks = {"green is added to red: the highlight is orange",
              "the highlights stay towards you: so does the light",
              "shininess 0: the highlight is everywhere within 45 degrees of the light"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .layout = layout, .size = size, .label = label},
    .parameters = parameters,
};
