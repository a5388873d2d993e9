/*
 * Matrices from their definitions, arranged so that no step overflows, underflows or cancels where
 * the result need not: rotations have their angles reduced in degrees, where quarters of a turn are
 * exact.
 */
#include "core/matrix.h"

#include <math.h>

static const double RADIANS_PER_DEGREE = 0.017453292519943295769;

Mat4 mat4_identity(void)
{
    return (Mat4){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

Mat4 mat4_translate(Vec3 offset)
{
    return (Mat4){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, offset.x, offset.y, offset.z, 1}};
}

Mat4 mat4_scale(Vec3 factors)
{
    return (Mat4){{factors.x, 0, 0, 0, 0, factors.y, 0, 0, 0, 0, factors.z, 0, 0, 0, 0, 1}};
}

Mat4 mat4_transpose(Mat4 a)
{
    Mat4 result;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++)
            result.m[4 * column + row] = a.m[4 * row + column];
    return result;
}

Mat4 mat4_product(Mat4 a, Mat4 b)
{
    Mat4 result;
    for (int column = 0; column < 4; column++) {
        const double *v = &b.m[4 * column];
        for (int row = 0; row < 4; row++)
            result.m[4 * column + row] =
                a.m[row] * v[0] + a.m[4 + row] * v[1] + a.m[8 + row] * v[2] + a.m[12 + row] * v[3];
    }
    return result;
}

/* Rigid transforms and projections */

bool mat4_is_finite(Mat4 a)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(a.m[i]))
            return false;
    return true;
}

static bool finite_or_identity(Mat4 candidate, Mat4 *result)
{
    bool finite = mat4_is_finite(candidate);
    *result = finite ? candidate : mat4_identity();
    return finite;
}

bool mat4_try_rotate(double degrees, Vec3 axis, Mat4 *rotation)
{
    *rotation = mat4_identity();
    Vec3 u;
    if (!isfinite(degrees) || !vec3_normalize(axis, &u))
        return false;

    /* Exact: a remainder, and the difference of nearby numbers. */
    double turn = remainder(degrees, 360);
    int quarter = (int)lround(turn / 90);
    double rest = (turn - 90 * quarter) * RADIANS_PER_DEGREE;
    const double cosines[] = {cos(rest), -sin(rest), -cos(rest), sin(rest)};
    double c = cosines[quarter & 3];
    double s = cosines[(quarter - 1) & 3];

    Vec3 v = vec3_scale(u, 1 - c);
    Vec3 w = vec3_scale(u, s);
    *rotation = (Mat4){{c + v.x * u.x, v.x * u.y + w.z, v.x * u.z - w.y, 0, //
                        v.y * u.x - w.z, c + v.y * u.y, v.y * u.z + w.x, 0, //
                        v.z * u.x + w.y, v.z * u.y - w.x, c + v.z * u.z, 0, //
                        0, 0, 0, 1}};
    return true;
}

Mat4 mat4_rotate(double degrees, Vec3 axis)
{
    Mat4 rotation;
    mat4_try_rotate(degrees, axis, &rotation);
    return rotation;
}

/* The third row of a perspective projection, as quotients that cannot overflow. */
static void set_depth(double near, double far, Mat4 *clip_from_eye)
{
    double ratio = near / far;
    double range = isinf(far) ? 1 : (far - near) / far;
    clip_from_eye->m[10] = -(1 + ratio) / range;
    clip_from_eye->m[14] = -2 * (near / range);
}

bool mat4_try_perspective(double fovy_degrees, double aspect, double near, double far,
                          Mat4 *clip_from_eye)
{
    *clip_from_eye = mat4_identity();
    if (!(0 < fovy_degrees && fovy_degrees < 180 && 0 < aspect && isfinite(aspect) && 0 < near &&
          near < far))
        return false;

    /* The cotangent of half the angle, from the smaller of it and its complement, so that wide
     * angles keep their digits. */
    double half = 0.5 * fovy_degrees;
    double cotangent =
        half < 45 ? 1 / tan(half * RADIANS_PER_DEGREE) : tan((90 - half) * RADIANS_PER_DEGREE);
    Mat4 result = {{cotangent / aspect, 0, 0, 0, 0, cotangent, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}};
    set_depth(near, far, &result);
    return finite_or_identity(result, clip_from_eye);
}

Mat4 mat4_perspective(double fovy_degrees, double aspect, double near, double far)
{
    Mat4 clip_from_eye;
    mat4_try_perspective(fovy_degrees, aspect, near, far, &clip_from_eye);
    return clip_from_eye;
}

/* The interval from a to b is |x - middle| <= |radius|. Halved first because sums may overflow. */
static double middle(double a, double b)
{
    return 0.5 * b + 0.5 * a;
}

static double radius(double a, double b)
{
    return 0.5 * b - 0.5 * a;
}

/* Here and in mat4_try_ortho an empty interval or an infinite end gives a coefficient that is not
 * finite, which fails. */
bool mat4_try_frustum(MatrixSides sides, Mat4 *clip_from_eye)
{
    const double near = sides.near;
    *clip_from_eye = mat4_identity();
    if (!(0 < near && near < sides.far))
        return false;
    double width = radius(sides.left, sides.right), height = radius(sides.bottom, sides.top);
    Mat4 result = {{near / width, 0, 0, 0, 0, near / height, 0, 0, //
                    middle(sides.left, sides.right) / width,
                    middle(sides.bottom, sides.top) / height, 0, -1}};
    set_depth(near, sides.far, &result);
    return finite_or_identity(result, clip_from_eye);
}

bool mat4_try_ortho(MatrixSides sides, Mat4 *clip_from_eye)
{
    double width = radius(sides.left, sides.right), height = radius(sides.bottom, sides.top);
    double depth = radius(sides.near, sides.far);
    Mat4 result = mat4_scale((Vec3){1 / width, 1 / height, -1 / depth});
    result.m[12] = -middle(sides.left, sides.right) / width;
    result.m[13] = -middle(sides.bottom, sides.top) / height;
    result.m[14] = -middle(sides.near, sides.far) / depth;
    return finite_or_identity(result, clip_from_eye);
}

Mat4 mat4_frustum(double left, double right, double bottom, double top, double near, double far)
{
    Mat4 clip_from_eye;
    mat4_try_frustum((MatrixSides){left, right, bottom, top, near, far}, &clip_from_eye);
    return clip_from_eye;
}

Mat4 mat4_ortho(double left, double right, double bottom, double top, double near, double far)
{
    Mat4 clip_from_eye;
    mat4_try_ortho((MatrixSides){left, right, bottom, top, near, far}, &clip_from_eye);
    return clip_from_eye;
}

/* Transformation and conversion */

Vec4 mat4_transform(Mat4 a, Vec4 v)
{
    double out[4];
    for (int row = 0; row < 4; row++)
        out[row] = a.m[row] * v.x + a.m[4 + row] * v.y + a.m[8 + row] * v.z + a.m[12 + row] * v.w;
    return (Vec4){out[0], out[1], out[2], out[3]};
}

Vec3 mat4_transform_point(Mat4 a, Vec3 point)
{
    Vec4 v = mat4_transform(a, (Vec4){point.x, point.y, point.z, 1});
    return (Vec3){v.x / v.w, v.y / v.w, v.z / v.w};
}

Vec3 mat4_transform_direction(Mat4 a, Vec3 direction)
{
    Vec4 v = mat4_transform(a, (Vec4){direction.x, direction.y, direction.z, 0});
    return (Vec3){v.x, v.y, v.z};
}

void mat4_to_float(Mat4 a, float out[16])
{
    for (int i = 0; i < 16; i++)
        out[i] = (float)a.m[i];
}

/*
 * Determinant, inverse and normal matrix
 *
 * All three work on B, where A(i, j) = B(i, j) * 2^(row[i] + column[j]) and the largest entry of
 * each row and column of B, unless all are 0, is in [0.5, 1). Nothing is rounded, the products
 * below neither overflow nor underflow, and A's inverse and cofactors are B's times 2^-(row[i] +
 * column[j]), the cofactors up to one common factor.
 */

typedef struct Scaled {
    double b[4][8]; /* b[row][column]; room for the identity to the right of B */
    int row[4], column[4];
} Scaled;

/* Less than any sum of exponents. */
enum { EXPONENT_OF_ZERO = -100000 };

static int exponent_of(double x)
{
    int exponent;
    frexp(x, &exponent);
    return x == 0 ? EXPONENT_OF_ZERO : exponent;
}

/* The upper left n x n part of a finite `a`. All exponents are chosen before anything is scaled, so
 * that a tiny factor of a row and a huge one of a column do not underflow together. */
static Scaled scale_by_powers_of_two(Mat4 a, int n)
{
    Scaled s = {{{0}}, {0}, {0}};
    int exponent[4][4];
    for (int j = 0; j < n; j++) {
        int largest = EXPONENT_OF_ZERO;
        for (int i = 0; i < n; i++) {
            exponent[i][j] = exponent_of(a.m[4 * j + i]);
            if (exponent[i][j] > largest)
                largest = exponent[i][j];
        }
        s.column[j] = largest == EXPONENT_OF_ZERO ? 0 : largest;
    }
    for (int i = 0; i < n; i++) {
        int largest = EXPONENT_OF_ZERO / 2;
        for (int j = 0; j < n; j++)
            if (exponent[i][j] - s.column[j] > largest)
                largest = exponent[i][j] - s.column[j];
        s.row[i] = largest == EXPONENT_OF_ZERO / 2 ? 0 : largest;
        for (int j = 0; j < n; j++)
            s.b[i][j] = ldexp(a.m[4 * j + i], -(s.row[i] + s.column[j]));
    }
    return s;
}

/* Gaussian elimination with partial pivoting on the first `columns` columns of b. Returns the sign
 * of the permutation of the rows, or 0 at a pivot of 0. */
static int eliminate(double b[4][8], int columns)
{
    int sign = 1;
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int i = k + 1; i < 4; i++)
            if (fabs(b[i][k]) > fabs(b[pivot][k]))
                pivot = i;
        if (b[pivot][k] == 0)
            return 0;
        if (pivot != k)
            sign = -sign;
        for (int j = 0; j < columns; j++) {
            double swap = b[k][j];
            b[k][j] = b[pivot][j];
            b[pivot][j] = swap;
        }
        for (int i = k + 1; i < 4; i++) {
            double factor = b[i][k] / b[k][k];
            for (int j = k + 1; j < columns; j++)
                b[i][j] -= factor * b[k][j];
        }
    }
    return sign;
}

/* Cofactors of the upper left 3x3 part of b; returns its determinant. The cofactors keep their
 * digits (vec3_cross), so the error of the inverse is mostly that of the determinant: at most
 * 5 * 1.1e-16 * condition, and a common factor of all entries. */
static double cofactors(double b[4][8], double cofactor[3][3])
{
    for (int i = 0; i < 3; i++) {
        const double *p = b[(i + 1) % 3], *q = b[(i + 2) % 3];
        const Vec3 cross = vec3_cross((Vec3){p[0], p[1], p[2]}, (Vec3){q[0], q[1], q[2]});
        cofactor[i][0] = cross.x;
        cofactor[i][1] = cross.y;
        cofactor[i][2] = cross.z;
    }
    return b[0][0] * cofactor[0][0] + b[0][1] * cofactor[0][1] + b[0][2] * cofactor[0][2];
}

/* The determinant from cofactors(), or 0 if the matrix is singular except for rounding and the sign
 * therefore random. An entry of a product of matrices has an error of a few units of 1.1e-16 of its
 * terms, which changes the determinant by that times its cofactor. The terms exceed 1, the largest
 * of row and column here, only if a row cancels: of flattened models with random rotations, 1 in
 * 10,000 is off by more than 16 such units, and 1 in millions by more than 256. */
static double signed_determinant(double determinant, double cofactor[3][3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += fabs(cofactor[i][j]);
    return fabs(determinant) <= 256 * 0x1p-53 * sum ? 0 : determinant;
}

static bool is_affine(const Mat4 *a)
{
    return a->m[3] == 0 && a->m[7] == 0 && a->m[11] == 0 && a->m[15] == 1;
}

double mat4_determinant(Mat4 a)
{
    if (!mat4_is_finite(a))
        return (double)NAN;
    const int n = is_affine(&a) ? 3 : 4;
    Scaled s = scale_by_powers_of_two(a, n);
    double mantissa, cofactor[3][3];
    int exponent = 0;
    if (n == 3) {
        mantissa = cofactors(s.b, cofactor);
        mantissa = signed_determinant(mantissa, cofactor);
    } else {
        mantissa = eliminate(s.b, 4);
    }
    for (int i = 0; i < n; i++) {
        int step;
        mantissa = frexp(n == 3 ? mantissa : mantissa * s.b[i][i], &step);
        exponent += step + s.row[i] + s.column[i];
    }
    return ldexp(mantissa, exponent);
}

/* Eliminates in the transpose, so it solves for the inverse row by row. That brings inverse * a,
 * which takes a vector there and back, within condition * 1.1e-16 of the identity; elimination in
 * `a` itself would do so for a * inverse. No solver does both (Higham, section 14.3). */
static bool inverse_general(Mat4 a, Mat4 *inverse)
{
    Scaled s = scale_by_powers_of_two(mat4_transpose(a), 4);
    for (int i = 0; i < 4; i++)
        s.b[i][4 + i] = 1;
    if (eliminate(s.b, 8) == 0)
        return false;
    for (int i = 3; i >= 0; i--)
        for (int k = 0; k < 4; k++) {
            double x = s.b[i][4 + k];
            for (int j = i + 1; j < 4; j++)
                x -= s.b[i][j] * s.b[j][4 + k];
            s.b[i][4 + k] = x / s.b[i][i];
            inverse->m[4 * i + k] = ldexp(s.b[i][4 + k], -(s.row[k] + s.column[i]));
        }
    return true;
}

static bool inverse_affine(Mat4 a, Mat4 *inverse)
{
    Scaled s = scale_by_powers_of_two(a, 3);
    double cofactor[3][3];
    double determinant = cofactors(s.b, cofactor);
    if (determinant == 0)
        return false;
    *inverse = mat4_identity();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse->m[4 * i + j] = ldexp(cofactor[i][j] / determinant, -(s.row[i] + s.column[j]));
    Vec3 t = mat4_transform_direction(*inverse, (Vec3){a.m[12], a.m[13], a.m[14]});
    inverse->m[12] = -t.x;
    inverse->m[13] = -t.y;
    inverse->m[14] = -t.z;
    return true;
}

bool mat4_inverse(Mat4 a, Mat4 *inverse)
{
    Mat4 result;
    const bool done = mat4_is_finite(a) &&
                      (is_affine(&a) ? inverse_affine : inverse_general)(a, &result) &&
                      mat4_is_finite(result);
    *inverse = done ? result : mat4_identity();
    return done;
}

bool mat4_try_normal(Mat4 a, Mat4 *normal_matrix)
{
    *normal_matrix = mat4_scale((Vec3){0, 0, 0});
    if (!mat4_is_finite(a))
        return false;
    Scaled s = scale_by_powers_of_two(a, 3);
    double cofactor[3][3];
    double determinant = cofactors(s.b, cofactor);
    double sign = signed_determinant(determinant, cofactor) < 0 ? -1 : 1;
    int largest = EXPONENT_OF_ZERO / 2;
    double squares = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (exponent_of(cofactor[i][j]) - s.row[i] - s.column[j] > largest)
                largest = exponent_of(cofactor[i][j]) - s.row[i] - s.column[j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int exponent = -s.row[i] - s.column[j] - largest;
            const double entry = ldexp(sign * cofactor[i][j], exponent);
            normal_matrix->m[4 * j + i] = entry;
            squares += entry * entry;
        }
    const double length = sqrt(squares / 3);
    for (int k = 0; k < 12 && squares > 0; k++)
        normal_matrix->m[k] /= length;
    return largest != EXPONENT_OF_ZERO / 2;
}

Mat4 mat4_normal(Mat4 a)
{
    Mat4 normal_matrix;
    mat4_try_normal(a, &normal_matrix);
    return normal_matrix;
}
