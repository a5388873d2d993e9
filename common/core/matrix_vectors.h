/*
 * matrix_vectors: the vectors' functions of matrix.h, to be put in the place of their calls.
 *
 * Included by files that loop over the vertices of large meshes. matrix_vectors.c makes functions
 * of the same text.
 */
#ifndef MATRIX_VECTORS_H
#define MATRIX_VECTORS_H

#include "core/matrix.h"

#include <math.h>

#ifndef MATRIX_INLINE
#define MATRIX_INLINE extern inline __attribute__((gnu_inline)) /* never a function of its own */
#endif

/* Whether the largest component of a vector of this square is within 2^-200 and 2^200; and what is
 * done with any other. */
bool matrix_plain(double square);
double matrix_any_length(Vec3 a);
bool matrix_any_normalize(Vec3 a, Vec3 *unit);

MATRIX_INLINE double vec3_dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

MATRIX_INLINE Vec3 vec3_add(Vec3 a, Vec3 b)
{
    return (Vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

MATRIX_INLINE Vec3 vec3_subtract(Vec3 a, Vec3 b)
{
    return (Vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

MATRIX_INLINE Vec3 vec3_scale(Vec3 a, double factor)
{
    return (Vec3){a.x * factor, a.y * factor, a.z * factor};
}

MATRIX_INLINE bool matrix_plain(double square)
{
    return square > 0x1p-398 && square < 0x1p398;
}

MATRIX_INLINE double vec3_length(Vec3 a)
{
    const double square = vec3_dot(a, a);
    return matrix_plain(square) ? sqrt(square) : matrix_any_length(a);
}

MATRIX_INLINE bool vec3_normalize(Vec3 a, Vec3 *unit)
{
    const double square = vec3_dot(a, a), length = sqrt(square);
    if (!matrix_plain(square))
        return matrix_any_normalize(a, unit);
    *unit = (Vec3){a.x / length, a.y / length, a.z / length};
    return true;
}

MATRIX_INLINE void vec3_to_float(Vec3 a, float out[3])
{
    out[0] = (float)a.x;
    out[1] = (float)a.y;
    out[2] = (float)a.z;
}

MATRIX_INLINE Vec3 vec3_from_float(const float v[3])
{
    return (Vec3){(double)v[0], (double)v[1], (double)v[2]};
}

#endif
