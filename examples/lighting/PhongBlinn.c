/*
 * PhongBlinn: how far Phong's and Blinn-Phong's highlights lie apart.
 *
 * On the left Phong's, in the middle Blinn-Phong's with its shininess fitted so that the two
 * highlights are as alike as they can be where light and viewer are opposite each other; on the
 * right their difference, made --gain times as bright.
 *
 * Look at: --fit off: with equal shininess Blinn-Phong's highlight is about twice as wide.
 */
#include "example.h"

#include <math.h>
#include <stdlib.h>

static double shininess = 16, gain = 4;
static bool fit = true;

/* Above a quarter of 128 the fitted shininess would be above 128. */
static const Parameter parameters[] = {
    {.name = "shininess",
     .help = "of Phong's highlight",
     .kind = PARAMETER_NUMBER,
     .value = &shininess,
     .least = 1,
     .most = 30},
    {.name = "fit",
     .help = "fit Blinn-Phong's shininess to it",
     .kind = PARAMETER_SWITCH,
     .value = &fit},
    {.name = "gain",
     .help = "of the difference",
     .kind = PARAMETER_NUMBER,
     .value = &gain,
     .least = 1,
     .most = 255},
    {.name = NULL},
};

static const Light LIGHT = {.kind = LIGHT_POINT,
                            .position = {3, 4, 5},
                            .ambient = {0.1, 0.1, 0.1},
                            .diffuse = {1, 1, 1},
                            .specular = {1, 1, 1}};

static struct {
    Mesh sphere;
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
                            .front = {.ambient = {0.2, 0.2, 0.4},
                                      .diffuse = {0.2, 0.2, 0.4},
                                      .specular = {0.6, 0.6, 0.6},
                                      .alpha = 1,
                                      .shininess = view == 1 ? state.fitted : shininess}};
    *scene =
        (Scene){.camera = {.eye = {0, 0, 5}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 100},
                .lights = &LIGHT,
                .light_count = 1,
                .objects = &state.object,
                .object_count = view < 2,
                .reflection = view == 1 ? REFLECTION_BLINN_PHONG : REFLECTION_PHONG};
}

static void layout(int *columns, int *rows)
{
    *columns = 3;
    *rows = 1;
}

static const char *label(int view)
{
    static const char *const labels[] = {"Phong", "Blinn-Phong", "difference"};
    return labels[view];
}

/* Fills the third view with the difference of the first two. */
static void retouch(Image *image)
{
    const int third = image->width / 3;
    unsigned char *pixels = image->pixels;
    for (int y = 0; y < image->height; y++) {
        unsigned char *row = pixels + 4 * (size_t)y * (size_t)image->width;
        for (int x = 0; x < third; x++) {
            for (int c = 0; c < 3; c++) {
                const int apart = abs(row[4 * x + c] - row[4 * (third + x) + c]);
                row[4 * (2 * third + x) + c] = (unsigned char)fmin(gain * apart, 255);
            }
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
    .init = init,
    .finish = finish,
    .scene = scene,
    .layout = layout,
    .label = label,
    .retouch = retouch,
    .parameters = parameters,
};
