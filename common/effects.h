/*
 * effects: which effects a scene calls for, and why. No GL.
 *
 * effects_of is a pure function from data to a set. What is not in the set costs no uniform, no
 * varying and no instruction: `lighting` makes the program from the set and from nothing else.
 * Values, such as colours, are no part of it.
 */
#ifndef EFFECTS_H
#define EFFECTS_H

#include "scene.h"

#include <stdio.h>

enum { EFFECTS_MOST_LIGHTS = 32 };

/* The terms that one light contributes. Lights with equal terms share code, in a loop. */
typedef struct LightTerms {
    LightKind kind;
    bool ambient; /* that varies over the surface; a constant one is part of the base */
    bool diffuse;
    bool specular;
    bool attenuation; /* depends on the distance */
    bool exponent;    /* a spot's fall-off within its cone */
    bool half_vector; /* specular, and the same everywhere: a uniform */
    bool at_vertex;   /* computed at the vertices, whose interpolation is exact or wanted */
    bool any;         /* in the full program: whatever kind, by its coefficients */
} LightTerms;

/* The divisions by zero that a light may come to. What cannot is not guarded. */
typedef struct LightGuards {
    bool distance;    /* a point of the object may be where the light is */
    bool attenuation; /* its denominator may be 0 there */
    bool half_vector; /* light and viewer may be opposite each other */
} LightGuards;

/* Lights that share their terms, by their numbers in the scene. */
typedef struct LightGroup {
    LightTerms terms;
    LightGuards guards; /* those that any of them needs */
    int lights[EFFECTS_MOST_LIGHTS];
    int count;
} LightGroup;

typedef struct Effects {
    bool alpha; /* the surface is not opaque */
    bool base;  /* a colour that is the same everywhere: emission and constant ambient */
    LightGroup groups[EFFECTS_MOST_LIGHTS];
    int group_count;
    Reflection reflection; /* where any group is specular */
    bool normals;          /* any light has a diffuse or specular term */
    bool local_viewer;     /* V differs from point to point, and something depends on it */
    bool two_sided;
    bool normal_matrix;      /* a matrix of its own; else the model-view matrix serves */
    bool normalize_vertex;   /* a transformed normal is not unit */
    bool normalize_fragment; /* an interpolated normal is not unit */
    bool clamp_vertex;
    bool linear;
    bool show_clipped;
    bool cull;           /* back faces are never seen */
    bool guard_vertex;   /* a normal that is made unit at the vertices may have no length */
    bool guard_fragment; /* or at the fragments */
    bool guard_viewer;   /* a vertex may be at the eye */
} Effects;

/* What counts of a mesh as a whole. */
typedef struct MeshFacts {
    Vec3 low, high;      /* its box */
    double least_normal; /* the lengths of its normals */
    double most_normal;
    double least_cosine; /* of the angles between the normals of a triangle */
} MeshFacts;
MeshFacts mesh_facts(const Mesh *mesh);

/* The effects that an object in a scene calls for. The scene has passed scene_check. */
Effects effects_of(const Scene *scene, const Object *object);

/* The same where the facts of its mesh are known: those take time. */
Effects effects_of_facts(const Scene *scene, const Object *object, const MeshFacts *facts);

/* Everything the model has, for comparison: the same picture from a program that leaves nothing out
 * that can be computed with coefficients of zero. */
Effects effects_full(const Scene *scene, const Object *object);

/* Adds every guard. What is left out by effects_of is proved for the points of the object;
 * multisampling may shade the centre of a pixel beside it. */
void effects_guard(Effects *effects);

/* Writes one line for each member and for each thing left out, with its reason: "specular of light
 * 1: material and light both have it", "without light 2: it is off". */
void effects_explain(const Scene *scene, const Object *object, FILE *file);

#endif
