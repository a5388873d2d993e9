/*
 * TermsApart: the lighting equation taken apart, term by term and light by light.
 *
 * Above, each term alone, with its part of the equation (examples/lighting/README.md): emission,
 * the ambient light of the scene and that of the lights, diffuse, specular. Below, all that is
 * ambient, each of two lights alone, the sum without its highlights, and the whole sum. A view
 * computes only what it shows: --costs says with how many operations per vertex and per fragment,
 * and in what time.
 *
 * Look at what each term adds, and at its price. Any program has --terms for the same.
 */
#include "base/clock.h"
#include "lighting/lighting.h"
#include "scene/scene_example.h"
#include "scene/shader_cost.h"
#include "scene/shape.h"

#include <stdio.h>

enum { VIEWS = 10, LIGHTS = 2, ROUNDS = 15 };

/* A light's ambient term is part of the light. */
static const struct {
    const char *name;
    SceneTerms terms;
    enum { ANY_AMBIENT, OF_SCENE, OF_LIGHTS } ambient;
} VIEW[VIEWS] = {
    {"emission, e", {.left_out = TERM_ALL & ~TERM_EMISSION}, ANY_AMBIENT},
    {"global ambient, g ka", {.left_out = TERM_ALL & ~TERM_AMBIENT}, OF_SCENE},
    {"lights' ambient, Σ a ka", {.left_out = TERM_ALL & ~TERM_AMBIENT}, OF_LIGHTS},
    {"diffuse, Σ (N·L) d kd", {.left_out = TERM_ALL & ~TERM_DIFFUSE}, ANY_AMBIENT},
    {"specular, Σ h^α p ks", {.left_out = TERM_ALL & ~TERM_SPECULAR}, ANY_AMBIENT},
    {"all ambient", {.left_out = TERM_ALL & ~TERM_AMBIENT}, ANY_AMBIENT},
    {"light 0", {.left_out = TERM_EMISSION, .lights_left_out = 2}, OF_LIGHTS},
    {"light 1", {.left_out = TERM_EMISSION, .lights_left_out = 1}, OF_LIGHTS},
    {"all but specular", {.left_out = TERM_SPECULAR}, ANY_AMBIENT},
    {"sum", {.left_out = 0}, ANY_AMBIENT},
};

enum { COSTS_OFF, COSTS_OPERATIONS, COSTS_TIME };
static const char *const COSTS[] = {"off", "operations", "time", NULL};

static int shape_kind = SHAPE_TEAPOT, costs = COSTS_OPERATIONS;
static ShapeModel model;
static Surface surface = {.name = MATERIAL_COUNT,
                          .material = {.ambient = {0.2, 0.5, 0.45},
                                       .diffuse = {0.2, 0.5, 0.45},
                                       .specular = {0.7, 0.7, 0.7},
                                       .emission = {0.22, 0.03, 0.03},
                                       .alpha = 1,
                                       .shininess = 40}};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};
static Vec3 global_ambient = {0.3, 0.3, 0.3}, light_ambient = {0.2, 0.2, 0.2};

static const Parameter parameters[] = {
    SHAPE_PARAMETERS(shape_kind, model),
    {"costs",
     "of each view: operations per vertex + per fragment; or their time too, which differs from run to run",
     PARAMETER_CHOICE, .value = &costs, .choices = COSTS},
    SURFACE_PARAMETERS(surface),
    SHADING_PARAMETERS(shading),
    COLOR_PARAMETER("light-ambient", "ambient colour of each light", light_ambient),
    COLOR_PARAMETER("global-ambient", "ambient light of the scene", global_ambient),
    {.name = NULL},
};

static struct {
    Shape shape;
    Light lights[LIGHTS];
    Object object;
    SceneCopy kept;
    char labels[VIEWS][128];
} state;

static void scene(double seconds, int view, Scene *scene)
{
    state.lights[0] = (Light){.kind = LIGHT_POINT,
                              .position = example_turn((Vec3){-3, 3, 2}, seconds),
                              .ambient = light_ambient,
                              .diffuse = {1, 0.9, 0.7},
                              .specular = {1, 0.9, 0.7}};
    state.lights[1] = (Light){.kind = LIGHT_POINT,
                              .position = example_turn((Vec3){3, 1, 3}, seconds),
                              .ambient = light_ambient,
                              .diffuse = {0.4, 0.5, 0.8},
                              .specular = {0.4, 0.5, 0.8}};
    state.object = shape_object(&state.shape, mat4_identity(), surface.material);
    *scene = (Scene){.camera = example_camera((Vec3){1, 2, 5}, 1.6),
                     .global_ambient = global_ambient,
                     .lights = state.lights,
                     .light_count = LIGHTS,
                     .objects = &state.object,
                     .object_count = 1};
    scene_shading_apply(&shading, scene);
    scene_copy_close(&state.kept);
    scene_copy_open(&state.kept, scene);
    scene_keep_terms(&state.kept, VIEW[view].terms);
    for (int i = 0; i < LIGHTS && VIEW[view].ambient == OF_SCENE; i++)
        state.kept.lights[i].ambient = (Vec3){0, 0, 0};
    if (VIEW[view].ambient == OF_LIGHTS)
        state.kept.scene.global_ambient = (Vec3){0, 0, 0};
    *scene = state.kept.scene;
}

static bool count_operations(Lighting *lighting, int operations[VIEWS][2], Message *message)
{
    bool done = true;
    for (int view = 0; view < VIEWS && done; view++) {
        Scene shown;
        ShaderSource sources[2] = {{0}};
        scene(0, view, &shown);
        done = lighting_sources(lighting, &shown, &shown.objects[0], false, sources, message);
        for (int stage = 0; stage < 2 && done; stage++) {
            ShaderCost cost;
            done = shader_cost(sources[stage].text, (ShaderStage)stage, &cost, message);
            operations[view][stage] = cost.arithmetic + cost.special;
        }
        shader_source_close(&sources[0]);
        shader_source_close(&sources[1]);
    }
    return done;
}

/* The medians of interleaved rounds, in milliseconds. */
static bool time_views(Lighting *lighting, double medians[VIEWS], Message *message)
{
    double times[VIEWS][ROUNDS];
    for (int round = -1; round < ROUNDS; round++) { /* the first compiles */
        for (int view = 0; view < VIEWS; view++) {
            Scene shown;
            scene(0, view, &shown);
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            const double start = clock_now();
            if (!lighting_show(lighting, &(LightingFrame){.scene = &shown, .aspect = 1}, message))
                return false;
            glFinish();
            if (round >= 0)
                times[view][round] = 1e3 * (clock_now() - start);
        }
    }
    for (int view = 0; view < VIEWS; view++)
        medians[view] = clock_median(times[view], ROUNDS);
    return true;
}

static bool make_labels(const ShaderLoader *loader, Message *message)
{
    if (loader->only_texts) { /* no shader is to be loaded */
        for (int view = 0; view < VIEWS; view++)
            snprintf(state.labels[view], sizeof state.labels[view], "%s: costs %s", VIEW[view].name,
                     COSTS[costs]);
        return true;
    }
    Lighting *lighting;
    ShaderLoader quiet = *loader;
    double medians[VIEWS];
    int operations[VIEWS][2];
    quiet.print = 0;
    quiet.log = NULL;
    const bool done = lighting_open(&lighting, &quiet, message) &&
                      (costs == COSTS_OFF || count_operations(lighting, operations, message)) &&
                      (costs != COSTS_TIME || time_views(lighting, medians, message));
    for (int view = 0; view < VIEWS && done; view++) {
        char counted[64] = "", timed[32] = "";
        const int *own = operations[view];
        if (costs != COSTS_OFF)
            snprintf(counted, sizeof counted,
                     view == VIEWS - 1 ? ": %d op per vertex + %d per fragment" : ": %d + %d op",
                     own[0], own[1]); /* the last explains the others' */
        if (costs == COSTS_TIME)
            snprintf(timed, sizeof timed, "%s%.2f ms", counted[0] ? ", " : ": ", medians[view]);
        snprintf(state.labels[view], sizeof state.labels[view], "%s%s%s", VIEW[view].name, counted,
                 timed);
    }
    lighting_close(lighting);
    return done;
}

static bool init(const ShaderLoader *loader, Message *message)
{
    return shape_open(&state.shape, (ShapeKind)shape_kind, SHAPE_LECTURE, &model, message) &&
           make_labels(loader, message);
}

static const char *label(int view)
{
    return state.labels[view];
}

/* The costs are those of all terms. */
static const char *plain_label(int view)
{
    return VIEW[view].name;
}

static void finish(void)
{
    scene_copy_close(&state.kept);
    shape_close(&state.shape);
}

const Example TermsApart = {
    .name = "TermsApart",
    .summary = "the terms of the lighting equation one by one, and what each costs",
    .width = 1250,
    .height = 500,
    .tries = {"--interpolation gouraud", "--shape sphere --costs time", "--shininess 0"},
    .looks = {"all operations move to the vertices", "milliseconds beside the operations",
              "shininess 0: the highlight covers all that is lit"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene,
                                     .columns = VIEWS / 2,
                                     .rows = 2,
                                     .label = label,
                                     .plain_label = plain_label},
    .parameters = parameters,
};
