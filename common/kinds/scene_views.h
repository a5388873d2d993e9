/*
 * scene_views: an example with a scene that is open in a renderer: its views, and the scenes that
 * are drawn in them as the request wants them.
 */
#ifndef SCENE_VIEWS_H
#define SCENE_VIEWS_H

#include "app/options_table.h"
#include "app/panel_kind.h"
#include "app/renderer.h"
#include "choose/cheapest_quality.h"
#include "choose/error_worker.h"
#include "kinds/ineffective_options.h"
#include "lighting/lighting.h"
#include "scene/overlay.h"
#include "scene/scene.h"
#include "scene/scene_example.h"

#include <stdio.h>

/* The state of a renderer whose example is of SCENE_KIND. */
typedef struct SceneState {
    Lighting *lighting;
    int reported; /* programs, with --verbose */
    Overlay overlay;
    SolidMeshes meshes; /* of the choices */
    /* With --error, by view: what is drawn in pictures of this size, at this time or, in a window
     * or an animation, at any. NULL: not chosen yet. */
    CheapestQuality *choices;
    int choice_count, choice_width, choice_height;
    double choice_seconds;
    struct SceneExact *exact; /* by view: see scene_exact_pixel */
} SceneState;

SceneState *scene_state(const Renderer *renderer);

typedef struct SceneView {
    SceneCopy kept;     /* the lights and objects of --terms */
    Scene asked, scene; /* before and after --error, which may change the meshes */
    QualityParts made;  /* with --error: the scene as drawn, object by object */
} SceneView;

/* The grid of an example's views; returns how many they are. */
int scene_view_grid(const SceneExample *example, int *columns, int *rows);
int scene_view_count(const Renderer *renderer);

/* A view's part of the picture: x, y, width, height, in pixels from the upper left. False if it is
 * less than a pixel. */
bool scene_view_place(const Renderer *renderer, int view, int place[4]);

/* With --error makes the choice first, if that is not made yet: draws into the canvas. */
bool scene_view_open(SceneView *view, Renderer *renderer, const DrawRequest *request,
                     double seconds, int number, Message *message);
void scene_view_close(SceneView *view);

/* A view at a time. */
typedef struct ViewMoment {
    const Renderer *renderer;
    const DrawRequest *request;
    double seconds;
    int view;
} ViewMoment;

/* The scene of a view before --error. `kept` has the lights and objects of --terms, --light-at and
 * --light-color; closed by the caller, whatever is returned. */
bool scene_view_make(const ViewMoment *moment, SceneCopy *kept, Scene *scene, Message *message);

/* For error_worker_start: draws one frame without marks, labels and retouching, over the
 * background's color with alpha 0, and copies its scenes as they were before --error simplified
 * them. The canvas then holds that frame. */
bool scene_error_picture(Renderer *renderer, const DrawRequest *request, double seconds,
                         ErrorPicture *picture, Message *message);

/* --error: chooses the qualities of all views, unless that was done. */
bool scene_choose(Renderer *renderer, const DrawRequest *request, double seconds, Message *message);
void scene_forget_choices(SceneState *state);

/* For --explain: what was chosen for a view, as it was opened; nothing without --error. */
void scene_explain_choice(const Renderer *renderer, const DrawRequest *request,
                          const SceneView *view, int number, FILE *file);

/* Adds what decides the picture of a scene to a key; with `alpha`, of one that keeps it. */
void scene_key(CacheKey *key, const Scene *scene, bool alpha);

/* See ExampleKind.exact. What is made for a pixel is kept for the next of the same scene. */
bool scene_exact_pixel(Renderer *renderer, const DrawRequest *request, const int pixel[2],
                       ExactPixel *exact);
void scene_forget_exact(Renderer *renderer);

/* The options of programs that draw scenes. */

/* Ended by a NULL name. */
extern const Parameter SCENE_OPTIONS[];

/* By bit of SceneTerms. */
extern const char *const SCENE_TERM_NAMES[4];

/* Options of a program with scenes that name what is not there, or change nothing. */

/* Whether the scene has the terms that --terms names, and the lights that --terms, --light-at and
 * --light-color do; the message lists those it has. Runs init and finish of the example. */
bool scene_check_names(const Example *example, const DrawRequest *request, Message *message);

/* As in ExampleKind: also --shadows, where no shadow can fall on anything. */
void ineffective_scene_options(const Example *example, const Options *options,
                               const ParameterValue *defaults, char *text, size_t size);

/* The effects that the views of a scene need, and what their programs cost. */

/* Writes the effects at the request's time, by view and object, and lists them. */
void explain_effects(Renderer *renderer, const DrawRequest *request, FILE *file,
                     PanelObjects *objects);

/* --explain: the same on standard output, with each program's operations; without --verbose a
 * screenful, the first object in full and of the others what differs. Compiles the programs, so
 * that the loader prints them if it was asked to. */
bool explain_programs(Renderer *renderer, const DrawRequest *request, Message *message);

/* Of a plan of many objects prints how many have the same effects; returns, to be freed, which are
 * the first of theirs. */
enum { EXPLAIN_FEW = 24 };
bool *explain_groups(const LightingPlan *plan);
/* Of how many objects a light was left out, where each has lights of its own. */
void explain_reach(const LightingPlan *plan);
PanelObject *explain_list(const LightingPlan *plan, int object, const char *name,
                          const char *effects, PanelObjects *objects); /* one more */

/* What a window's panel shows of a program with scenes. */

extern const PanelKind SCENE_PANEL;

/* A scene as a file of glTF 2.0. */

/* Writes all of a scene into one file, whose buffer is a data URI. What glTF has no word for is in
 * `extras`, so that reading it gives the same scene; other readers see materials as diffuse colours
 * with a roughness, lights without ambient colours and attenuation. */
bool scene_save(const Scene *scene, const char *path, Message *message);

/* What a scene would show in reality that the lighting model leaves out. */

/* Writes a line for each thing that this scene lacks: "object 0, a sphere, would cast a shadow on
 * object 1, a square (light 0)". Shadows are found by rays from points spread over the surfaces to
 * each light. Fails only if memory is out. */
bool unmodelled_explain(const Scene *scene, FILE *file, Message *message);

/* What a plan says of an object (lighting_plan_explain), and below each effect the shaders' lines
 * that it brings in: those of the object's program that the program without this effect has not. Of
 * an effect of lights, they are listed once, and belong to all lights that have it. */
void receipt_write(const LightingPlan *plan, int object, const char *effects, FILE *file);

#endif
