/*
 * shadow_frustum: what a shadow map has to hold, from boxes of what casts and receives. No GL.
 */
#ifndef SHADOW_FRUSTUM_H
#define SHADOW_FRUSTUM_H

#include "shadows/shadow_culling.h"

enum { SHADOW_FACES = 6 };

/* What one map sees of the world. */
typedef struct ShadowFrustum {
    Mat4 light_from_world; /* a rotation and a translation: the light looks along -z */
    Mat4 map_from_light;   /* to clip coordinates */
    double near, far;      /* along the view: of what casts */
    double width;          /* of the larger side; in perspective at a distance of 1 */
    bool perspective;
} ShadowFrustum;

typedef struct ShadowFitting {
    Vec4 light;             /* its position with w = 1, or the direction towards it with w = 0 */
    Vec3 axis;              /* of a spot's cone, away from it; zero: it shines in all directions */
    double reach;           /* the tangent of half the cone */
    const PlacedBox *boxes; /* of `count` objects */
    const uint32_t *throws, *receives; /* of each, a bit for each light */
    int count, number;                 /* the light's */
} ShadowFitting;

/* Fits frusta to what of the casters may fall on the receivers: one for parallel light, for a cone
 * up to a half of 63 degrees, and where that is enough for a light in all directions; else those
 * faces of a cube that are needed. How many; 0: nothing can be seen. `size`: of the map in texels,
 * of which two more are kept at each side for filters. */
int shadow_frusta(const ShadowFitting *fitting, int size, ShadowFrustum frusta[SHADOW_FACES]);

/* How far apart neighbouring values of the depth are at a distance, if it has so many bits. */
double shadow_depth_step(const ShadowFrustum *frustum, int bits, double distance);

#endif
