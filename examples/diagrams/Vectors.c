/*
 * Vectors: the textbook's diagrams of reflection, drawn from the numbers.
 *
 * A surface, a light and an eye, with N, L, R, H and V, the highlight's lobe and the colour that
 * comes of it; and, with --figure, what a point sends into each direction, what a beam lights at an
 * angle, parallel and radiating rays, and the normals of a curve and of a polygon.
 *
 * Look at the lobe: shininess narrows it about R, and Blinn-Phong's is wider than Phong's.
 */
#include "diagrams/figures.h"
#include "scene/scene_example.h"

#include <math.h>

static int figure = FIGURE_VECTORS, reflection = REFLECTION_PHONG, material = 10, rays, sides = 4;
static double light = 40, eye = 20, shininess = 10, swing;

static const char *const RAYS[] = {"parallel", "radiating", NULL};

static const Parameter parameters[] = {
    {"figure", "what is drawn", PARAMETER_CHOICE, .value = &figure, .choices = FIGURE_NAMES},
    {"light", "the light's angle from the normal, to the left", PARAMETER_NUMBER, .value = &light,
     .min = -180, .max = 180},
    {"eye", "the eye's angle from the normal, to the right", PARAMETER_NUMBER, .value = &eye,
     .min = -90, .max = 90},
    SHININESS_PARAMETER(shininess),
    {"reflection", "the highlight's formula", PARAMETER_CHOICE, .value = &reflection,
     .choices = REFLECTION_NAMES},
    {"material", "what the surface is made of, but for its shininess", PARAMETER_CHOICE,
     .value = &material, .choices = MATERIAL_NAMES},
    {"rays", "in the figure vectors: light and eye are far away, or near", PARAMETER_CHOICE,
     .value = &rays, .choices = RAYS},
    {"sides", "of the polygon in the figure normals", PARAMETER_WHOLE, .value = &sides, .min = 1,
     .max = FIGURE_SIDES_MAX},
    {"swing", "how far the light swings to both sides as time passes, in degrees", PARAMETER_NUMBER,
     .value = &swing, .min = 0, .max = 180},
    {.name = NULL},
};

/* One swing takes as long as an animation's turn. */
static double light_angle(double seconds)
{
    const double phase = fmod(DEGREES_PER_SECOND * seconds, 360);
    return light + swing * mat4_rotate(phase, (Vec3){0, 0, 1}).m[1];
}

static bool compose(double seconds, Drawing *drawing, Message *message)
{
    const Optics optics = {.light = light_angle(seconds),
                           .eye = eye,
                           .shininess = shininess,
                           .reflection = (Reflection)reflection,
                           .material = &MATERIALS[material].material,
                           .radiating = rays == 1};
    (void)message;
    figure_draw((Figure)figure, &optics, sides, drawing);
    return true;
}

const Example Vectors = {
    .name = "Vectors",
    .summary = "the vectors of reflection, lobes, beams and normals, as diagrams (SVG, PDF too)",
    .width = 800,
    .height = 450,
    .tries = {"--shininess 0", "--figure incidence --light 80", "--figure lobe -o lobe.svg"},
    .looks = {"the lobe is a half disc: a highlight for every eye",
              "a flat beam lights a wider place, so each part gets less",
              "diffuse: the same everywhere; specular: about R"},
    .kind = &DIAGRAM_KIND,
    .content = &(const DiagramExample){.compose = compose},
    .parameters = parameters,
};
