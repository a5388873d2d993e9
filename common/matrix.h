/*
 * matrix: vectors and 4x4 matrices in double precision. No GL.
 *
 * Conventions, for the whole project: vectors are columns, a matrix is stored column after column
 * (m[4 * column + row], as OpenGL wants it), and angles at the interface are in degrees. A matrix
 * that takes coordinates of space a to space b is named b_from_a, so that a product reads
 * clip_from_model = clip_from_eye * eye_from_world * world_from_model.
 *
 * Arguments and results are passed by value, and a result is written after every argument has been
 * read: any of them may be the same object. A function that can fail returns bool and always
 * writes its result: what it writes on failure is said with each, and is always finite.
 */
#ifndef MATRIX_H
#define MATRIX_H

#include <stdbool.h>

typedef struct Vec3 {
    double x, y, z;
} Vec3;

typedef struct Vec4 {
    double x, y, z, w;
} Vec4;

typedef struct Mat4 {
    double m[16]; /* m[4 * column + row] */
} Mat4;

/* Vectors. Any length, any unit; products and sums overflow as those of numbers do. */

double vec3_dot(Vec3 a, Vec3 b);
Vec3 vec3_add(Vec3 a, Vec3 b);
Vec3 vec3_subtract(Vec3 a, Vec3 b);
Vec3 vec3_scale(Vec3 a, double factor);

/* a x b; right-handed. Each component is a difference of products with a relative error of at most
 * 2.2e-16 (Kahan; Jeannerod, Louvet and Muller, Math. Comp. 82, 2013), so nearly parallel vectors
 * keep their digits, and exactly parallel ones give exactly zero. */
Vec3 vec3_cross(Vec3 a, Vec3 b);

/* Length, without overflow or underflow on the way: right for lengths of 5e-324 to 1.8e308. Not
 * finite where `a` is not. */
double vec3_length(Vec3 a);

/* The unit vector along `a`. False, and a zero vector, where `a` is zero or not finite. */
bool vec3_normalize(Vec3 a, Vec3 *unit);

/* Matrices that cannot fail. */

Mat4 mat4_identity(void);
Mat4 mat4_translate(Vec3 offset);
Mat4 mat4_scale(Vec3 factors);
Mat4 mat4_transpose(Mat4 a);

/* a * b: what b does first, then a. */
Mat4 mat4_product(Mat4 a, Mat4 b);

/* Rotation about `axis` (any length) by `degrees`, counter-clockwise seen from the axis's tip.
 * Exact at multiples of 90 degrees about a coordinate axis; the angle is reduced in degrees, where
 * that is exact, before it becomes radians. False, and the identity, where the axis is zero or
 * anything is not finite. (OpenGL 1.1 specification, section 2.10.2, Rotate) */
bool mat4_rotate(double degrees, Vec3 axis, Mat4 *rotation);

/* The rigid transform to eye coordinates: the eye at the origin, `center` on the negative z axis,
 * `up` in the half plane x = 0, y > 0. `up` need be neither unit nor perpendicular. The rotation is
 * orthonormal to 4e-15 whatever the arguments.
 * False, with a matrix that is still rigid and usable, where the arguments do not determine it:
 *   up is zero or exactly parallel to center - eye, as rounded: the coordinate axis least along the
 *     view (of equals y, then z) stands in for up;
 *   eye equals center: the view is along -z;
 *   anything is not finite, or the translation would not be: the identity. */
bool mat4_look_at(Vec3 eye, Vec3 center, Vec3 up, Mat4 *eye_from_world);

/* Projections to OpenGL's clip space: near to z/w = -1, far to z/w = +1. `far` may be INFINITY in
 * the first two (Upchurch and Desbrun, JGT 16(1), 2012). False, and the identity, where
 *   perspective: not 0 < fovy_degrees < 180, not 0 < aspect < inf, not 0 < near < far;
 *   frustum: left = right, bottom = top, or not 0 < near < far;
 *   ortho: left = right, bottom = top or near = far;
 * or where anything else is not finite, or a coefficient would be (fovy of 1e-320, say). `aspect`
 * is width / height. (OpenGL 1.1 specification, section 2.10.2; gluPerspective) */
bool mat4_perspective(double fovy_degrees, double aspect, double near, double far,
                      Mat4 *clip_from_eye);
bool mat4_frustum(double left, double right, double bottom, double top, double near, double far,
                  Mat4 *clip_from_eye);
bool mat4_ortho(double left, double right, double bottom, double top, double near, double far,
                Mat4 *clip_from_eye);

/* What a matrix does to a homogeneous vector; to a point (w = 1, divided by the resulting w, which
 * for an affine matrix is 1: a point at infinity gets the infinities of IEEE arithmetic); and to a
 * direction (w = 0, no division). */
Vec4 mat4_transform(Mat4 a, Vec4 v);
Vec3 mat4_transform_point(Mat4 a, Vec3 point);
Vec3 mat4_transform_direction(Mat4 a, Vec3 direction);

/* Determinant: of an affine matrix (bottom row exactly 0 0 0 1) by the cofactors of its 3x3 part,
 * and exactly 0 where that is singular but for the rounding of a product of matrices (a condition,
 * with rows and columns scaled alike, of 1e13 or more), so that its sign says whether `a` mirrors,
 * as that of mat4_normal does; of any other by Gaussian elimination with partial pivoting. Nothing
 * overflows or underflows on the way, the result only where the value does. Not a number where `a`
 * is not finite. */
double mat4_determinant(Mat4 a);

/* The inverse. An affine matrix (bottom row exactly 0 0 0 1) goes through its 3x3 part, by
 * cofactors whose differences of products keep their digits; any other through Gaussian elimination
 * with partial pivoting (Higham, Accuracy and Stability of Numerical Algorithms, ch. 9 and 14).
 * Rows and columns are scaled by powers of two first, and no threshold enters: a scale of 1e-300
 * inverts. The relative error of the inverse and the distance of inverse * a from the identity are
 * at most a small multiple of condition * 1.1e-16 (Frobenius norms); that of a * inverse can be far
 * larger.
 * False, and the identity, where the matrix is singular (its determinant or a pivot is computed as
 * exactly 0: one that is singular but for rounding may pass) or not finite, or its inverse is not
 * finite. */
bool mat4_inverse(Mat4 a, Mat4 *inverse);

/* The matrix for normals, which have to stay perpendicular to a surface that `a` transforms: the
 * transpose of the inverse of the upper left 3x3 part, up to a positive factor, in a 4x4 matrix
 * whose other entries are the identity's. Computed as sign(det) * cofactor matrix, which needs no
 * division and so exists for singular matrices too (Turkowski, Graphics Gems, 1990), and divided by
 * a power of two that brings its largest entry into [0.5, 1). The result must be normalized.
 * False, with a zero 3x3 part, where no surface keeps a normal (rank below 2) or any entry of `a`
 * is not finite. Where mat4_determinant is zero its sign counts as +1. */
bool mat4_normal(Mat4 a, Mat4 *normal_matrix);

/* For upload to a uniform: rounds to nearest, column by column. A value beyond a float's range
 * becomes an infinity. */
void mat4_to_float(Mat4 a, float out[16]);
void vec3_to_float(Vec3 a, float out[3]);

/* The vector of three floats, exactly. */
Vec3 vec3_from_float(const float v[3]);

#endif
