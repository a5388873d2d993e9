/*
 * LightTypes: the kinds of light on the same sphere and floor.
 *
 * Directional, point and spot; below, point and spot with attenuation, and a spot with an exponent.
 *
 * Look at the floor: evenly lit by parallel rays, brightest below a point, in a circle below a
 * spot.
 */
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

static double constant = 0.2, linear = 0.2, quadratic = 0.2, cutoff = 25, exponent = 40;

static int material = MATERIAL_COUNT;
/* That of red_plastic. */
static const Material OWN = {
    .diffuse = {0.5, 0, 0}, .specular = {0.7, 0.6, 0.6}, .alpha = 1, .shininess = 32};
static LightColors light_colors = {.diffuse = {1, 1, 1}, .specular = {0.6, 0.6, 0.6}};
static Vec3 global_ambient = {0.2, 0.2, 0.2};
static SceneShading shading = {REFLECTION_BLINN_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

static const Parameter parameters[] = {
    {"constant", "1 / (constant + linear d + quadratic d^2) of the light arrives at distance d",
     PARAMETER_NUMBER, .value = &constant, .min = 0, .max = 10},
    {"linear", "attenuation by the distance", PARAMETER_NUMBER, .value = &linear, .min = 0,
     .max = 10},
    {"quadratic", "attenuation by its square", PARAMETER_NUMBER, .value = &quadratic, .min = 0,
     .max = 10},
    {"cutoff", "half the spot's angle, in degrees", PARAMETER_NUMBER, .value = &cutoff, .min = 0,
     .max = 90},
    {"exponent", "the spot's falloff", PARAMETER_NUMBER, .value = &exponent, .min = 0, .max = 128},
    {"material", "of the sphere; none: its own", PARAMETER_CHOICE, .value = &material,
     .choices = MATERIAL_NAMES},
    SHADING_PARAMETERS(shading),
    LIGHT_PARAMETERS(light_colors, global_ambient),
    {.name = NULL},
};

static struct {
    Mesh sphere, floor;
    Light light;
    Object objects[2];
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return mesh_sphere(&state.sphere, 1, 48, 24, message) && mesh_quad(&state.floor, 1, message);
}

static Light light(double seconds, int view)
{
    const Vec3 place = example_turn((Vec3){1, 3, 1.5}, seconds);
    Light made = {.position = place, .cutoff = cutoff};
    light_colors_apply(&light_colors, &made);
    const bool fading = view == 3 || view == 4;
    made.kind = view == 0 ? LIGHT_DIRECTIONAL : view == 1 || view == 3 ? LIGHT_POINT : LIGHT_SPOT;
    made.direction = made.kind == LIGHT_DIRECTIONAL ? place : vec3_scale(place, -1);
    if (fading) {
        made.constant = constant;
        made.linear = linear;
        made.quadratic = quadratic;
    }
    if (view == 5)
        made.exponent = exponent;
    return made;
}

static void scene(double seconds, int view, Scene *scene)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    const Mat4 below = mat4_translate((Vec3){0, -1, -0.7});
    const Mat4 large = mat4_scale((Vec3){3.3, 3.3, 3.3});
    state.light = light(seconds, view);
    state.objects[0] =
        (Object){.mesh = &state.sphere,
                 .solid = {.kind = SOLID_SPHERE, .radius = 1},
                 .closed = true,
                 .world_from_object = mat4_identity(),
                 .front = material < MATERIAL_COUNT ? MATERIALS[material].material : OWN};
    state.objects[1] =
        (Object){.mesh = &state.floor,
                 .solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object = mat4_product(below, mat4_product(lying, large)),
                 .front = {.ambient = {0.6, 0.6, 0.6}, .diffuse = {0.6, 0.6, 0.6}, .alpha = 1}};
    *scene =
        (Scene){.camera = {.eye = {0, 4, 10}, .up = {0, 1, 0}, .fovy = 42, .near = 1, .far = 100},
                .global_ambient = global_ambient,
                .lights = &state.light,
                .light_count = 1,
                .objects = state.objects,
                .object_count = 2};
    scene_shading_apply(&shading, scene);
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    overlay_add_lights(&annotations->points, scene);
}

static const char *label(int view)
{
    static const char *const labels[] = {
        "directional",          "point", "spot", "point, attenuated", "spot, attenuated",
        "spot with an exponent"};
    return labels[view];
}

static void finish(void)
{
    mesh_close(&state.sphere);
    mesh_close(&state.floor);
}

const Example LightTypes = {
    .name = "LightTypes",
    .summary = "directional, point and spot, with and without attenuation",
    .width = 750,
    .height = 500,
    .tries = {"--constant 0.5 --linear 0 --quadratic 0.1", "--cutoff 60 --exponent 128",
              "--terms specular"},
    .looks = {"by the square of the distance: brighter below, the floor by a larger factor",
              "the exponent narrows the last spot, not the cutoff",
              "highlights alone: in one place, weaker where attenuated"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content =
        &(const SceneExample){
            .make = scene, .annotate = annotate, .columns = 3, .rows = 2, .label = label},
    .parameters = parameters,
};
