/*
 * Vectors: the textbook's diagrams of reflection, drawn from the numbers.
 *
 * A surface, a light and an eye, with N, L, R, H and V, the highlight's lobe and the colour that
 * comes of it; and, with --figure, what a point sends into each direction, what a beam lights at an
 * angle, parallel and radiating rays, the normals of a curve and of a polygon, a mirror, the two
 * sides of a polygon, world and eye coordinates, ambient light, attenuation, and what becomes of
 * the light that arrives.
 *
 * Look at the lobe: shininess narrows it about R, and Blinn-Phong's is wider than Phong's.
 */
#include "diagrams/figures.h"
#include "scene/scene_example.h"

#include <math.h>

static int figure = FIGURE_VECTORS, material = MATERIAL_COUNT, reflection = REFLECTION_PHONG;
static int rays;
static Optics optics = {.light = 40,
                        .eye = 10,
                        .shininess = 10,
                        .distance = 0.75,
                        .constant = 0.2, /* as LightTypes */
                        .linear = 0.2,
                        .quadratic = 0.2,
                        .sides = 4};
static double swing, ambient = 1;

/* The material "none": one that reflects no more than arrives. */
static const Material GREY_PLASTIC = {.ambient = {0.5, 0.5, 0.5},
                                      .diffuse = {0.5, 0.5, 0.5},
                                      .specular = {0.3, 0.3, 0.3},
                                      .alpha = 1};

static const char *const RAYS[] = {"parallel", "radiating", NULL};

static const Parameter parameters[] = {
    {"figure", "what is drawn", PARAMETER_CHOICE, .value = &figure, .choices = FIGURE_NAMES},
    {"light", "the light's angle from the normal, to the left", PARAMETER_NUMBER,
     .value = &optics.light, .min = -180, .max = 180},
    {"eye", "the eye's angle from the normal, to the right", PARAMETER_NUMBER, .value = &optics.eye,
     .min = -90, .max = 90},
    SHININESS_PARAMETER(optics.shininess),
    {"reflection", "the highlight's formula", PARAMETER_CHOICE, .value = &reflection,
     .choices = REFLECTION_NAMES},
    {"material", "what the surface is made of (grey if none), but for its shininess",
     PARAMETER_CHOICE, .value = &material, .choices = MATERIAL_NAMES},
    {"rays", "in the figure vectors: light and eye are far away, or near", PARAMETER_CHOICE,
     .value = &rays, .choices = RAYS},
    {"sides", "of the polygon in the figures normals and, from 3 on, winding", PARAMETER_WHOLE,
     .value = &optics.sides, .min = 1, .max = OPTICS_SIDES_MAX},
    {"ambient", "intensity of the light in the figure ambient; elsewhere 0.2", PARAMETER_NUMBER,
     .value = &ambient, .min = 0, .max = 1},
    {"distance", "of the lamp; in the figure rays in widths of what it lights", PARAMETER_NUMBER,
     .value = &optics.distance, .min = 0.25, .max = 1e6},
    {"constant", "its attenuation, 1 / (constant + linear d + quadratic d^2)", PARAMETER_NUMBER,
     .value = &optics.constant, .min = 0, .max = 10},
    {"linear", "attenuation by the distance", PARAMETER_NUMBER, .value = &optics.linear, .min = 0,
     .max = 10},
    {"quadratic", "attenuation by its square", PARAMETER_NUMBER, .value = &optics.quadratic,
     .min = 0, .max = 10},
    {"swing", "how far the light swings to both sides as time passes, in degrees", PARAMETER_NUMBER,
     .value = &swing, .min = 0, .max = 180},
    {.name = NULL},
};

static bool compose(double seconds, Drawing *drawing, Message *message)
{
    Optics shown = optics;
    (void)message;
    /* One swing takes as long as an animation's turn. */
    const double phase = fmod(DEGREES_PER_SECOND * seconds, 360);
    shown.light = optics.light + swing * mat4_rotate(phase, (Vec3){0, 0, 1}).m[1];
    shown.ambient = figure == FIGURE_AMBIENT ? ambient : 0.2;
    shown.reflection = (Reflection)reflection;
    shown.material = material < MATERIAL_COUNT ? &MATERIALS[material].material : &GREY_PLASTIC;
    shown.radiating = rays == 1;
    figure_draw((Figure)figure, &shown, drawing);
    return true;
}

const Example Vectors = {
    .name = "Vectors",
    .summary = "vectors of reflection, lobes, beams, normals and more, as diagrams (SVG, PDF too)",
    .width = 800,
    .height = 450,
    .tries = {"--shininess 0", "--figure incidence --light 80", "--figure lobe -o lobe.svg"},
    .looks = {"the lobe is a half disc: a highlight for every eye",
              "a grazing beam lights a wider place, so each part gets less",
              "diffuse: the same everywhere; specular: about R"},
    .kind = &DIAGRAM_KIND,
    .content = &(const DiagramExample){.compose = compose},
    .parameters = parameters,
};
