/*
 * light: light sources.
 */
#ifndef LIGHT_H
#define LIGHT_H

#include "core/matrix.h"

#include <math.h>
#include <stdbool.h>

typedef enum LightKind {
    LIGHT_DIRECTIONAL, /* infinitely far away: its rays are parallel */
    LIGHT_POINT,       /* at a position, in all directions */
    LIGHT_SPOT,        /* at a position, within a cone */
} LightKind;

/* In what its position and direction are given. */
typedef enum LightSpace {
    LIGHT_WORLD, /* it stays in the world when the camera moves */
    LIGHT_EYE,   /* it belongs to the viewer and moves along, as a lamp on a helmet */
} LightSpace;

/* The light source of the OpenGL 1.1 specification, section 2.13.1. */
typedef struct Light {
    bool off; /* a zeroed light is on */
    /* A point is lit by it only where the segment to it, or the ray if it is directional, meets no
     * other surface: every object casts and receives shadows, wherever the camera is and whatever
     * its alpha. Its ambient term is not shadowed. */
    bool shadows;
    LightKind kind;
    LightSpace space;
    Vec3 position;  /* point and spot */
    Vec3 direction; /* directional: towards the light; spot: the axis of its cone, away from the
                       light. Any length but 0 */
    Vec3 ambient, diffuse, specular; /* intensities for red, green and blue, 0 or more */
    double cutoff;                   /* spot: half the cone's angle in degrees, 0 to 90 */
    double exponent;                 /* spot: the falloff within the cone, 0 to 128 */
    /* Point and spot: 1 / (constant + linear d + quadratic d^2) of the light arrives at distance d.
     * Each 0 or more; all three 0 mean no attenuation. */
    double constant, linear, quadratic;
    /* Point and spot, if not 0: that times 1 - (d / range)^4, and beyond nothing.
     * (KHR_lights_punctual of glTF 2.0) */
    double range;
} Light;

/* As OpenGL's GL_POSITION has it: a position with w = 1, or the direction towards it with w = 0. */
static inline Vec4 light_place(const Light *light)
{
    return light->kind == LIGHT_DIRECTIONAL
               ? (Vec4){light->direction.x, light->direction.y, light->direction.z, 0}
               : (Vec4){light->position.x, light->position.y, light->position.z, 1};
}

/* Whether a light or reflectivity of this color contributes nothing. */
static inline bool color_is_black(Vec3 color)
{
    return color.x == 0 && color.y == 0 && color.z == 0;
}

/* By channel: light and reflectivity. */
static inline Vec3 color_product(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* As a reflectivity: each from 0 to 1. */
static inline Vec3 color_within_one(Vec3 color)
{
    return (Vec3){fmin(fmax(color.x, 0), 1), fmin(fmax(color.y, 0), 1), fmin(fmax(color.z, 0), 1)};
}

/* Whether attenuation depends on distance. */
static inline bool light_fades(const Light *light)
{
    return light->kind != LIGHT_DIRECTIONAL &&
           (light->linear != 0 || light->quadratic != 0 || light->range != 0);
}

/* How much of it arrives at a distance: 1 of a light without attenuation. */
static inline double light_attenuation(const Light *light, double distance)
{
    const double d = distance, near = light->range > 0 ? d / light->range : 0;
    const double sum = light->constant + light->linear * d + light->quadratic * d * d;
    const bool none = light->constant == 0 && light->linear == 0 && light->quadratic == 0;
    return light->kind == LIGHT_DIRECTIONAL
               ? 1
               : fmax(1 - near * near * near * near, 0) / (none ? 1 : sum);
}

/* Whether its ambient light varies over a surface; otherwise it is part of the constant base. */
static inline bool light_ambient_varies(const Light *light)
{
    return light->kind == LIGHT_SPOT || light_fades(light);
}

#endif
