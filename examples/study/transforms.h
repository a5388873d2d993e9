/*
 * transforms: matrices composed in other ways than `lighting` does, to see what those cost.
 *
 * In double precision, in single precision, or in single precision with the error of every product
 * and sum added up beside it and put back at the end (Ogita, Rump and Oishi, Accurate sum and dot
 * product, SIAM J. Sci. Comput. 26(6), 2005: as if in double precision, rounded once). And either
 * relative to the eye, or in the lecture's order: (clip_from_eye * eye_from_world) *
 * world_from_object, where eye_from_world holds the translation by the eye.
 */
#ifndef TRANSFORMS_H
#define TRANSFORMS_H

#include "lighting.h"
#include "setting.h"

/* For the setting's choices of matrices and order. */
const LightingTransforms *transforms_of(const Setting *setting);

#endif
