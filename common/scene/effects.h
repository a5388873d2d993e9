/*
 * effects: which lighting effects an object in a scene needs, and why. No GL.
 *
 * effects_of is a pure function from a scene to a set. `lighting` generates the program from that
 * set alone: what is not in it costs no uniform, no varying and no instruction. Values such as
 * colors are not part of the set.
 */
#ifndef EFFECTS_H
#define EFFECTS_H

#include "scene/scene.h"
#include "shadows/between.h"

#include <stdio.h>

enum { EFFECTS_MAX_LIGHTS = 32 };

/* The terms of one light. Lights with equal terms share a loop. */
typedef struct LightTerms {
    LightKind kind;
    bool ambient; /* varies over the surface; constant ambient light is part of the base */
    bool diffuse;
    bool specular;
    bool attenuation; /* depends on the distance */
    bool exponent;    /* a spot's falloff within its cone */
    bool half_vector; /* constant over the surface: a uniform */
    bool at_vertex;   /* computed per vertex: interpolation is exact, or requested */
    bool any;         /* full program: any kind, selected by coefficients */
    /* Another surface may come between: 1 plus the number of the mask that knows where; or 0. */
    int shadow;
} LightTerms;

/* Lights with equal terms, as indices into the scene's lights. */
typedef struct LightGroup {
    LightTerms terms;
    /* An attenuation's denominator may be 0, or too large for a float. Every other division and
     * root is always guarded; this guard is conditional because it costs up to 2% of a frame with
     * many lights. */
    bool guard_attenuation;
    int lights[EFFECTS_MAX_LIGHTS];
    int count;
} LightGroup;

typedef struct Effects {
    bool alpha;         /* the surface is not opaque */
    bool vertex_color;  /* the mesh has colors, and a term depends on them */
    bool lit_positions; /* light is computed elsewhere than at the vertex */
    bool base;          /* emission or constant ambient light */
    LightGroup groups[EFFECTS_MAX_LIGHTS];
    int group_count;
    Reflection reflection; /* if any group is specular */
    bool normals;          /* any light has a diffuse or specular term */
    bool local_viewer;     /* V varies over the surface, and a term depends on it */
    bool two_sided;
    bool normal_matrix;      /* a separate matrix, not the model-view matrix */
    bool normalize_vertex;   /* a transformed normal is not of length 1 */
    bool normalize_fragment; /* an interpolated normal is not of length 1 */
    bool clamp_vertex;
    bool linear;
    bool show_clipped;
    bool limit; /* colors may be so large that a driver draws them as black */
    bool cull;  /* back faces are never visible */
} Effects;

/* A side's material; with vertex colors, its ambient and diffuse reflectivity are those, and white
 * here. */
Material effects_material(const Object *object, bool back);

/* The effects that an object in a scene needs. The scene has passed scene_check. */
Effects effects_of(const Scene *scene, const Object *object);

/* The same for a mesh whose bounds are known, and the lights (a bit each) in whose shadow it may
 * lie, which takes no time. */
Effects effects_of_boxed(const Scene *scene, const Object *object, const MeshBox *box,
                         uint32_t shadowed);

/* Whether an occluder may come between a receiver, perhaps itself, and a light that has shadows and
 * something to light there. An object that is convex does not shadow itself: where N.L > 0 it sees
 * the light. `boxes`: of the objects' meshes; `placed`: the same in the world. */
bool effects_may_shadow(const Scene *scene, int light, int occluder, int receiver,
                        const MeshBox *boxes, const PlacedBox *placed);

/* The number of a light among those that have shadows, for which the masks have a channel each. */
int effects_channel(const Scene *scene, int light);

/* The whole model, for comparison: terms that the scene lacks have coefficients of 0. Colors of
 * vertices take a uniform's place, and shadows are looked up, so they are not a matter of
 * coefficients: there are shadows if a light of the scene has them. */
Effects effects_full(const Scene *scene, const Object *object);

/* Writes a line for each effect and for each one left out, with the reason: "specular: in light and
 * material", "without light 2: it is off". */
void effects_explain(const Scene *scene, const Object *object, FILE *file);

#endif
