/*
 * draw_request: what to draw, as what draws is told: the command line's answer, resolved.
 *
 * options_request (options.h) makes it; programs and tests without a command line write it as it
 * is. Zeroed, it asks for one picture as the program has it, its scenes without shadows.
 */
#ifndef DRAW_REQUEST_H
#define DRAW_REQUEST_H

#include "core/orbit.h"
#include "core/shader.h"
#include "scene/scene.h"

typedef struct DrawRequest {
    ShaderLoader shaders;
    bool verbose; /* what runs where, and how long it takes, goes to standard error */
    bool alpha;   /* the background is transparent */
    Orbit orbit;
    /* All moments that will be asked for: of a window, which goes on, any. */
    double seconds, fps;
    int frames;
    bool endless;

    /* Of scenes. */
    bool full;         /* the program that has every effect */
    bool clamp_vertex; /* see scene.h */
    bool signed_dots;
    bool linear;
    bool show_clipped;
    bool normals; /* as lines over the picture */
    SceneTerms terms;
    ShadowSettings shadows;
    LightPlaces places;
    LightTints tints;
    bool cheap;     /* as cheaply as an error of `error` steps of 1/255 allows */
    double error;   /* in steps of 1/255 */
    unsigned fixed; /* with `cheap`, the axes of quality that stay: bits of 1 << QualityAxis */
} DrawRequest;

#endif
