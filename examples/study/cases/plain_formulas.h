/*
 * plain_formulas: formulas as they are usually written, which fail.
 */
#ifndef PLAIN_FORMULAS_H
#define PLAIN_FORMULAS_H

#include "lighting/lighting.h"

/* The inverse transpose; of a singular matrix the identity, as if left unchanged. */
Mat4 naive_inverse_transpose(Mat4 eye_from_object);

/* The cofactor matrix, without the sign of the determinant. */
Mat4 naive_cofactors(Mat4 eye_from_object);

/* The inverse transpose by cofactors and determinant, in single precision. */
Mat4 naive_float_inverse_transpose(Mat4 eye_from_object);

/* A view matrix in single precision: s = f x up, u = s x f. */
const LightingTransforms *naive_float_look_at(void);

/* All matrices in single precision, multiplied in the lecture's order. */
const LightingTransforms *naive_float_lecture(void);

#endif
