/*
 * quad: 4x4 matrices in arithmetic of 113 bits, to judge what is computed with doubles.
 *
 * Only + - * / and comparisons are used, which need no library. There is no square root: norms are
 * squared, and who takes the root does so of a quotient, in double.
 */
#ifndef QUAD_H
#define QUAD_H

#include "core/matrix.h"

#if LDBL_MANT_DIG >= 113
typedef long double Quad;
#elif defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
#error "no floating point type of 113 bits to compare with"
#endif

/* Element (row, column) at [row][column]. */
typedef struct QuadMatrix {
    Quad a[4][4];
} QuadMatrix;

Quad quad_abs(Quad x);
QuadMatrix quad_from(Mat4 a);
QuadMatrix quad_product(const QuadMatrix *a, const QuadMatrix *b);
QuadMatrix quad_subtract(const QuadMatrix *a, const QuadMatrix *b);

/* The square of the Frobenius norm. */
Quad quad_norm_squared(const QuadMatrix *a);

/* Gauss-Jordan elimination with full pivoting. Returns the determinant, 0 without an inverse. */
Quad quad_inverse(const QuadMatrix *a, QuadMatrix *inverse);

/* What transforms normals: the cofactors of the upper left 3x3 part, times the sign of its
 * determinant; else zeros. */
QuadMatrix quad_normal(Mat4 a);

/* The angle between the images of a direction under the upper left 3x3 parts of two matrices; pi if
 * they are opposite, or one is zero or not a number. */
double quad_angle(const QuadMatrix *a, const QuadMatrix *b, Vec3 direction);

/* || R R^T - I ||, Frobenius, of the upper left 3x3 part. */
double quad_orthonormality_error(Mat4 r);

/* || X - A^-1 || / || A^-1 ||, Frobenius; A has an inverse. */
double quad_inverse_error(Mat4 a, Mat4 inverse);

/* The angle to the exact normal from what a vertex shader gets of the matrix for normals, in
 * floats. */
double quad_normal_error(Mat4 a, const float normal[16], const float n[3]);

#endif
