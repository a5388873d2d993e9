/*
 * transforms: matrices composed in other ways than `lighting` does.
 *
 * In double precision, in single precision, or in single precision with compensated dot products
 * (Ogita, Rump and Oishi, Accurate sum and dot product, SIAM J. Sci. Comput. 26(6), 2005: as exact
 * as double precision rounded once). Either relative to the eye, or in the lecture's order:
 * (clip_from_eye * eye_from_world) * world_from_object, with the eye's translation in
 * eye_from_world.
 */
#ifndef TRANSFORMS_H
#define TRANSFORMS_H

#include "lighting/lighting.h"
#include "scene/quality.h"

/* For the setting's choices of matrices and order. */
const LightingTransforms *transforms_of(const Quality *quality);

#endif
