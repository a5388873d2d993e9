#include "diagrams/optics.h"

#include "reference/reference_shade.h"

#include <math.h>

static const Vec3 UP = {0, 1, 0}, Z = {0, 0, 1};

Vec3 optics_left(double degrees)
{
    return mat4_transform_direction(mat4_rotate(degrees, Z), UP);
}

Vec3 optics_right(double degrees)
{
    return optics_left(-degrees);
}

Vec3 optics_light_place(const Optics *optics)
{
    return vec3_scale(optics_left(optics->light), OPTICS_LIGHT_DISTANCE);
}

Vec3 optics_eye_place(const Optics *optics)
{
    static const double NEAREST = 1.4, FARTHEST = 1.85, SIDE_BY_SIDE = 0.7;
    const Vec3 towards = optics_right(optics->eye);
    const double apart = vec3_length(vec3_subtract(towards, optics_left(optics->light)));
    const double share = fmax(0, 1 - apart / SIDE_BY_SIDE);
    return vec3_scale(towards, NEAREST + share * (FARTHEST - NEAREST));
}

OpticsVectors optics_vectors(const Optics *optics, Vec3 point, Vec3 normal)
{
    OpticsVectors all = {.n = normal};
    const bool near = optics->radiating;
    all.l = near ? vec3_unit(vec3_subtract(optics_light_place(optics), point))
                 : optics_left(optics->light);
    all.v = near ? vec3_unit(vec3_subtract(optics_eye_place(optics), point))
                 : optics_right(optics->eye);
    all.n_dot_l = vec3_dot(normal, all.l);
    all.r = vec3_subtract(vec3_scale(normal, 2 * all.n_dot_l), all.l);
    all.h = vec3_unit(vec3_add(all.l, all.v));
    all.r_dot_v = vec3_dot(all.r, all.v);
    all.n_dot_h = vec3_dot(normal, all.h);
    const double cosine = optics->reflection == REFLECTION_PHONG ? all.r_dot_v : all.n_dot_h;
    all.highlight = all.n_dot_l > 0 ? pow(fmax(cosine, 0), optics->shininess) : 0;
    return all;
}

double optics_lobe(const Optics *optics, double eye)
{
    Optics moved = *optics;
    moved.eye = eye;
    moved.radiating = false;
    return optics_vectors(&moved, (Vec3){0, 0, 0}, UP).highlight;
}

double optics_half_angle(const Optics *optics)
{
    const double cosine = pow(0.5, 1 / optics->shininess); /* 0 for shininess 0 */
    const double degrees = acos(cosine) * 180 / REAL_PI;
    if (optics->shininess == 0)
        return 180;
    /* H turns half as far as V. */
    return optics->reflection == REFLECTION_PHONG ? degrees : 2 * degrees;
}

Vec3 optics_color(const Optics *optics, Vec3 point, Vec3 normal)
{
    const Vec3 white = {1, 1, 1}, eye = optics_eye_place(optics);
    const Light light = {.kind = optics->radiating ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                         .diffuse = white,
                         .specular = white};
    const ShadeLight shade_light = {.light = &light,
                                    .position =
                                        real3(vec3_subtract(optics_light_place(optics), eye)),
                                    .direction = real3(optics_left(optics->light))};
    const Shading shading = {.lights = &shade_light,
                             .light_count = 1,
                             .global_ambient =
                                 real3((Vec3){optics->ambient, optics->ambient, optics->ambient}),
                             .reflection_phong = optics->reflection == REFLECTION_PHONG,
                             .distant_viewer = !optics->radiating,
                             .view = real3(optics_right(optics->eye))};
    Material material = *optics->material;
    ShadeSides sides;
    material.shininess = optics->shininess;
    const ShadePoint lit = {&material, real3(vec3_subtract(point, eye)), real3(normal)};
    return color_within_one(real3_round(shade_point(&shading, &lit, &sides)));
}

Optics optics_matte(const Optics *optics, Material *matte)
{
    Optics made = *optics;
    *matte = *optics->material;
    matte->specular = (Vec3){0, 0, 0};
    made.material = matte;
    return made;
}

double optics_spread(const Optics *optics)
{
    const Vec3 lamp = vec3_scale(optics_left(optics->light), optics->distance);
    const Vec3 a = vec3_add(lamp, (Vec3){0.5, 0, 0}), b = vec3_add(lamp, (Vec3){-0.5, 0, 0});
    return atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b)) * 180 / REAL_PI;
}

static double constant_of(const Optics *optics)
{
    const bool none = optics->constant == 0 && optics->linear == 0 && optics->quadratic == 0;
    return none ? 1 : optics->constant;
}

double optics_attenuation(const Optics *optics, double distance)
{
    return 1 / (constant_of(optics) + distance * (optics->linear + distance * optics->quadratic));
}

double optics_attenuated_to(const Optics *optics, double share)
{
    const double a = optics->quadratic, b = optics->linear, c = 1 / share - constant_of(optics);
    if (c <= 0)
        return 0;
    /* The positive root of a d^2 + b d = c, without cancellation. */
    return 2 * c / (b + sqrt(b * b + 4 * a * c));
}

double optics_footprint(double n_dot_l)
{
    return n_dot_l > 0 ? 1 / n_dot_l : INFINITY;
}
