/*
 * ShininessRow: eight spheres that differ only in shininess, from 0 at the left, in steps of 16.
 *
 * The textbook's figure.
 *
 * Look at the first sphere: with exponent 0 the highlight covers the whole lit side. To the right
 * the highlights shrink, ever more slowly.
 */
#include "scene/scene_example.h"

enum { SPHERES = 8, STEP = 16 };

static Surface surface = {.name = MATERIAL_COUNT,
                          .material = {.ambient = {0.75, 0.75, 0},
                                       .diffuse = {0.75, 0.75, 0},
                                       .specular = {0.8, 0.8, 0.8},
                                       .alpha = 1}};
static LightColors light_colors = {.diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
static Vec3 global_ambient = {0.2, 0.2, 0.2};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

static const Parameter parameters[] = {
    SHADING_PARAMETERS(shading),
    COLOR_PARAMETERS(surface),
    LIGHT_PARAMETERS(light_colors, global_ambient),
    {.name = NULL},
};

static struct {
    Mesh sphere;
    Light light;
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
    /* From the upper left, in front. */
    state.light = (Light){.kind = LIGHT_DIRECTIONAL, .direction = {-1, 1, 1.5}};
    light_colors_apply(&light_colors, &state.light);
    for (int i = 0; i < SPHERES; i++) {
        const Vec3 place = {SPACING * (i - 0.5 * (SPHERES - 1)), 0, 0};
        state.objects[i] = (Object){.mesh = &state.sphere,
                                    .solid = {.kind = SOLID_SPHERE, .radius = 1},
                                    .closed = true,
                                    .world_from_object = mat4_translate(place),
                                    .front = surface.material};
        state.objects[i].front.shininess = STEP * i;
    }
    /* From far away, so that all eight look alike but for the highlight. */
    *scene = (Scene){
        .camera = {.eye = {0, 0, 100}, .up = {0, 1, 0}, .fovy = 1.35, .near = 50, .far = 150},
        .global_ambient = global_ambient,
        .lights = &state.light,
        .light_count = 1,
        .objects = state.objects,
        .object_count = SPHERES};
    scene_shading_apply(&shading, scene);
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
    .tries = {"--specular 0,1,0", "--interpolation constant", "--terms specular"},
    .looks = {"the highlight has a colour of its own: green on yellow",
              "one colour for each triangle: highlights show the mesh",
              "highlights alone, smaller from left to right"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene},
    .parameters = parameters,
};
