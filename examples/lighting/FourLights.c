/*
 * FourLights: a dim light at the viewer, and three coloured ones that circle a disc with a teapot.
 *
 * A small sphere marks each coloured light: it emits the light's colour, and is dark when the light
 * is off.
 *
 * Look at: how colours add where lights overlap; the disc, which has no highlight, beside the
 * teapot, which has one for each light.
 */
#include "example.h"
#include "shape.h"

enum { COLORED = 3 };

static bool viewpoint_on = true, red_on = true, green_on = true, blue_on = true, ambient_on = true;

static const Parameter parameters[] = {
    {.name = "viewpoint",
     .help = "the dim grey light at the viewer",
     .kind = PARAMETER_SWITCH,
     .value = &viewpoint_on},
    {.name = "red", .help = "the red light", .kind = PARAMETER_SWITCH, .value = &red_on},
    {.name = "green", .help = "the green light", .kind = PARAMETER_SWITCH, .value = &green_on},
    {.name = "blue", .help = "the blue light", .kind = PARAMETER_SWITCH, .value = &blue_on},
    {.name = "ambient",
     .help = "global ambient light",
     .kind = PARAMETER_SWITCH,
     .value = &ambient_on},
    {.name = NULL},
};

static const Vec3 EYE = {0, 4, 7};

static struct {
    Mesh disc, marker;
    Shape teapot;
    Light lights[1 + COLORED];
    Object objects[2 + COLORED];
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return mesh_disc(&state.disc, 3, 64, 16, message) &&
           mesh_sphere(&state.marker, 0.12, 16, 8, message) &&
           shape_open(&state.teapot, SHAPE_TEAPOT, NULL, message);
}

static void colored_light(double seconds, int i)
{
    static const Vec3 colors[COLORED] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const bool on[COLORED] = {red_on, green_on, blue_on};
    /* A third of a turn, at 30 degrees a second, between them. */
    const Vec3 place = example_turn((Vec3){2.5, 1.2, 0}, seconds + 4 * i);
    state.lights[1 + i] = (Light){.kind = LIGHT_POINT,
                                  .off = !on[i],
                                  .position = place,
                                  .ambient = vec3_scale(colors[i], 0.1),
                                  .diffuse = vec3_scale(colors[i], 0.5),
                                  .specular = vec3_scale(colors[i], 0.5)};
    state.objects[2 + i] = (Object){.mesh = &state.marker,
                                    .solid = {.kind = SOLID_SPHERE, .radius = 0.12},
                                    .closed = true,
                                    .world_from_object = mat4_translate(place),
                                    .front = {.emission = on[i] ? colors[i] : (Vec3){0, 0, 0},
                                              .alpha = 1,
                                              .ambient = {0.2, 0.2, 0.2},
                                              .diffuse = {0.2, 0.2, 0.2}}};
}

static void scene(double seconds, int view, Scene *scene)
{
    Mat4 lying;
    (void)view;
    mat4_rotate(-90, (Vec3){1, 0, 0}, &lying);
    state.lights[0] = (Light){.kind = LIGHT_POINT,
                              .off = !viewpoint_on,
                              .position = EYE,
                              .diffuse = {0.5, 0.5, 0.5},
                              .specular = {0.5, 0.5, 0.5}};
    state.objects[0] =
        (Object){.mesh = &state.disc,
                 .solid = {.kind = SOLID_DISC, .radius = 3},
                 .flat = true,
                 .world_from_object = lying,
                 .front = {.ambient = {0.8, 0.8, 0.8}, .diffuse = {0.8, 0.8, 0.8}, .alpha = 1}};
    state.objects[1] = shape_object(&state.teapot, mat4_translate((Vec3){0, 0.75, 0}),
                                    (Material){.ambient = {0.7, 0.7, 0.7},
                                               .diffuse = {0.7, 0.7, 0.7},
                                               .specular = {0.2, 0.2, 0.2},
                                               .alpha = 1,
                                               .shininess = 32});
    for (int i = 0; i < COLORED; i++)
        colored_light(seconds, i);
    *scene = (Scene){
        .camera =
            {.eye = EYE, .center = {0, 0.3, 0}, .up = {0, 1, 0}, .fovy = 40, .near = 1, .far = 100},
        .lights = state.lights,
        .light_count = 1 + COLORED,
        .objects = state.objects,
        .object_count = 2 + COLORED};
    if (ambient_on)
        scene->global_ambient = (Vec3){0.15, 0.15, 0.15};
}

static void finish(void)
{
    mesh_close(&state.disc);
    mesh_close(&state.marker);
    shape_close(&state.teapot);
}

const Example FourLights = {
    .name = "FourLights",
    .summary = "four lights on and off, and spheres that emit",
    .init = init,
    .finish = finish,
    .scene = scene,
    .parameters = parameters,
};
