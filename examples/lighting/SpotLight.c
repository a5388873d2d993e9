/*
 * SpotLight: a light that shines only within a cone.
 *
 * The light turns about the object and aims at it. --cutoff is half the cone's angle; --exponent
 * makes the light weaker away from the axis. As on the lecture's page, the light's ambient term is
 * not cut off: what the cone does not reach is dark, not black. --ambient-cone on cuts it off, too,
 * as OpenGL 1.1 does.
 *
 * Look at the hard edge of the cone and how --exponent softens it, and at --interpolation gouraud,
 * where the edge follows the mesh.
 */
#include "scene/scene_example.h"
#include "scene/shape.h"

static int shape_kind = SHAPE_SPHERE;
static ShapeModel model;
static double cutoff = 30, exponent = 0;
static bool ambient_cone;
static Surface surface = {.name = MATERIAL_GOLD_INDEX, .material = MATERIAL_GOLD};
static LightColors light_colors = {{0.1, 0.1, 0.1}, {1, 1, 1}, {1, 1, 1}};
static Vec3 global_ambient = {0, 0, 0};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

static const Parameter parameters[] = {
    SHAPE_PARAMETERS(shape_kind, model),
    {"cutoff", "half the cone's angle, in degrees", PARAMETER_NUMBER, .value = &cutoff, .min = 0,
     .max = 90},
    {"exponent", "how fast it falls off within the cone", PARAMETER_NUMBER, .value = &exponent,
     .min = 0, .max = 128},
    {"ambient-cone", "cut off the light's ambient term, too, as OpenGL 1.1 does", PARAMETER_SWITCH,
     .value = &ambient_cone},
    SURFACE_PARAMETERS(surface),
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
    return shape_open(&state.shape, (ShapeKind)shape_kind, SHAPE_LECTURE, &model, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    const Vec3 place = example_turn((Vec3){0, 0, 1.5}, seconds);
    (void)view;
    state.light = (Light){.kind = LIGHT_SPOT,
                          .position = place,
                          .direction = vec3_scale(place, -1),
                          .cutoff = cutoff,
                          .exponent = exponent};
    light_colors_apply(&light_colors, &state.light);
    state.object = shape_object(&state.shape, mat4_identity(), surface.material);
    *scene =
        (Scene){.camera = {.eye = {3, 3, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100},
                .background = {0.2, 0.2, 0.2},
                .global_ambient = global_ambient,
                .lights = &state.light,
                .light_count = 1,
                .objects = &state.object,
                .object_count = 1};
    if (!ambient_cone) { /* then it is the same everywhere, as the scene's own ambient light */
        scene->global_ambient = vec3_add(global_ambient, light_colors.ambient);
        state.light.ambient = (Vec3){0, 0, 0};
    }
    scene_shading_apply(&shading, scene);
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example SpotLight = {
    .name = "SpotLight",
    .summary = "a light with a cone, its cutoff and its falloff",
    .width = 512,
    .height = 512,
    .tries = {"--shape cube --interpolation gouraud --global-ambient 0.2",
              "--exponent 60 --cutoff 60 --global-ambient 0.2",
              "--shape teapot --cutoff 90 --time 2"},
    .looks = {"no corner is within the cone: nothing is lit",
              "no hard edge: the light fades before the cone ends",
              "a cone of 180 degrees lights all that faces it"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .annotate = example_annotate},
    .parameters = parameters,
};
