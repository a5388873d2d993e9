#include "study/cases/hard_case.h"

#include "study/measure/setting_picture.h"

#include <math.h>

Mat4 naive_inverse_transpose(Mat4 eye_from_object)
{
    Mat4 inverse;
    mat4_inverse(eye_from_object, &inverse); /* on failure, the identity */
    return mat4_transpose(inverse);
}

static Mat4 of_columns(const Vec3 columns[3])
{
    Mat4 m = mat4_identity();
    for (int i = 0; i < 3; i++) {
        m.m[4 * i] = columns[i].x;
        m.m[4 * i + 1] = columns[i].y;
        m.m[4 * i + 2] = columns[i].z;
    }
    return m;
}

Mat4 naive_cofactors(Mat4 eye_from_object)
{
    const double *m = eye_from_object.m;
    const Vec3 a = {m[0], m[1], m[2]}, b = {m[4], m[5], m[6]}, c = {m[8], m[9], m[10]};
    return of_columns((const Vec3[3]){vec3_cross(b, c), vec3_cross(c, a), vec3_cross(a, b)});
}

typedef struct Float3 {
    float x, y, z;
} Float3;

static Float3 float_cross(Float3 a, Float3 b)
{
    return (Float3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static float float_dot(Float3 a, Float3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static Float3 float_unit(Float3 a)
{
    const float length = sqrtf(float_dot(a, a));
    return (Float3){a.x / length, a.y / length, a.z / length};
}

static Float3 to_floats(Vec3 a)
{
    return (Float3){(float)a.x, (float)a.y, (float)a.z};
}

static Vec3 of_floats(Float3 a)
{
    return (Vec3){(double)a.x, (double)a.y, (double)a.z};
}

Mat4 naive_float_inverse_transpose(Mat4 eye_from_object)
{
    const double *m = eye_from_object.m;
    const Float3 a = to_floats((Vec3){m[0], m[1], m[2]}), b = to_floats((Vec3){m[4], m[5], m[6]});
    const Float3 c = to_floats((Vec3){m[8], m[9], m[10]});
    const Float3 cofactors[3] = {float_cross(b, c), float_cross(c, a), float_cross(a, b)};
    const float determinant = float_dot(a, cofactors[0]);
    Vec3 columns[3];
    for (int i = 0; i < 3; i++)
        columns[i] = of_floats((Float3){cofactors[i].x / determinant, cofactors[i].y / determinant,
                                        cofactors[i].z / determinant});
    return of_columns(columns);
}

static Mat4 float_look_at(const Camera *camera)
{
    const Float3 eye = to_floats(camera->eye), center = to_floats(camera->center);
    const Float3 f = float_unit((Float3){center.x - eye.x, center.y - eye.y, center.z - eye.z});
    const Float3 s = float_unit(float_cross(f, float_unit(to_floats(camera->up))));
    const Float3 u = float_cross(s, f);
    Mat4 m = of_columns((const Vec3[3]){of_floats((Float3){s.x, u.x, -f.x}),
                                        of_floats((Float3){s.y, u.y, -f.y}),
                                        of_floats((Float3){s.z, u.z, -f.z})});
    m.m[12] = -(double)float_dot(s, eye);
    m.m[13] = -(double)float_dot(u, eye);
    m.m[14] = (double)float_dot(f, eye);
    return m;
}

static Mat4 look_at_eye_from_object(const Camera *camera, Mat4 eye_from_world,
                                    Mat4 world_from_object)
{
    (void)eye_from_world;
    return mat4_product(float_look_at(camera), world_from_object);
}

static Vec3 look_at_eye_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world)
{
    (void)eye_from_world;
    return mat4_transform_point(float_look_at(camera), point_world);
}

const LightingTransforms *naive_float_look_at(void)
{
    static const LightingTransforms transforms = {
        .eye_from_object = look_at_eye_from_object,
        .eye_point = look_at_eye_point,
    };
    return &transforms;
}

const LightingTransforms *naive_float_lecture(void)
{
    Quality quality = quality_with(quality_usual(), AXIS_MATRICES, MATRICES_FLOAT);
    quality = quality_with(quality, AXIS_ORDER, ORDER_LECTURE);
    return transforms_of(&quality);
}
