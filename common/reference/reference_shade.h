/*
 * reference_shade: the lighting equation at one point. (OpenGL 1.1 specification, section 2.13.1;
 * Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975; Blinn, Models of Light
 * Reflection, SIGGRAPH 1977)
 *
 * Space: the axes are the world's, the origin is the eye.
 */
#ifndef REFERENCE_SHADE_H
#define REFERENCE_SHADE_H

#include "reference/reference_real.h"
#include "scene/light.h"
#include "scene/material.h"

#include <stdint.h>

typedef struct ShadeLight {
    const Light *light;
    Real3 position;     /* point and spot */
    Real3 direction;    /* unit: directional, towards the light; spot, its axis */
    Real cosine_cutoff; /* spot */
} ShadeLight;

typedef struct Shading {
    const ShadeLight *lights; /* those that are not off */
    int light_count;
    Real3 global_ambient;
    bool reflection_phong;
    bool distant_viewer;
    bool signed_dots; /* see scene.h */
    Real3 view;       /* unit, towards the viewer where that is distant */
} Shading;

/* On which side of its jumps a point lies: of each light whether it is within the cone, and whether
 * it faces the light, one bit each (beyond 16 lights some share theirs); `matters` has the bits
 * whose change would change the color by more than SHADE_JUMP. `lights`: of each light that casts
 * shadows and of which something would arrive two bits: a shadow keeps it off; it reaches the
 * point. */
typedef struct ShadeSides {
    uint32_t bits, matters, lights;
} ShadeSides;

/* Of linear intensity; encoded as sRGB at most 13 times that: a sixth of a step of 1/255. */
#define SHADE_JUMP 5e-5

/* Notes one bit: on which side of a jump of so much color a point lies. */
static inline void shade_note_side(ShadeSides *sides, int number, bool inside, Real jump)
{
    const uint32_t bit = (uint32_t)1 << (number & 31);
    sides->bits ^= inside ? bit : 0;
    sides->matters |= jump > (Real)SHADE_JUMP ? bit : 0;
}

/* Notes whether a light reaches a point, or a shadow keeps it off. */
static inline void shade_note_light(ShadeSides *sides, int number, bool hidden)
{
    sides->lights |= (hidden ? (uint32_t)1 : (uint32_t)2) << (2 * number & 31);
}

/* What is lit: a point of a surface of this material. */
typedef struct ShadePoint {
    const Material *material;
    Real3 position;
    Real3 normal; /* unit; or zero: then only emission and ambient light count */
} ShadePoint;

/* What one light would add to a point's color. */
typedef struct LightSample {
    Real3 sum;      /* all its terms */
    Real3 ambient;  /* of that: what a shadow leaves */
    Real highlight; /* the largest channel, also where the surface faces away */
    bool in_cone;   /* else nothing is added */
    bool faces;     /* N.L > 0 */
} LightSample;
LightSample shade_light(const Shading *shading, const ShadePoint *point, int number);

/* How much more than its ambient part arrives, if no shadow keeps it off. */
Real shade_arriving(const LightSample *sample);

/* Emission and global ambient light. */
Real3 shade_base(const Shading *shading, const ShadePoint *point);

/* The color of a point that no shadow falls on; not clamped. */
Real3 shade_point(const Shading *shading, const ShadePoint *point, ShadeSides *sides);

/* Adds an unshadowed light's part to a color, and notes its jumps. */
void shade_add(const Shading *shading, int number, const LightSample *sample, Real3 *color,
               ShadeSides *sides);

#endif
