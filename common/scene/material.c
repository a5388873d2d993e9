/* Materials by name, as the textbooks list them. */
#include "scene/material.h"

#include <math.h>
#include <string.h>

/* Ambient, diffuse and specular reflectivity of each, and shininess as a fraction of 128. */
#define MATERIAL_LIST(X)                                                                           \
    X(emerald, 0.0215, 0.1745, 0.0215, 0.07568, 0.61424, 0.07568, 0.633, 0.727811, 0.633, 0.6)     \
    X(jade, 0.135, 0.2225, 0.1575, 0.54, 0.89, 0.63, 0.316228, 0.316228, 0.316228, 0.1)            \
    X(obsidian, 0.05375, 0.05, 0.06625, 0.18275, 0.17, 0.22525, 0.332741, 0.328634, 0.346435, 0.3) \
    X(pearl, 0.25, 0.20725, 0.20725, 1, 0.829, 0.829, 0.296648, 0.296648, 0.296648, 0.088)         \
    X(ruby, 0.1745, 0.01175, 0.01175, 0.61424, 0.04136, 0.04136, 0.727811, 0.626959, 0.626959,     \
      0.6)                                                                                         \
    X(turquoise, 0.1, 0.18725, 0.1745, 0.396, 0.74151, 0.69102, 0.297254, 0.30829, 0.306678, 0.1)  \
    X(brass, 0.329412, 0.223529, 0.027451, 0.780392, 0.568627, 0.113725, 0.992157, 0.941176,       \
      0.807843, 0.21794872)                                                                        \
    X(bronze, 0.2125, 0.1275, 0.054, 0.714, 0.4284, 0.18144, 0.393548, 0.271906, 0.166721, 0.2)    \
    X(chrome, 0.25, 0.25, 0.25, 0.4, 0.4, 0.4, 0.774597, 0.774597, 0.774597, 0.6)                  \
    X(copper, 0.19125, 0.0735, 0.0225, 0.7038, 0.27048, 0.0828, 0.256777, 0.137622, 0.086014, 0.1) \
    X(gold, MATERIAL_GOLD_NUMBERS)                                                                 \
    X(silver, 0.19225, 0.19225, 0.19225, 0.50754, 0.50754, 0.50754, 0.508273, 0.508273, 0.508273,  \
      0.4)                                                                                         \
    X(black_plastic, 0, 0, 0, 0.01, 0.01, 0.01, 0.5, 0.5, 0.5, 0.25)                               \
    X(cyan_plastic, 0, 0.1, 0.06, 0, 0.50980392, 0.50980392, 0.50196078, 0.50196078, 0.50196078,   \
      0.25)                                                                                        \
    X(green_plastic, 0, 0, 0, 0.1, 0.35, 0.1, 0.45, 0.55, 0.45, 0.25)                              \
    X(red_plastic, 0, 0, 0, 0.5, 0, 0, 0.7, 0.6, 0.6, 0.25)                                        \
    X(white_plastic, 0, 0, 0, 0.55, 0.55, 0.55, 0.7, 0.7, 0.7, 0.25)                               \
    X(yellow_plastic, 0, 0, 0, 0.5, 0.5, 0, 0.6, 0.6, 0.5, 0.25)                                   \
    X(black_rubber, 0.02, 0.02, 0.02, 0.01, 0.01, 0.01, 0.4, 0.4, 0.4, 0.078125)                   \
    X(cyan_rubber, 0, 0.05, 0.05, 0.4, 0.5, 0.5, 0.04, 0.7, 0.7, 0.078125)                         \
    X(green_rubber, 0, 0.05, 0, 0.4, 0.5, 0.4, 0.04, 0.7, 0.04, 0.078125)                          \
    X(red_rubber, 0.05, 0, 0, 0.5, 0.4, 0.4, 0.7, 0.04, 0.04, 0.078125)                            \
    X(white_rubber, 0.05, 0.05, 0.05, 0.5, 0.5, 0.5, 0.7, 0.7, 0.7, 0.078125)                      \
    X(yellow_rubber, 0.05, 0.05, 0, 0.5, 0.5, 0.4, 0.7, 0.7, 0.04, 0.078125)

#define NAMED(name, ...) {#name, MATERIAL_OF(__VA_ARGS__)},
#define NAME(name, ...) #name,

const NamedMaterial MATERIALS[MATERIAL_COUNT] = {MATERIAL_LIST(NAMED)};
const char *const MATERIAL_NAMES[MATERIAL_COUNT + 2] = {MATERIAL_LIST(NAME) "none", NULL};

const Material *material_find(const char *name)
{
    for (int i = 0; i < MATERIAL_COUNT; i++)
        if (strcmp(MATERIALS[i].name, name) == 0)
            return &MATERIALS[i].material;
    return NULL;
}

/* The squared difference of the two highlights over the angle t of the normal from the half vector:
 * V.R = cos 2t, N.H = cos t. */
static double highlights_apart(double phong, double blinn_phong)
{
    enum { STEPS = 1000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = acos(0) * (i + 0.5) / STEPS;
        const double apart = pow(fmax(cos(2 * t), 0), phong) - pow(cos(t), blinn_phong);
        sum += apart * apart;
    }
    return sum / STEPS;
}

/* By golden section; there is one minimum. */
double material_fitted_shininess(double phong)
{
    const double ratio = (sqrt(5) - 1) / 2;
    double low = phong, high = 8 * phong;
    while (high - low > 1e-6 * high) {
        const double a = high - ratio * (high - low), b = low + ratio * (high - low);
        if (highlights_apart(phong, a) < highlights_apart(phong, b))
            high = b;
        else
            low = a;
    }
    return (low + high) / 2;
}
