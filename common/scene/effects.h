/*
 * effects: which lighting effects an object in a scene needs, and why. No GL.
 *
 * In two steps. Facts are what decides: not that a light's color is (0.2, 0, 0) but that it is not
 * black. They are small, cheap to find again, and compared as bytes; values such as colors and
 * places change every frame, and facts seldom. effects_decide is a pure function from facts to a
 * set. `lighting` generates the program from that set alone: what is not in it costs no uniform, no
 * varying and no instruction.
 */
#ifndef EFFECTS_H
#define EFFECTS_H

#include "scene/scene.h"

#include <stddef.h>
#include <stdio.h>

/* Of an object, because they are a program's uniforms. A scene may have more: then each object gets
 * those that reach it. */
enum { EFFECTS_MAX_LIGHTS = 32 };

/* The lights of an object, by their numbers in the scene, in its order. */
typedef struct EffectsLights {
    int count;
    uint16_t numbers[EFFECTS_MAX_LIGHTS];
    uint32_t on, spots, fading; /* a bit for each of them; of those that are on */
    double spent; /* what the faint lights add that are not among them, at most; if also others are
                     not, all that faint ones may add */
} EffectsLights;

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
    bool signed_dots; /* a negative N.L counts */
    bool range;       /* it ends at a distance */
    bool unused[2];   /* instead of padding */
    /* Another surface may come between: 1 plus the number of the mask that knows where; or 0. */
    int shadow;
} LightTerms;

/* Lights with equal terms, as indices into the object's lights. */
typedef struct LightGroup {
    LightTerms terms;
    int count;
    uint8_t lights[EFFECTS_MAX_LIGHTS];
    /* 1: an attenuation's denominator may be 0, or too large for a float. Every other division and
     * root is always guarded; this guard is conditional because it costs up to 2% of a frame with
     * many lights. */
    int guard_attenuation;
} LightGroup;

/* Compared as bytes: what is not used is zero. */
typedef struct Effects {
    bool alpha;         /* the surface is not opaque */
    bool vertex_color;  /* the mesh has colors, and a term depends on them */
    bool lit_positions; /* light is computed elsewhere than at the vertex */
    bool base;          /* emission or constant ambient light */
    bool normals;       /* any light has a diffuse or specular term */
    bool local_viewer;  /* V varies over the surface, and a term depends on it */
    bool two_sided;
    bool normal_matrix;      /* a separate matrix, not the model-view matrix */
    bool normalize_vertex;   /* a transformed normal is not of length 1 */
    bool normalize_fragment; /* an interpolated normal is not of length 1 */
    bool clamp_vertex;
    bool linear;
    bool show_clipped;
    bool limit; /* colors may be so large that a driver draws them as black */
    bool cull;  /* back faces are never visible */
    bool phong; /* the reflection, if any group is specular: REFLECTION_PHONG */
    int group_count;
    LightGroup groups[EFFECTS_MAX_LIGHTS];
} Effects;

/* Facts. A color is the set of its channels that are not 0, a bit each. */

typedef struct LightFacts {
    uint8_t kind, off, shadows;
    uint8_t fades;    /* attenuation depends on the distance */
    uint8_t exponent; /* of a spot; not 0 */
    uint8_t range;    /* not 0 */
    uint8_t ambient, diffuse, specular;
} LightFacts;

/* Of a scene and the lights of an object. */
typedef struct SceneFacts {
    uint32_t shadows; /* the scene's lights that have them, a bit each: see effects_channel */
    uint16_t numbers[EFFECTS_MAX_LIGHTS]; /* in the scene */
    LightFacts lights[EFFECTS_MAX_LIGHTS];
    uint8_t light_count, ambient, reflection, interpolation; /* ambient: all that is constant */
    uint8_t distant_viewer, clamp_vertex, skip_renormalization, linear, show_clipped, signed_dots;
    uint8_t limit;  /* its colors may be very large */
    uint8_t unused; /* instead of padding */
} SceneFacts;

typedef struct SideFacts {
    uint8_t ambient, diffuse, specular, emission, translucent;
} SideFacts;

typedef struct ObjectFacts {
    /* A bit for each of its lights: */
    uint32_t missed; /* a spot, whose cone misses the object */
    uint32_t beyond_range;
    uint32_t behind;   /* all of the surface turns away from it */
    uint32_t faint;    /* together they add less than half a step of 1/255 to any pixel */
    uint32_t guarded;  /* as LightGroup.guard_attenuation */
    uint32_t shadowed; /* the object may lie in its shadow */
    SideFacts front, back;
    uint8_t colors, flat, closed, clockwise, two_sided, wrong_normals;
    uint8_t transform; /* of normals: an EffectsTransform */
    uint8_t beyond;    /* the near plane does not cut it */
    uint8_t unused[2]; /* instead of padding */
    /* Decides nothing: of each light that is faint, how much it adds to a pixel at most, in steps
     * of 1/255. */
    float steps[EFFECTS_MAX_LIGHTS];
    float spent; /* the same of the scene's lights that are not among its own */
} ObjectFacts;
enum { OBJECT_FACTS_DECIDE = offsetof(ObjectFacts, steps) }; /* so many bytes */

/* Of an object's transform, up to a rotation and a translation: none, a factor, one whose square
 * leaves a 16-bit float, anything. */
typedef enum EffectsTransform { ORTHONORMAL, ORTHOGONAL, EXTREME, GENERAL } EffectsTransform;

EffectsTransform effects_transform(Mat4 world_from_object);

/* Around all normals of a surface, of its vertices and its triangles; and the surface is nowhere
 * lower than `low` along the axis. */
typedef struct NormalCone {
    Vec3 axis;     /* unit */
    double cosine; /* of half its angle; 0: it may have any normal */
    double low;
} NormalCone;
NormalCone effects_normal_cone(const Mesh *mesh);

/* What follows from its mesh and transform alone. */
typedef struct EffectsPlace {
    Sphere sphere;
    EffectsTransform transform;
    NormalCone normals; /* in the world */
} EffectsPlace;
EffectsPlace effects_place(const Object *object, const MeshBox *box, const NormalCone *normals);

typedef struct EffectsLight {
    Light light;         /* in the world */
    double brightest[3]; /* ambient that varies, diffuse, specular */
} EffectsLight;

/* A scene's lights and eye, for all its objects. */
typedef struct EffectsView {
    const Scene *scene;
    Mat4 eye_from_world;
    EffectsLight *lights; /* of the scene */
    int room;
    EffectsLights all; /* if an object may have all */
    uint32_t shadows;  /* as in SceneFacts, and so on */
    uint8_t ambient, limit;
    bool any_normals; /* the caller's: they are not the mesh's */
} EffectsView;
void effects_view(EffectsView *view, const Scene *scene); /* zeroed, or of another scene */
void effects_view_close(EffectsView *view);               /* zeroed is fine */

/* Whether a light is among an object's, or why not. */
typedef enum EffectsReach {
    REACH_YES,
    REACH_OFF,
    REACH_RANGE,
    REACH_CONE,
    REACH_BEHIND,
    REACH_BLACK,
    REACH_FAINT,
    REACH_MORE,
    REACH_COUNT
} EffectsReach;
extern const char *const EFFECTS_REACHES[REACH_COUNT]; /* as sentences, after the light */

/* The lights of an object: `view->all`, or `chosen`; and, unless `why` is NULL, an EffectsReach for
 * each light of the scene. */
const EffectsLights *effects_lights(const EffectsView *view, const Object *object,
                                    const EffectsPlace *place, EffectsLights *chosen, uint8_t *why);

SceneFacts effects_scene(const EffectsView *view, const EffectsLights *lights);

/* `shadowed`: the scene's lights (a bit each) in whose shadow it may lie: scene/shadow_pairs.h. */
ObjectFacts effects_object(const EffectsView *view, const EffectsLights *lights,
                           const Object *object, const EffectsPlace *place, uint32_t shadowed);

/* Writes, unless `why` is NULL, a line for each effect and for each one left out, with the reason:
 * "specular: in light and material", "without light 2: it is off". */
Effects effects_decide(const SceneFacts *scene, const ObjectFacts *object, FILE *why);

/* The whole model, for comparison: terms that the scene lacks have coefficients of 0. Colors of
 * vertices take a uniform's place, and shadows are looked up, so they are not a matter of
 * coefficients: there are shadows if a light of the scene has them. */
Effects effects_decide_full(const SceneFacts *scene, const ObjectFacts *object);

/* The number of a light among those that have shadows, for which the masks have a channel each. */
int effects_channel(uint32_t shadows, int light);

/* A side's material; with vertex colors, its ambient and diffuse reflectivity are those, and white
 * here. */
Material effects_material(const Object *object, bool back);

#endif
