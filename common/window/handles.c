/*
 * Dragging a light. A point of the picture is a ray from the eye; where the light goes on it is our
 * choice. A light with a position keeps its depth, so that it follows the pointer in a plane
 * parallel to the picture. A directional light keeps its distance from the origin, where its point
 * is drawn: the ray meets that sphere twice, or not at all, and of two points the one near the old
 * is taken. What is found is rounded to the power of ten below a pixel's size: --light-position
 * then has few digits.
 */
#include "window/handles.h"

#include <math.h>

/* Of eye coordinates at depth 1, per half of the picture's height. */
typedef struct Lens {
    Mat4 eye_from_world;
    double x, y;
} Lens;

static bool lens_of(const Camera *camera, const int place[4], Lens *lens)
{
    const double aspect = (double)place[2] / place[3];
    Mat4 clip_from_eye;
    if (!scene_camera(camera, aspect, &lens->eye_from_world, &clip_from_eye, NULL))
        return false;
    lens->x = 1 / clip_from_eye.m[0];
    lens->y = 1 / clip_from_eye.m[5];
    return true;
}

static bool has_handle(const Scene *scene, int light)
{
    return light >= 0 && light < scene->light_count && scene->lights[light].space == LIGHT_WORLD;
}

static Vec3 place_of(const Light *light)
{
    return light->kind == LIGHT_DIRECTIONAL ? light->direction : light->position;
}

int handles_add(Handle handles[HANDLES_MAX], int count, const Scene *scene, int view,
                const int place[4])
{
    Lens lens;
    if (!lens_of(&scene->camera, place, &lens))
        return count;
    for (int i = 0; i < scene->light_count && count < HANDLES_MAX; i++) {
        const Vec3 eye =
            scene_eye_point(&scene->camera, lens.eye_from_world, place_of(&scene->lights[i]));
        const double x = eye.x / (-eye.z * lens.x), y = eye.y / (-eye.z * lens.y);
        if (!has_handle(scene, i) || !(eye.z < 0 && fabs(x) <= 1 && fabs(y) <= 1))
            continue;
        handles[count++] = (Handle){.view = view,
                                    .light = i,
                                    .x = place[0] + (1 + x) / 2 * place[2],
                                    .y = place[1] + (1 - y) / 2 * place[3]};
    }
    return count;
}

void handles_ring(const Camera *camera, const int place[4], Sphere sphere, float ring[3])
{
    Lens lens;
    if (!lens_of(camera, place, &lens))
        return;
    const Vec3 eye = scene_eye_point(camera, lens.eye_from_world, sphere.center);
    const double scale = place[3] / (-2 * eye.z * lens.y); /* the pixels are square */
    ring[0] = (float)(place[0] + place[2] / 2.0 + scale * eye.x);
    ring[1] = (float)(place[1] + place[3] / 2.0 - scale * eye.y);
    ring[2] = (float)(scale * sphere.radius);
}

const Handle *handles_find(const Handle *handles, int count, double x, double y, double reach)
{
    const Handle *nearest = NULL;
    for (int i = 0; i < count; i++) {
        const double apart = hypot(handles[i].x - x, handles[i].y - y);
        if (apart <= reach) {
            nearest = &handles[i];
            reach = apart;
        }
    }
    return nearest;
}

/* Where a ray from the eye is as far from the origin as `before`, on the same side of the origin;
 * where it is nowhere so near, towards the nearest point of it. */
static Vec3 turn(Vec3 eye, Vec3 ray, Vec3 before)
{
    const double radius = vec3_length(before), nearest = -vec3_dot(eye, ray) / vec3_dot(ray, ray);
    const Vec3 middle = vec3_add(eye, vec3_scale(ray, nearest));
    const double rest = radius * radius - vec3_dot(middle, middle);
    if (rest <= 0)
        return vec3_scale(middle, radius / vec3_length(middle));
    const Vec3 half = vec3_scale(ray, sqrt(rest / vec3_dot(ray, ray)));
    const Vec3 far = vec3_add(middle, half), near = vec3_subtract(middle, half);
    return vec3_length(vec3_subtract(far, before)) < vec3_length(vec3_subtract(near, before))
               ? far
               : near;
}

/* To the power of ten below `size`. */
static double rounded(double value, double size)
{
    const double parts = pow(10, -floor(log10(size)));
    return parts >= 1 ? round(value * parts) / parts + 0.0 : value;
}

bool handle_drag(const Scene *scene, const int place[4], int light, double x, double y, Vec3 *at)
{
    const Camera *camera = &scene->camera;
    Lens lens;
    if (!has_handle(scene, light) || !lens_of(camera, place, &lens))
        return false;
    const Vec3 before = place_of(&scene->lights[light]);
    const double depth = -scene_eye_point(camera, lens.eye_from_world, before).z;
    const double right = 2 * (x - place[0]) / place[2] - 1, up = 1 - 2 * (y - place[1]) / place[3];
    const Vec3 ray = mat4_transform_direction(mat4_transpose(lens.eye_from_world),
                                              (Vec3){right * lens.x, up * lens.y, -1});
    const double pixel = 2 * depth * lens.y / place[3];
    *at = scene->lights[light].kind == LIGHT_DIRECTIONAL
              ? turn(camera->eye, ray, before)
              : vec3_add(camera->eye, vec3_scale(ray, depth));
    if (!(pixel > 0))
        return false;
    *at = (Vec3){rounded(at->x, pixel), rounded(at->y, pixel), rounded(at->z, pixel)};
    return isfinite(at->x) && isfinite(at->y) && isfinite(at->z);
}
