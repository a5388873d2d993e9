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

/* Where shadows are looked for: of reference_shadow.h, which is above this. */
struct ShadowPoint;
typedef bool ShadowFalls(const struct ShadowPoint *point, int light);

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
    Real3 view;                /* unit, towards the viewer where that is distant */
    ShadowFalls *shadow_falls; /* needed where `shadows` of shade_point is not NULL */
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

/* The color of a point whose normal is a unit vector, or zero: then only emission and ambient
 * light count. Not clamped. `shadows`: where shadows are looked for; NULL: nowhere. A light that a
 * shadow keeps off is on the side of those that the point does not face. */
Real3 shade_point(const Shading *shading, const Material *material, Real3 position, Real3 normal,
                  const struct ShadowPoint *shadows, ShadeSides *sides);

#endif
