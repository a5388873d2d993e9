#include "study/measure/setting_picture.h"

#include <math.h>

typedef Mat4 (*Product)(Mat4 a, Mat4 b);

static Mat4 rounded(Mat4 a)
{
    for (int i = 0; i < 16; i++)
        a.m[i] = (double)(float)a.m[i];
    return a;
}

static Mat4 float_product(Mat4 a, Mat4 b)
{
    Mat4 c;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++)
                sum += (float)a.m[4 * k + row] * (float)b.m[4 * column + k];
            c.m[4 * column + row] = (double)sum;
        }
    return c;
}

/* Dot2 of the paper: `sum` + `error` has twice the precision of a float. */
static Mat4 compensated_product(Mat4 a, Mat4 b)
{
    Mat4 c;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            float sum = 0, error = 0;
            for (int k = 0; k < 4; k++) {
                const float x = (float)a.m[4 * k + row], y = (float)b.m[4 * column + k];
                const float product = x * y, below = fmaf(x, y, -product);
                const float next = sum + product, part = next - sum;
                error += (sum - (next - part)) + (product - part) + below;
                sum = next;
            }
            c.m[4 * column + row] = (double)(sum + error);
        }
    return c;
}

static Mat4 without_translation(Mat4 a)
{
    a.m[12] = a.m[13] = a.m[14] = 0;
    return a;
}

static Mat4 translation(Vec3 offset)
{
    return mat4_translate(offset);
}

/* Operands are rounded to single precision before they are subtracted. */
static Vec3 float_difference(Vec3 a, Vec3 b)
{
    return (Vec3){(double)((float)a.x - (float)b.x), (double)((float)a.y - (float)b.y),
                  (double)((float)a.z - (float)b.z)};
}

/* Relative to the eye, in single precision. */
static Mat4 eye_from_object_near(Product product, const Camera *camera, Mat4 eye_from_world,
                                 Mat4 world_from_object)
{
    const double *m = world_from_object.m;
    const Vec3 offset = float_difference((Vec3){m[12], m[13], m[14]}, camera->eye);
    Mat4 relative = rounded(world_from_object);
    relative.m[12] = offset.x;
    relative.m[13] = offset.y;
    relative.m[14] = offset.z;
    return product(rounded(without_translation(eye_from_world)), relative);
}

static Vec3 eye_point_near(Product product, const Camera *camera, Mat4 eye_from_world, Vec3 point)
{
    const Mat4 moved = product(rounded(without_translation(eye_from_world)),
                               translation(float_difference(point, camera->eye)));
    return (Vec3){moved.m[12], moved.m[13], moved.m[14]};
}

static Vec3 translation_of(Mat4 a)
{
    return (Vec3){a.m[12], a.m[13], a.m[14]};
}

/* The functions of one arithmetic: its name, its product, and how it rounds its inputs. */
#define ARITHMETIC(NAME, PRODUCT, ROUND)                                                           \
    static Mat4 NAME##_eye_from_object(const Camera *camera, Mat4 eye_from_world,                  \
                                       Mat4 world_from_object)                                     \
    {                                                                                              \
        return eye_from_object_near(PRODUCT, camera, eye_from_world, world_from_object);           \
    }                                                                                              \
    static Vec3 NAME##_eye_point(const Camera *camera, Mat4 eye_from_world, Vec3 point)            \
    {                                                                                              \
        return eye_point_near(PRODUCT, camera, eye_from_world, point);                             \
    }                                                                                              \
    static Mat4 NAME##_clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world,                   \
                                        Mat4 world_from_object, Mat4 eye_from_object)              \
    {                                                                                              \
        (void)eye_from_world, (void)world_from_object;                                             \
        return PRODUCT(ROUND(clip_from_eye), eye_from_object);                                     \
    }                                                                                              \
    LECTURE(NAME, PRODUCT, ROUND)

#define LECTURE(NAME, PRODUCT, ROUND)                                                              \
    static Mat4 NAME##_lecture_eye_from_object(const Camera *camera, Mat4 eye_from_world,          \
                                               Mat4 world_from_object)                             \
    {                                                                                              \
        (void)camera;                                                                              \
        return PRODUCT(ROUND(eye_from_world), ROUND(world_from_object));                           \
    }                                                                                              \
    static Vec3 NAME##_lecture_eye_point(const Camera *camera, Mat4 eye_from_world, Vec3 point)    \
    {                                                                                              \
        (void)camera;                                                                              \
        return translation_of(PRODUCT(ROUND(eye_from_world), ROUND(translation(point))));          \
    }                                                                                              \
    static Mat4 NAME##_lecture_clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world,           \
                                                Mat4 world_from_object, Mat4 eye_from_object)      \
    {                                                                                              \
        (void)eye_from_object;                                                                     \
        return PRODUCT(PRODUCT(ROUND(clip_from_eye), ROUND(eye_from_world)),                       \
                       ROUND(world_from_object));                                                  \
    }

static Mat4 as_it_is(Mat4 a)
{
    return a;
}

LECTURE(double, mat4_product, as_it_is)
ARITHMETIC(float, float_product, rounded)
ARITHMETIC(compensated, compensated_product, rounded)

#define TRANSFORMS(NAME)                                                                           \
    {                                                                                              \
        NAME##_eye_from_object, NAME##_eye_point, NAME##_clip_from_object                          \
    }

const LightingTransforms *transforms_of(const Quality *quality)
{
    static const LightingTransforms ALL[3][2] = {
        [MATRICES_DOUBLE] = {{NULL, NULL, NULL}, TRANSFORMS(double_lecture)},
        [MATRICES_FLOAT] = {TRANSFORMS(float), TRANSFORMS(float_lecture)},
        [MATRICES_COMPENSATED] = {TRANSFORMS(compensated), TRANSFORMS(compensated_lecture)},
    };
    const LightingTransforms *found =
        &ALL[quality->choice[AXIS_MATRICES]][quality->choice[AXIS_ORDER]];
    return found->eye_point ? found : NULL; /* NULL: lighting's own */
}
