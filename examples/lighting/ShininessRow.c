/*
 * ShininessRow: eight spheres that differ only in shininess, from 0 at the left, in steps of 16.
 *
 * Look at: the first sphere: with an exponent of 0 the highlight covers all of the lit side. To the
 * right highlights become smaller and sharper, ever more slowly.
 */
#include "example.h"

enum { SPHERES = 8, STEP = 16 };

static int reflection = REFLECTION_PHONG;

static const Parameter parameters[] = {
    {.name = "reflection",
     .help = "the model of the highlight",
     .kind = PARAMETER_CHOICE,
     .value = &reflection,
     .choices = REFLECTION_NAMES},
    {.name = NULL},
};

/* From the upper left, in front. */
static const Light LIGHT = {.kind = LIGHT_DIRECTIONAL,
                            .direction = {-1, 1, 1.5},
                            .diffuse = {1, 1, 1},
                            .specular = {1, 1, 1}};

static struct {
    Mesh sphere;
    Object objects[SPHERES];
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return mesh_sphere(&state.sphere, 1, 64, 32, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    static const double SPACING = 2.2;
    (void)seconds, (void)view;
    for (int i = 0; i < SPHERES; i++) {
        const Vec3 place = {SPACING * (i - 0.5 * (SPHERES - 1)), 0, 0};
        state.objects[i] = (Object){.mesh = &state.sphere,
                                    .solid = {.kind = SOLID_SPHERE, .radius = 1},
                                    .closed = true,
                                    .world_from_object = mat4_translate(place),
                                    .front = {.diffuse = {0.8, 0.8, 0},
                                              .specular = {0.8, 0.8, 0.8},
                                              .alpha = 1,
                                              .shininess = STEP * i}};
    }
    /* From afar, so that all eight are seen from the same side. */
    *scene = (Scene){
        .camera = {.eye = {0, 0, 100}, .up = {0, 1, 0}, .fovy = 1.35, .near = 50, .far = 150},
        .lights = &LIGHT,
        .light_count = 1,
        .objects = state.objects,
        .object_count = SPHERES,
        .reflection = (Reflection)reflection};
}

static void finish(void)
{
    mesh_close(&state.sphere);
}

const Example ShininessRow = {
    .name = "ShininessRow",
    .summary = "eight spheres of shininess 0, 16, ... 112",
    .width = 800,
    .height = 100,
    .init = init,
    .finish = finish,
    .scene = scene,
    .parameters = parameters,
};
