/*
 * Vectors, and the camera's axes: no step overflows, underflows or cancels where the result need
 * not; lengths by scaling, cross products by Kahan's difference of products.
 */
#define MATRIX_INLINE /* here they are functions */
#include "core/matrix_vectors.h"

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

Vec3 vec3_cross(Vec3 a, Vec3 b)
{
    return (Vec3){difference_of_products(a.y, b.z, a.z, b.y),
                  difference_of_products(a.z, b.x, a.x, b.z),
                  difference_of_products(a.x, b.y, a.y, b.x)};
}

double matrix_any_length(Vec3 a)
{
    if (!vec3_is_finite(a))
        return fabs(a.x) + fabs(a.y) + fabs(a.z);
    int exponent;
    Vec3 scaled = vec3_scaled(a, &exponent);
    const double length = sqrt(vec3_dot(scaled, scaled));
    return exponent ? ldexp(length, exponent) : length;
}

bool matrix_any_normalize(Vec3 a, Vec3 *unit)
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
    if (!mat4_is_finite(result))
        return false;
    *eye_from_world = result;
    return determined;
}

Mat4 mat4_look_at(Vec3 eye, Vec3 center, Vec3 up)
{
    Mat4 eye_from_world;
    mat4_try_look_at(eye, center, up, &eye_from_world);
    return eye_from_world;
}
