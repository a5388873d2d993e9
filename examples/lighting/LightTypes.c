/*
 * LightTypes: the kinds of light on the same sphere and floor.
 *
 * Directional, point and spot; below, the latter two fading with the distance, and a spot whose
 * light falls off within its cone.
 *
 * Look at: the floor: evenly lit by parallel rays, in a pool under a point, in a circle under a
 * spot.
 */
#include "example.h"

static double linear = 0.2, quadratic = 0.2, cutoff = 25, exponent = 40;

static const Parameter parameters[] = {
    {.name = "linear",
     .help = "attenuation by the distance",
     .kind = PARAMETER_NUMBER,
     .value = &linear,
     .least = 0,
     .most = 10},
    {.name = "quadratic",
     .help = "attenuation by its square",
     .kind = PARAMETER_NUMBER,
     .value = &quadratic,
     .least = 0,
     .most = 10},
    {.name = "cutoff",
     .help = "half the spot's angle, in degrees",
     .kind = PARAMETER_NUMBER,
     .value = &cutoff,
     .least = 0,
     .most = 90},
    {.name = "exponent",
     .help = "the spot's fall-off",
     .kind = PARAMETER_NUMBER,
     .value = &exponent,
     .least = 0,
     .most = 128},
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
    Light made = {
        .position = place, .diffuse = {1, 1, 1}, .specular = {0.6, 0.6, 0.6}, .cutoff = cutoff};
    const bool fading = view == 3 || view == 4;
    made.kind = view == 0 ? LIGHT_DIRECTIONAL : view == 1 || view == 3 ? LIGHT_POINT : LIGHT_SPOT;
    made.direction = made.kind == LIGHT_DIRECTIONAL ? place : vec3_scale(place, -1);
    if (fading) {
        made.constant = 0.2;
        made.linear = linear;
        made.quadratic = quadratic;
    }
    if (view == 5)
        made.exponent = exponent;
    return made;
}

static void scene(double seconds, int view, Scene *scene)
{
    Mat4 lying;
    mat4_rotate(-90, (Vec3){1, 0, 0}, &lying);
    const Mat4 below = mat4_translate((Vec3){0, -1, 0});
    const Mat4 large = mat4_scale((Vec3){4, 4, 4});
    state.light = light(seconds, view);
    state.objects[0] = (Object){.mesh = &state.sphere,
                                .solid = {.kind = SOLID_SPHERE, .radius = 1},
                                .closed = true,
                                .world_from_object = mat4_identity(),
                                .front = *material_find("red_plastic")};
    state.objects[1] =
        (Object){.mesh = &state.floor,
                 .solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object = mat4_product(below, mat4_product(lying, large)),
                 .front = {.ambient = {0.6, 0.6, 0.6}, .diffuse = {0.6, 0.6, 0.6}, .alpha = 1}};
    *scene =
        (Scene){.camera = {.eye = {0, 4, 10}, .up = {0, 1, 0}, .fovy = 42, .near = 1, .far = 100},
                .global_ambient = {0.2, 0.2, 0.2},
                .lights = &state.light,
                .light_count = 1,
                .objects = state.objects,
                .object_count = 2};
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    marks_add_lights(&annotations->points, scene);
}

static void layout(int *columns, int *rows)
{
    *columns = 3;
    *rows = 2;
}

static const char *label(int view)
{
    static const char *const labels[] = {"directional",   "point",        "spot",
                                         "point, fading", "spot, fading", "spot with an exponent"};
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
    .init = init,
    .finish = finish,
    .scene = scene,
    .annotate = annotate,
    .layout = layout,
    .label = label,
    .parameters = parameters,
};
