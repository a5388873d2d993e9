/*
 * ColoredLights: coloured light on coloured surfaces.
 *
 * Each row has the same white, red, green, blue and yellow sphere under another light: white, red,
 * green, blue, and red and green together. --light sets the last.
 *
 * Look at the black spheres: a surface that reflects no red is black in red light. Red and green
 * light together look like yellow light, on every surface. The highlights have the light's colour.
 */
#include "scene/scene_example.h"

#include <stdio.h>

enum { SPHERES = 5, VIEWS = 5 };

static Vec3 mixed = {1, 1, 0};
static double highlight = 0.3;
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

static const Parameter parameters[] = {
    COLOR_PARAMETER("light", "colour of the light of the last row", mixed),
    {"specular", "white reflectivity for the highlight", PARAMETER_NUMBER, .value = &highlight,
     .min = 0, .max = 1},
    SHADING_PARAMETERS(shading),
    {.name = NULL},
};

static const Vec3 SURFACES[SPHERES] = {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};

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
    static const double SPACING = 2.3;
    const Vec3 colors[VIEWS] = {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, mixed};
    (void)seconds;
    state.light = (Light){.kind = LIGHT_DIRECTIONAL,
                          .direction = {-1, 1, 1.5},
                          .ambient = vec3_scale(colors[view], 0.1),
                          .diffuse = vec3_scale(colors[view], 0.9),
                          .specular = colors[view]};
    for (int i = 0; i < SPHERES; i++) {
        const Vec3 place = {SPACING * (i - 0.5 * (SPHERES - 1)), 0, 0};
        state.objects[i] = (Object){.mesh = &state.sphere,
                                    .solid = {.kind = SOLID_SPHERE, .radius = 1},
                                    .closed = true,
                                    .world_from_object = mat4_translate(place),
                                    .front = {.ambient = SURFACES[i],
                                              .diffuse = SURFACES[i],
                                              .specular = {highlight, highlight, highlight},
                                              .alpha = 1,
                                              .shininess = 40}};
    }
    *scene = (Scene){.camera = {.eye = {0, -0.35, 100}, /* the label is below */
                                .center = {0, -0.35, 0},
                                .up = {0, 1, 0},
                                .fovy = 1.62,
                                .near = 50,
                                .far = 150},
                     .background = {0.2, 0.2, 0.2},
                     .lights = &state.light,
                     .light_count = 1,
                     .objects = state.objects,
                     .object_count = SPHERES};
    scene_shading_apply(&shading, scene);
}

static const char *label(int view)
{
    static const char *const labels[VIEWS] = {"white light", "red light", "green light",
                                              "blue light", "red and green light"};
    static char text[64];
    const bool usual = mixed.x == 1 && mixed.y == 1 && mixed.z == 0;
    snprintf(text, sizeof text, "light %.3g, %.3g, %.3g", mixed.x, mixed.y, mixed.z);
    return view < VIEWS - 1 || usual ? labels[view] : text;
}

static void finish(void)
{
    mesh_close(&state.sphere);
}

const Example ColoredLights = {
    .name = "ColoredLights",
    .summary = "coloured light on coloured surfaces",
    .width = 500,
    .height = 600,
    .tries = {"--light 0,1,1", "--specular 0", "--terms specular"},
    .looks = {"cyan light below: what reflects only red is black",
              "without highlights, red in green light is black",
              "highlights have the light's colour on every surface"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .columns = 1, .rows = VIEWS, .label = label},
    .parameters = parameters,
};
