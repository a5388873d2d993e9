/*
 * Vectors and matrices from their definitions, arranged so that no step overflows, underflows or
 * cancels where the result need not: lengths by scaling, cross products by Kahan's difference of
 * products, rotations with angles reduced in degrees, where quarters of a turn are exact.
 */
#include "core/matrix.h"

#include <math.h>

static const double RADIANS_PER_DEGREE = 0.017453292519943295769;

/* a * b - c * d with an error of at most two units in the last place, exactly 0 if the products are
 * equal (Kahan; Jeannerod, Louvet and Muller, Further analysis of Kahan's algorithm, Math. Comp.
 * 82, 2013). fma() is explicit and the only plain product stands alone, so that a compiler that
 * contracts expressions changes nothing. */
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

/* A finite `a` divided by the power of two that brings its largest component into [0.5, 1), unless
 * its squares are in range: exact except for components that are negligible beside the largest. */
static Vec3 vec3_scaled(Vec3 a, int *exponent)
{
    const double largest = fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z));
    *exponent = 0;
    if (largest > 0x1p-200 && largest < 0x1p200)
        return a;
    frexp(largest, exponent);
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
    const double length = sqrt(vec3_dot(scaled, scaled));
    return exponent ? ldexp(length, exponent) : length;
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

Vec3 vec3_unit(Vec3 a)
{
    Vec3 unit;
    vec3_normalize(a, &unit);
    return unit;
}

/* Matrices */

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

static Vec3 axis_least_along(Vec3 a)
{
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    if (y <= x && y <= z)
        return (Vec3){0, 1, 0};
    return z <= x ? (Vec3){0, 0, 1} : (Vec3){1, 0, 0};
}

bool mat4_try_look_at(Vec3 eye, Vec3 center, Vec3 up, Mat4 *eye_from_world)
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

    /* The cross product of the arguments, not of unit vectors: their rounding would hide a parallel
     * `up`. Scaling by powers of two does not round. */
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

Mat4 mat4_look_at(Vec3 eye, Vec3 center, Vec3 up)
{
    Mat4 eye_from_world;
    mat4_try_look_at(eye, center, up, &eye_from_world);
    return eye_from_world;
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
