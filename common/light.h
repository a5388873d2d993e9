/*
 * light: where light comes from.
 */
#ifndef LIGHT_H
#define LIGHT_H

#include "matrix.h"

#include <stdbool.h>

typedef enum LightKind {
    LIGHT_DIRECTIONAL, /* infinitely far away: its rays are parallel */
    LIGHT_POINT,       /* at one place, in all directions */
    LIGHT_SPOT,        /* at one place, within a cone */
} LightKind;

/* The light source of the OpenGL 1.1 specification, section 2.13.1, in world coordinates. */
typedef struct Light {
    bool off; /* a zeroed light is on */
    LightKind kind;
    Vec3 position;  /* point and spot */
    Vec3 direction; /* directional: towards the light; spot: the axis of its cone, away from the
                       light. Any length but 0 */
    Vec3 ambient, diffuse, specular; /* intensities for red, green and blue, 0 or more */
    double cutoff;                   /* spot: half the cone's angle in degrees, 0 to 90 */
    double exponent;                 /* spot: the fall-off within the cone, 0 to 128 */
    /* Point and spot: 1 / (constant + linear d + quadratic d^2) of the light arrives at distance d.
     * Each 0 or more; all three 0 stands for no attenuation. */
    double constant, linear, quadratic;
} Light;

/* Whether a light of this colour, or what reflects it, gives nothing. */
static inline bool color_is_black(Vec3 color)
{
    return color.x == 0 && color.y == 0 && color.z == 0;
}

/* Whether less of it arrives at a greater distance. */
static inline bool light_fades(const Light *light)
{
    return light->kind != LIGHT_DIRECTIONAL && (light->linear != 0 || light->quadratic != 0);
}

/* Whether its ambient light differs from point to point. Else that is part of the base, a colour
 * which is the same everywhere. */
static inline bool light_ambient_varies(const Light *light)
{
    return light->kind == LIGHT_SPOT || light_fades(light);
}

#endif
