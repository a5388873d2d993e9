/*
 * hard_cases_naive: formulas as they are usually written, with what makes them fail.
 */
#ifndef HARD_CASES_NAIVE_H
#define HARD_CASES_NAIVE_H

#include "lighting.h"

/* The transposed inverse, where a singular matrix leaves in place what was there: an identity. */
Mat4 naive_inverse_transpose(Mat4 eye_from_object);

/* The cofactor matrix, without the sign of the determinant. */
Mat4 naive_cofactors(Mat4 eye_from_object);

/* The transposed inverse by cofactors and determinant, in single precision. */
Mat4 naive_float_inverse_transpose(Mat4 eye_from_object);

/* A view matrix in single precision: s = f x up, u = s x f. */
const LightingTransforms *naive_float_look_at(void);

/* All matrices in single precision, multiplied in the lecture's order. */
const LightingTransforms *naive_float_lecture(void);

#endif
