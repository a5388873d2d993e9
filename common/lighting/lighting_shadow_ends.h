/*
 * lighting_shadow_ends: planes at which shadow volumes end. For lighting's own files. No GL.
 */
#ifndef LIGHTING_SHADOW_ENDS_H
#define LIGHTING_SHADOW_ENDS_H

#include "lighting/lighting.h"

/* Planes before which all lies that receives a light's shadows. Their directions are those of the
 * sides of the largest boxes: a floor's, walls'. */
enum { END_BOXES = 10 };
typedef struct ShadowEnds {
    int count;
    Vec3 ways[6 * END_BOXES];
    double least[6 * END_BOXES]; /* of the receivers along the way, less a little */
} ShadowEnds;

void shadow_ends_find(ShadowEnds *ends, const LightingPlan *plan, int light);

/* Of these planes the one that ends a caster's volume the soonest; (0, 0, 0, 1), infinity, if there
 * is none. */
Vec4 shadow_ends_choose(const ShadowEnds *ends, const PlacedBox *caster, const Light *light);

/* Whether a part of the box may lie beyond the end. */
bool shadow_end_before(const Vec4 *end, const PlacedBox *box);

#endif
