/*
 * PhongBlinn: the difference between Phong's and Blinn-Phong's highlights.
 *
 * Phong on the left; in the middle Blinn-Phong, its shininess fitted for the closest match where
 * light and viewer are opposite; on the right their difference, --gain times as bright.
 *
 * Look at --fit off: with equal shininess, Blinn-Phong's highlight is about twice as wide.
 */
#include "scene/scene_example.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double shininess = 16, gain = 4;
static bool fit = true;

static Surface surface = {.material = {.ambient = {0.2, 0.2, 0.4},
                                       .diffuse = {0.2, 0.2, 0.4},
                                       .specular = {0.6, 0.6, 0.6},
                                       .alpha = 1}};
static LightColors light_colors = {{0.1, 0.1, 0.1}, {1, 1, 1}, {1, 1, 1}};
static Vec3 global_ambient = {0, 0, 0};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

/* Above a quarter of 128 the fitted shininess would be above 128. */
static const Parameter parameters[] = {
    {"shininess", "of Phong's highlight; above 30 the fitted one would be above 128",
     PARAMETER_NUMBER, .value = &shininess, .min = 1, .max = 30},
    {"fit", "fit Blinn-Phong's shininess to it", PARAMETER_SWITCH, .value = &fit},
    {"gain", "of the difference", PARAMETER_NUMBER, .value = &gain, .min = 1, .max = 255},
    COLOR_PARAMETERS(surface),
    INTERPOLATION_PARAMETERS(shading),
    LIGHT_PARAMETERS(light_colors, global_ambient),
    {.name = NULL},
};

static struct {
    Mesh sphere;
    Light light;
    Object object;
    double fitted;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    state.fitted = fit ? material_fitted_shininess(shininess) : shininess;
    return mesh_sphere(&state.sphere, 1, 64, 32, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    (void)seconds;
    state.object = (Object){.mesh = &state.sphere,
                            .solid = {.kind = SOLID_SPHERE, .radius = 1},
                            .closed = true,
                            .world_from_object = mat4_identity(),
                            .front = surface.material};
    state.object.front.shininess = view == 1 ? state.fitted : shininess;
    state.light = (Light){.kind = LIGHT_POINT, .position = {3, 4, 5}};
    light_colors_apply(&light_colors, &state.light);
    *scene =
        (Scene){.camera = {.eye = {0, 0, 5}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 100},
                .global_ambient = global_ambient,
                .lights = &state.light,
                .light_count = 1,
                .objects = &state.object,
                .object_count = view < 2};
    scene_shading_apply(&shading, scene);
    scene->reflection = view == 1 ? REFLECTION_BLINN_PHONG : REFLECTION_PHONG;
}

static const char *label(int view)
{
    static char text[64];
    if (view == 2 && gain == 1)
        return "difference";
    if (view == 2)
        snprintf(text, sizeof text, "%.4g x the difference", gain);
    else
        snprintf(text, sizeof text, "%s, shininess %.4g", view == 0 ? "Phong" : "Blinn-Phong",
                 view == 0 ? shininess : state.fitted);
    return text;
}

/* Fills the third view with the difference of the first two. */
static void retouch(Image *image)
{
    const int third = image->width / 3;
    unsigned char *pixels = image->pixels;
    for (int y = 0; y < image->height; y++) {
        unsigned char *row = pixels + 4 * (size_t)y * (size_t)image->width;
        for (int x = 0; x < third; x++)
            for (int c = 0; c < 3; c++) {
                const int apart = abs(row[4 * x + c] - row[4 * (third + x) + c]);
                row[4 * (2 * third + x) + c] = (unsigned char)fmin(gain * apart, 255);
            }
    }
}

static void finish(void)
{
    mesh_close(&state.sphere);
}

const Example PhongBlinn = {
    .name = "PhongBlinn",
    .summary = "Phong and Blinn-Phong with fitted shininess, and their difference",
    .width = 900,
    .height = 300,
    .tries = {"--fit off --gain 1", "--shininess 1 --gain 8", "--viewer infinite --gain 16"},
    .looks = {"with equal exponents Blinn-Phong's highlight is larger",
              "the largest highlights differ most",
              "what differs although it is fitted, 16 times as bright"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content =
        &(const SceneExample){
            .make = scene, .columns = 3, .rows = 1, .label = label, .retouch = retouch},
    .parameters = parameters,
};
