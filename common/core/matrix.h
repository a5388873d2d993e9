/*
 * matrix: vectors and 4x4 matrices in double precision. No GL.
 *
 * Most programs need five functions: mat4_perspective and mat4_look_at for the camera, mat4_rotate
 * (or mat4_translate, mat4_scale) for the model, mat4_product to combine them, and mat4_normal for
 * the normals.
 *
 * Vectors are columns, a matrix is stored column by column (m[4 * column + row], as OpenGL
 * expects), and angles are in degrees. A matrix that takes coordinates of space a to space b is
 * named b_from_a, so that a product reads clip_from_model = clip_from_eye * eye_from_world *
 * world_from_model.
 *
 * Arguments and results are passed by value. A result is always finite if the arguments are, except
 * where noted. If its arguments are invalid, such as a zero axis, mat4_X returns a substitute, such
 * as the identity; mat4_try_X writes the same matrix and returns whether the arguments are valid.
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

/* Vectors of any length and unit. Products and sums overflow as those of numbers do. */

double vec3_dot(Vec3 a, Vec3 b);
Vec3 vec3_add(Vec3 a, Vec3 b);
Vec3 vec3_subtract(Vec3 a, Vec3 b);
Vec3 vec3_scale(Vec3 a, double factor);

/* a x b, right-handed. Each component has a relative error of at most 2.2e-16 (Kahan; Jeannerod,
 * Louvet and Muller, Math. Comp. 82, 2013), so nearly parallel vectors keep their digits, and
 * exactly parallel ones give exactly zero. */
Vec3 vec3_cross(Vec3 a, Vec3 b);

/* Length, without intermediate overflow or underflow: correct for lengths of 5e-324 to 1.8e308. Not
 * finite if `a` is not. */
double vec3_length(Vec3 a);

/* The unit vector along `a`. Invalid if `a` is zero or not finite: the zero vector. */
Vec3 vec3_unit(Vec3 a);
bool vec3_normalize(Vec3 a, Vec3 *unit);

/* Matrices. */

Mat4 mat4_identity(void);
Mat4 mat4_translate(Vec3 offset);
Mat4 mat4_scale(Vec3 factors);
Mat4 mat4_transpose(Mat4 a);

/* a * b: applies b first, then a. */
Mat4 mat4_product(Mat4 a, Mat4 b);

/* Rotation about `axis` (any length) by `degrees`, counter-clockwise seen from the tip of the axis.
 * Exact at multiples of 90 degrees about a coordinate axis: the angle is reduced in degrees, which
 * is exact, before it is converted to radians. Invalid if the axis is zero or an argument is not
 * finite: the identity. (OpenGL 1.1 specification, section 2.10.2, Rotate) */
Mat4 mat4_rotate(double degrees, Vec3 axis);
bool mat4_try_rotate(double degrees, Vec3 axis, Mat4 *rotation);

/* The rigid transform to eye coordinates: the eye at the origin, `center` on the negative z axis,
 * `up` in the half plane x = 0, y > 0. `up` may have any length and need not be perpendicular to
 * the view. The rotation is orthonormal to 4e-15 for all arguments. Invalid if
 *   up is zero or exactly parallel to center - eye, as rounded: the coordinate axis least along the
 *     view (of equals y, then z) replaces it;
 *   eye equals center: the view is along -z;
 *   an argument or the translation is not finite: the identity. */
Mat4 mat4_look_at(Vec3 eye, Vec3 center, Vec3 up);
bool mat4_try_look_at(Vec3 eye, Vec3 center, Vec3 up, Mat4 *eye_from_world);

/* Where a projection ends, in eye coordinates; near and far as distances. */
typedef struct MatrixSides {
    double left, right, bottom, top, near, far;
} MatrixSides;

/* Projections to OpenGL's clip space: near to z/w = -1, far to z/w = +1. `aspect` is width /
 * height. `far` may be INFINITY in the first two (Upchurch and Desbrun, JGT 16(1), 2012). Valid
 * if all coefficients are finite and, for perspective: 0 < fovy_degrees < 180, 0 < aspect < inf,
 * 0 < near < far; frustum: left != right, bottom != top, 0 < near < far; ortho: left != right,
 * bottom != top, near != far. Otherwise the identity. (OpenGL 1.1 specification,
 * section 2.10.2; gluPerspective) */
Mat4 mat4_perspective(double fovy_degrees, double aspect, double near, double far);
Mat4 mat4_frustum(double left, double right, double bottom, double top, double near, double far);
Mat4 mat4_ortho(double left, double right, double bottom, double top, double near, double far);
bool mat4_try_perspective(double fovy_degrees, double aspect, double near, double far,
                          Mat4 *clip_from_eye);
bool mat4_try_frustum(MatrixSides sides, Mat4 *clip_from_eye);
bool mat4_try_ortho(MatrixSides sides, Mat4 *clip_from_eye);

bool mat4_is_finite(Mat4 a);

/* Applies a matrix to a homogeneous vector; to a point (w = 1; divided by the resulting w, so a
 * point at infinity gets the infinities of IEEE arithmetic); to a direction (w = 0, undivided). */
Vec4 mat4_transform(Mat4 a, Vec4 v);
Vec3 mat4_transform_point(Mat4 a, Vec3 point);
Vec3 mat4_transform_direction(Mat4 a, Vec3 direction);

/* The matrix that keeps normals perpendicular to a surface transformed by `a`: the transpose of the
 * inverse of the upper left 3x3 part, up to a positive factor; the other entries are the
 * identity's. Computed as sign(det) * cofactor matrix, without a division, so it exists for
 * singular matrices too (Turkowski, Graphics Gems, 1990); the sign of a zero mat4_determinant
 * counts as +1. The squares of its entries add up to 3, as an orthogonal matrix's do: of such an
 * `a` the normal matrix is the 3x3 part itself; after any other, normalize the transformed normals.
 * Invalid if no surface keeps a normal (rank below 2) or `a` is not finite: the 3x3 part is zero.
 */
Mat4 mat4_normal(Mat4 a);
bool mat4_try_normal(Mat4 a, Mat4 *normal_matrix);

/* The inverse. An affine matrix (bottom row exactly 0 0 0 1) is inverted by the cofactors of its
 * 3x3 part, any other by Gaussian elimination with partial pivoting (Higham, Accuracy and Stability
 * of Numerical Algorithms, ch. 9 and 14). Rows and columns are first scaled by powers of two, and
 * there is no threshold: a scale of 1e-300 inverts. The relative error of the inverse and the
 * distance of inverse * a from the identity are at most a small multiple of condition * 1.1e-16
 * (Frobenius norms); that of a * inverse can be far larger. False, and the identity, if the matrix
 * is singular (its determinant or a pivot is computed as exactly 0; one that is singular except for
 * rounding may pass), or it or its inverse is not finite. */
bool mat4_inverse(Mat4 a, Mat4 *inverse);

/* The determinant. Of an affine matrix it is exactly 0 if the 3x3 part is singular except for the
 * rounding of a product of matrices (condition, with rows and columns scaled alike, of 1e13 or
 * more), so that its sign says whether `a` mirrors. No intermediate overflow or underflow. NaN if
 * `a` is not finite. */
double mat4_determinant(Mat4 a);

/* For uniforms: rounds to nearest, column by column. Values beyond a float's range become
 * infinities. */
void mat4_to_float(Mat4 a, float out[16]);
void vec3_to_float(Vec3 a, float out[3]);
Vec3 vec3_from_float(const float v[3]);

#endif
