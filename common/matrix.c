#include "matrix.h"

#include <math.h>

static const double RADIANS_PER_DEGREE = 0.017453292519943295769;

/*
 * Differences of products, with at most two units in the last place lost where a * b and c * d
 * nearly cancel, and exactly 0 where they are equal (Kahan; Jeannerod, Louvet and Muller, Further
 * analysis of Kahan's algorithm, Math. Comp. 82, 2013). fma() is spelled out and the only plain
 * product stands alone, so that a compiler that contracts expressions has nothing to change.
 */
static double difference_of_products(double a, double b, double c, double d)
{
    double cd = c * d;
    double cd_lost = fma(c, d, -cd);
    return fma(a, b, -cd) - cd_lost;
}

/* Vectors */

static bool vec3_is_finite(Vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* A finite `a` divided by the power of two that brings its largest component into [0.5, 1): exact,
 * but for components too small to matter beside the largest. */
static Vec3 vec3_scaled(Vec3 a, int *exponent)
{
    frexp(fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z)), exponent);
    return (Vec3){ldexp(a.x, -*exponent), ldexp(a.y, -*exponent), ldexp(a.z, -*exponent)};
}

double vec3_dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vec3 vec3_add(Vec3 a, Vec3 b)
{
    return (Vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

Vec3 vec3_subtract(Vec3 a, Vec3 b)
{
    return (Vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

Vec3 vec3_scale(Vec3 a, double factor)
{
    return (Vec3){a.x * factor, a.y * factor, a.z * factor};
}

Vec3 vec3_cross(Vec3 a, Vec3 b)
{
    return (Vec3){difference_of_products(a.y, b.z, a.z, b.y),
                  difference_of_products(a.z, b.x, a.x, b.z),
                  difference_of_products(a.x, b.y, a.y, b.x)};
}

double vec3_length(Vec3 a)
{
    if (!vec3_is_finite(a))
        return fabs(a.x) + fabs(a.y) + fabs(a.z);
    int exponent;
    Vec3 scaled = vec3_scaled(a, &exponent);
    return ldexp(sqrt(vec3_dot(scaled, scaled)), exponent);
}

bool vec3_normalize(Vec3 a, Vec3 *unit)
{
    *unit = (Vec3){0, 0, 0};
    if (!vec3_is_finite(a) || (a.x == 0 && a.y == 0 && a.z == 0))
        return false;
    int exponent;
    Vec3 scaled = vec3_scaled(a, &exponent);
    double length = sqrt(vec3_dot(scaled, scaled));
    *unit = (Vec3){scaled.x / length, scaled.y / length, scaled.z / length};
    return true;
}

/* Matrices that cannot fail */

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

static bool mat4_is_finite(const Mat4 *a)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(a->m[i]))
            return false;
    return true;
}

/* How the functions below end: with their result, or with the identity where it overflowed. */
static bool finite_or_identity(Mat4 candidate, Mat4 *result)
{
    bool finite = mat4_is_finite(&candidate);
    *result = finite ? candidate : mat4_identity();
    return finite;
}

bool mat4_rotate(double degrees, Vec3 axis, Mat4 *rotation)
{
    *rotation = mat4_identity();
    Vec3 u;
    if (!isfinite(degrees) || !vec3_normalize(axis, &u))
        return false;

    /* Both steps are exact: a remainder is, and so is the difference of nearby numbers. */
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

static Vec3 axis_least_along(Vec3 a)
{
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    if (y <= x && y <= z)
        return (Vec3){0, 1, 0};
    return z <= x ? (Vec3){0, 0, 1} : (Vec3){1, 0, 0};
}

bool mat4_look_at(Vec3 eye, Vec3 center, Vec3 up, Mat4 *eye_from_world)
{
    *eye_from_world = mat4_identity();
    if (!vec3_is_finite(eye) || !vec3_is_finite(center) || !vec3_is_finite(up))
        return false;

    Vec3 view = vec3_subtract(center, eye);
    if (!vec3_is_finite(view))
        view = vec3_subtract(vec3_scale(center, 0.5), vec3_scale(eye, 0.5));
    Vec3 forward;
    bool determined = vec3_normalize(view, &forward);
    if (!determined)
        view = forward = (Vec3){0, 0, -1};

    /* The cross product of what was given, not of unit vectors: their rounding would hide that an
     * `up` is parallel. Powers of two do not round. */
    int exponent;
    Vec3 side, upward;
    Vec3 cross = vec3_cross(vec3_scaled(view, &exponent), vec3_scaled(up, &exponent));
    if (!vec3_normalize(cross, &side)) {
        determined = false;
        vec3_normalize(vec3_cross(forward, axis_least_along(forward)), &side);
    }
    vec3_normalize(vec3_cross(side, forward), &upward);

    Vec3 e = vec3_scaled(eye, &exponent);
    Mat4 result = {{side.x, upward.x, -forward.x, 0, //
                    side.y, upward.y, -forward.y, 0, //
                    side.z, upward.z, -forward.z, 0, //
                    -ldexp(vec3_dot(side, e), exponent), -ldexp(vec3_dot(upward, e), exponent),
                    ldexp(vec3_dot(forward, e), exponent), 1}};
    return finite_or_identity(result, eye_from_world) && determined;
}

/* The third row of a perspective projection, in quotients that cannot overflow. */
static void set_depth(double near, double far, Mat4 *clip_from_eye)
{
    double ratio = near / far;
    double range = isinf(far) ? 1 : (far - near) / far;
    clip_from_eye->m[10] = -(1 + ratio) / range;
    clip_from_eye->m[14] = -2 * (near / range);
}

bool mat4_perspective(double fovy_degrees, double aspect, double near, double far,
                      Mat4 *clip_from_eye)
{
    *clip_from_eye = mat4_identity();
    if (!(0 < fovy_degrees && fovy_degrees < 180 && 0 < aspect && isfinite(aspect) && 0 < near &&
          near < far))
        return false;

    /* The cotangent of half the angle, from the smaller of it and its complement: wide angles keep
     * their digits too. */
    double half = 0.5 * fovy_degrees;
    double cotangent =
        half < 45 ? 1 / tan(half * RADIANS_PER_DEGREE) : tan((90 - half) * RADIANS_PER_DEGREE);
    Mat4 result = {{cotangent / aspect, 0, 0, 0, 0, cotangent, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}};
    set_depth(near, far, &result);
    return finite_or_identity(result, clip_from_eye);
}

/* The interval from a to b is |x - middle| <= |radius|. Halved first: the sums may overflow. */
static double middle(double a, double b)
{
    return 0.5 * b + 0.5 * a;
}

static double radius(double a, double b)
{
    return 0.5 * b - 0.5 * a;
}

/* Here and in mat4_ortho an empty interval or an infinite end makes a coefficient that is not
 * finite, and is refused for that. */
bool mat4_frustum(double left, double right, double bottom, double top, double near, double far,
                  Mat4 *clip_from_eye)
{
    *clip_from_eye = mat4_identity();
    if (!(0 < near && near < far))
        return false;
    double width = radius(left, right), height = radius(bottom, top);
    Mat4 result = {{near / width, 0, 0, 0, 0, near / height, 0, 0, //
                    middle(left, right) / width, middle(bottom, top) / height, 0, -1}};
    set_depth(near, far, &result);
    return finite_or_identity(result, clip_from_eye);
}

bool mat4_ortho(double left, double right, double bottom, double top, double near, double far,
                Mat4 *clip_from_eye)
{
    double width = radius(left, right), height = radius(bottom, top), depth = radius(near, far);
    Mat4 result = mat4_scale((Vec3){1 / width, 1 / height, -1 / depth});
    result.m[12] = -middle(left, right) / width;
    result.m[13] = -middle(bottom, top) / height;
    result.m[14] = -middle(near, far) / depth;
    return finite_or_identity(result, clip_from_eye);
}

/* What a matrix does */

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

/*
 * Determinant, inverse and normals
 *
 * All three work on B, where A(i, j) = B(i, j) * 2^(row[i] + column[j]) and the largest entry of
 * each row and column of B, unless all of it is 0, is in [0.5, 1). That rounds nothing, keeps the
 * products below from overflow and underflow, and A's inverse and cofactors are B's times
 * 2^-(row[i] + column[j]), the cofactors up to one common factor.
 */
typedef struct Scaled {
    double b[4][8]; /* b[row][column]; to the right of B there is room for the identity */
    int row[4], column[4];
} Scaled;

/* The binary exponent; of 0 one that is less than any sum of others. */
enum { EXPONENT_OF_ZERO = -100000 };

static int exponent_of(double x)
{
    int exponent;
    frexp(x, &exponent);
    return x == 0 ? EXPONENT_OF_ZERO : exponent;
}

/* The upper left n x n part of a finite `a`. The exponents are settled before anything is scaled,
 * so that a tiny factor of a row and a huge one of a column cannot meet in an underflow. */
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
 * digits, so what error the inverse has comes mostly from the determinant, where it is at most
 * 5 * 1.1e-16 * condition, and is a common factor of all entries. */
static double cofactors(double b[4][8], double cofactor[3][3])
{
    for (int i = 0; i < 3; i++) {
        const double *p = b[(i + 1) % 3], *q = b[(i + 2) % 3];
        for (int j = 0; j < 3; j++) {
            int k = (j + 1) % 3, l = (j + 2) % 3;
            cofactor[i][j] = difference_of_products(p[k], q[l], p[l], q[k]);
        }
    }
    return b[0][0] * cofactor[0][0] + b[0][1] * cofactor[0][1] + b[0][2] * cofactor[0][2];
}

/* The determinant that cofactors() returned, or 0 where the matrix is singular but for rounding, so
 * that its sign is none. An entry of a product of matrices is off by a few units of 1.1e-16 of its
 * terms, and moves the determinant by that times its cofactor. The terms exceed 1, the largest of
 * row and column here, only where a row cancels: of flattened models turned at random 1 in 10,000
 * is off by more than 16 such units, and 1 in millions by more than 256. */
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
    if (!mat4_is_finite(&a))
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

/* Eliminates in the transpose, so solves for the inverse row by row. That makes inverse * a, which
 * takes a vector there and back, as close to the identity as condition * 1.1e-16; elimination in
 * `a` itself would do that for a * inverse. No solver does it for both (Higham, section 14.3). */
static bool inverse_general(Mat4 a, Mat4 *inverse)
{
    Scaled s = scale_by_powers_of_two(mat4_transpose(a), 4);
    for (int i = 0; i < 4; i++)
        s.b[i][4 + i] = 1;
    if (eliminate(s.b, 8) == 0)
        return false;
    for (int i = 3; i >= 0; i--) {
        for (int k = 0; k < 4; k++) {
            double x = s.b[i][4 + k];
            for (int j = i + 1; j < 4; j++)
                x -= s.b[i][j] * s.b[j][4 + k];
            s.b[i][4 + k] = x / s.b[i][i];
            inverse->m[4 * i + k] = ldexp(s.b[i][4 + k], -(s.row[k] + s.column[i]));
        }
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
    *inverse = mat4_identity();
    return mat4_is_finite(&a) && (is_affine(&a) ? inverse_affine : inverse_general)(a, &result) &&
           finite_or_identity(result, inverse);
}

bool mat4_normal(Mat4 a, Mat4 *normal_matrix)
{
    *normal_matrix = mat4_scale((Vec3){0, 0, 0});
    if (!mat4_is_finite(&a))
        return false;
    Scaled s = scale_by_powers_of_two(a, 3);
    double cofactor[3][3];
    double determinant = cofactors(s.b, cofactor);
    double sign = signed_determinant(determinant, cofactor) < 0 ? -1 : 1;
    int largest = EXPONENT_OF_ZERO / 2;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (exponent_of(cofactor[i][j]) - s.row[i] - s.column[j] > largest)
                largest = exponent_of(cofactor[i][j]) - s.row[i] - s.column[j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            normal_matrix->m[4 * j + i] =
                ldexp(sign * cofactor[i][j], -s.row[i] - s.column[j] - largest);
    return largest != EXPONENT_OF_ZERO / 2;
}

void mat4_to_float(Mat4 a, float out[16])
{
    for (int i = 0; i < 16; i++)
        out[i] = (float)a.m[i];
}

void vec3_to_float(Vec3 a, float out[3])
{
    out[0] = (float)a.x;
    out[1] = (float)a.y;
    out[2] = (float)a.z;
}

Vec3 vec3_from_float(const float v[3])
{
    return (Vec3){(double)v[0], (double)v[1], (double)v[2]};
}
