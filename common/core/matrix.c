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
