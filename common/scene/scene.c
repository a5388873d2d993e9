/* Scenes as data: checks, copies, transforms of the camera, and changes that options ask for. */
#include "scene/scene.h"

#include "base/memory.h"
#include "core/mesh_make.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const REFLECTION_NAMES[] = {
    [REFLECTION_BLINN_PHONG] = "blinn-phong", [REFLECTION_PHONG] = "phong", NULL};
const char *const VIEWER_NAMES[] = {"local", "infinite", NULL};
const char *const INTERPOLATION_NAMES[] = {[INTERPOLATION_PHONG] = "phong",
                                           [INTERPOLATION_GOURAUD] = "gouraud",
                                           [INTERPOLATION_FLAT] = "flat",
                                           [INTERPOLATION_CONSTANT] = "constant",
                                           NULL};
const char *const SHADOW_NAMES[] = {[SHADOWS_OFF] = "off",
                                    [SHADOWS_ON] = "on",
                                    [SHADOWS_VOLUMES] = "volumes",
                                    [SHADOWS_MAP] = "map",
                                    NULL};
const char *const SHADOW_FILTER_NAMES[] = {"nearest", "2x2", NULL};
const ShadowSettings SHADOWS_DEFAULT = {.way = SHADOWS_ON, .map_size = 1024, .bias = {1, 1.5, 0}};

/* Each check leaves a message that begins with its subject, "light 2: cutoff". */

/* Squares of distances must fit into a float. */
static const double MAX_POSITION = 1e15;

static bool check_vector(const char *subject, const char *name, Vec3 v, Message *message)
{
    return (fabs(v.x) <= MAX_POSITION && fabs(v.y) <= MAX_POSITION && fabs(v.z) <= MAX_POSITION) ||
           message_set(message, "%s: %s (%g, %g, %g): must be %g at most", subject, name, v.x, v.y,
                       v.z, MAX_POSITION);
}

static bool check_direction(const char *subject, const char *name, Vec3 v, Message *message)
{
    Vec3 unit;
    return vec3_normalize(v, &unit) ||
           message_set(message, "%s: %s (%g, %g, %g): must be finite and not zero", subject, name,
                       v.x, v.y, v.z);
}

static bool check_range(const char *subject, const char *name, double value, double min, double max,
                        Message *message)
{
    return (value >= min && value <= max) ||
           message_set(message, "%s: %s %g: must be %g to %g", subject, name, value, min, max);
}

/* Intensities may exceed 1, reflectivities may not; `most` tells which. */
static bool check_color(const char *subject, const char *name, Vec3 c, double max, Message *message)
{
    return check_range(subject, name, c.x, 0, max, message) &&
           check_range(subject, name, c.y, 0, max, message) &&
           check_range(subject, name, c.z, 0, max, message);
}

static const double MAX_INTENSITY = 1e6, MAX_COEFFICIENT = 1e30;

static bool check_light(const Light *light, int number, Message *message)
{
    char subject[32];
    snprintf(subject, sizeof subject, "light %d", number);
    if (!check_range(subject, "kind", light->kind, LIGHT_DIRECTIONAL, LIGHT_SPOT, message) ||
        !check_range(subject, "space", light->space, LIGHT_WORLD, LIGHT_EYE, message) ||
        !check_color(subject, "ambient", light->ambient, MAX_INTENSITY, message) ||
        !check_color(subject, "diffuse", light->diffuse, MAX_INTENSITY, message) ||
        !check_color(subject, "specular", light->specular, MAX_INTENSITY, message))
        return false;
    if (light->kind == LIGHT_DIRECTIONAL)
        return check_direction(subject, "direction", light->direction, message);
    if (!check_vector(subject, "position", light->position, message) ||
        !check_range(subject, "constant", light->constant, 0, MAX_COEFFICIENT, message) ||
        !check_range(subject, "linear", light->linear, 0, MAX_COEFFICIENT, message) ||
        !check_range(subject, "quadratic", light->quadratic, 0, MAX_COEFFICIENT, message) ||
        !check_range(subject, "range", light->range, 0, MAX_POSITION, message))
        return false;
    return light->kind == LIGHT_POINT ||
           (check_direction(subject, "direction", light->direction, message) &&
            check_range(subject, "cutoff", light->cutoff, 0, 90, message) &&
            check_range(subject, "exponent", light->exponent, 0, 128, message));
}

static bool check_material(const char *subject, const Material *material, Message *message)
{
    return check_color(subject, "ambient", material->ambient, 1, message) &&
           check_color(subject, "diffuse", material->diffuse, 1, message) &&
           check_color(subject, "specular", material->specular, 1, message) &&
           check_color(subject, "emission", material->emission, 1, message) &&
           check_range(subject, "alpha", material->alpha, 0, 1, message) &&
           check_range(subject, "shininess", material->shininess, 0, 128, message);
}

static bool check_object(const Object *object, int number, Message *message)
{
    char subject[48];
    snprintf(subject, sizeof subject, "object %d: front", number);
    if (!check_material(subject, &object->front, message))
        return false;
    snprintf(subject, sizeof subject, "object %d: back", number);
    if (object->two_sided && !check_material(subject, &object->back, message))
        return false;
    if (!object->mesh || object->mesh->index_count == 0)
        return message_set(message, "object %d: has no triangles", number);
    const double *m = object->world_from_object.m;
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i]))
            return message_set(message, "object %d: its matrix is not finite", number);
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        return message_set(message,
                           "object %d: its matrix is not affine: the last row must be 0 "
                           "0 0 1",
                           number);
    return true;
}

bool scene_check(const Scene *scene, Message *message)
{
    Mat4 eye_from_world, clip_from_eye;
    if (!scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, message) ||
        !check_color("scene", "background", scene->background, 1, message) ||
        !check_color("scene", "global ambient", scene->global_ambient, MAX_INTENSITY, message) ||
        !check_range("scene", "reflection", scene->reflection, 0, REFLECTION_PHONG, message) ||
        !check_range("scene", "interpolation", scene->interpolation, 0, INTERPOLATION_CONSTANT,
                     message))
        return false;
    if (scene->light_count > SCENE_MAX_LIGHTS)
        return message_set(message, "scene: %d lights: at most %d", scene->light_count,
                           SCENE_MAX_LIGHTS);
    for (int i = 0; i < scene->light_count; i++)
        if (!check_light(&scene->lights[i], i, message))
            return false;
    for (int i = 0; i < scene->object_count; i++)
        if (!check_object(&scene->objects[i], i, message))
            return false;
    return true;
}

bool scene_camera(const Camera *camera, double aspect, Mat4 *eye_from_world, Mat4 *clip_from_eye,
                  Message *message)
{
    if (!check_vector("camera", "eye", camera->eye, message) ||
        !check_vector("camera", "center", camera->center, message) ||
        !check_vector("camera", "up", camera->up, message))
        return false;
    if (!mat4_try_look_at(camera->eye, camera->center, camera->up, eye_from_world))
        return message_set(message,
                           "camera: eye (%g, %g, %g), center (%g, %g, %g), up (%g, %g, %g): eye "
                           "and center must differ, and up must not lie along the view",
                           camera->eye.x, camera->eye.y, camera->eye.z, camera->center.x,
                           camera->center.y, camera->center.z, camera->up.x, camera->up.y,
                           camera->up.z);
    if (!mat4_try_perspective(scene_fovy(camera, aspect), aspect, camera->near, camera->far,
                              clip_from_eye))
        return message_set(message,
                           "camera: fovy %g, aspect %g, near %g, far %g: must be 0 < fovy < 180, "
                           "aspect > 0, 0 < near < far",
                           camera->fovy, aspect, camera->near, camera->far);
    return true;
}

/* The rotation of a rigid transform, without its translation. */
static Mat4 rotation_of(Mat4 m)
{
    m.m[12] = m.m[13] = m.m[14] = 0;
    return m;
}

double scene_fovy(const Camera *camera, double aspect)
{
    static const double RADIANS = 0.017453292519943295;
    if (!(aspect < camera->aspect))
        return camera->fovy;
    return 2 / RADIANS * atan(tan(camera->fovy * RADIANS / 2) * camera->aspect / aspect);
}

bool object_is_convex(const Object *object)
{
    switch (object->solid.kind) {
    case SOLID_QUAD:
    case SOLID_DISC:
        return true;
    case SOLID_SPHERE:
    case SOLID_BOX:
    case SOLID_CONE:
    case SOLID_CYLINDER:
        return object->closed && !object->two_sided; /* else both sides are seen */
    default:
        return false;
    }
}

bool scene_has_shadows(const Scene *scene)
{
    for (int i = 0; i < scene->light_count; i++)
        if (scene->lights[i].shadows && !scene->lights[i].off)
            return true;
    return false;
}

Sphere scene_sphere(const Object *object, const MeshBox *box)
{
    const Mat4 m = object->world_from_object;
    const Vec3 half = vec3_scale(vec3_subtract(box->high, box->low), 0.5);
    Sphere sphere = {.center = mat4_transform_point(m, vec3_add(box->low, half))};
    for (int corner = 0; corner < 4; corner++) { /* the other four lie opposite */
        const Vec3 to_corner = {half.x, corner & 1 ? -half.y : half.y,
                                corner & 2 ? -half.z : half.z};
        sphere.radius = fmax(sphere.radius, vec3_length(mat4_transform_direction(m, to_corner)));
    }
    return sphere;
}

/* The nearest and the farthest corner of an object's box along the view. */
static void depth_of(const Object *object, Mat4 eye_from_object, double *near, double *far)
{
    const double *m = eye_from_object.m;
    const MeshBox box = mesh_bounds(object->mesh);
    const Vec3 half = vec3_scale(vec3_subtract(box.high, box.low), 0.5);
    const double depth = -mat4_transform_point(eye_from_object, vec3_add(box.low, half)).z;
    const double reach = fabs(m[2]) * half.x + fabs(m[6]) * half.y + fabs(m[10]) * half.z;
    *near = depth - reach;
    *far = depth + reach;
}

void scene_fit_depth(Scene *scene)
{
    static const double MARGIN = 0.01, MAX_RATIO = 1e5, AROUND_RATIO = 1e3;
    Camera *camera = &scene->camera;
    Mat4 eye_from_world;
    double near = INFINITY, far = -INFINITY;
    bool around = false; /* the eye is in an object's box: what is seen of it may be anywhere */
    if (!mat4_try_look_at(camera->eye, camera->center, camera->up, &eye_from_world))
        return;
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        double first, last;
        depth_of(object, scene_eye_from_object(camera, eye_from_world, object->world_from_object),
                 &first, &last);
        around |= first <= 0 && last > 0;
        near = first > 0 ? fmin(near, first) : near;
        far = fmax(far, last);
    }
    if (!(far > 0) || !isfinite(far))
        return; /* nothing is before the eye */
    if (far > camera->far) {
        camera->far = far * (1 + MARGIN);
        camera->near = around ? camera->near : fmax(camera->near, near / 2);
    }
    if (around)
        near = fmin(near, camera->far / AROUND_RATIO);
    if (near < camera->near)
        camera->near = fmin(camera->near, fmax(near * (1 - MARGIN), camera->far / MAX_RATIO));
}

Light scene_world_light(const Scene *scene, int number)
{
    Light light = scene->lights[number];
    const Camera *camera = &scene->camera;
    Mat4 eye_from_world;
    if (light.space == LIGHT_WORLD ||
        !mat4_try_look_at(camera->eye, camera->center, camera->up, &eye_from_world))
        return light;
    /* The inverse of a rotation is its transpose. */
    const Mat4 world_from_eye = mat4_transpose(rotation_of(eye_from_world));
    light.space = LIGHT_WORLD;
    light.position =
        vec3_add(camera->eye, mat4_transform_direction(world_from_eye, light.position));
    light.direction = mat4_transform_direction(world_from_eye, light.direction);
    return light;
}

void scene_keep_terms(SceneCopy *copy, SceneTerms terms)
{
    static const Vec3 black = {0, 0, 0}, white = {1, 1, 1};
    Scene *scene = &copy->scene;
    if (terms.left_out & TERM_AMBIENT)
        scene->global_ambient = black;
    for (int i = 0; i < scene->light_count; i++) {
        Light *light = &copy->lights[i];
        light->off |= terms.unlit || (terms.lights_left_out >> (i < 31 ? i : 31) & 1);
        light->ambient = !(terms.left_out & TERM_AMBIENT) ? light->ambient : black;
        light->diffuse = !(terms.left_out & TERM_DIFFUSE) ? light->diffuse : black;
        light->specular = !(terms.left_out & TERM_SPECULAR) ? light->specular : black;
    }
    if (terms.unlit)
        scene->global_ambient = white;
    for (int i = 0; i < scene->object_count; i++) {
        Material *sides[2] = {&copy->objects[i].front, &copy->objects[i].back};
        for (int side = 0; side < 2; side++) {
            if (terms.unlit || terms.left_out & TERM_EMISSION)
                sides[side]->emission = black;
            if (terms.unlit)
                sides[side]->ambient = sides[side]->diffuse;
        }
    }
}

void scene_cast_shadows(SceneCopy *copy, bool shadows)
{
    for (int i = 0; i < copy->scene.light_count; i++)
        copy->lights[i].shadows = shadows && i < SCENE_MAX_CASTING;
}

void scene_place_lights(SceneCopy *copy, const LightPlaces *places)
{
    for (int i = 0; i < copy->scene.light_count && i < SCENE_MAX_PLACED; i++) {
        Light *light = &copy->lights[i];
        Vec3 *at = light->kind == LIGHT_DIRECTIONAL ? &light->direction : &light->position;
        if (!(places->placed >> i & 1))
            continue;
        const Mat4 move = mat4_translate(vec3_subtract(places->at[i], *at));
        *at = places->at[i];
        for (int k = 0; k < copy->scene.object_count; k++)
            if (copy->objects[k].lamp == 1 + i)
                copy->objects[k].world_from_object =
                    mat4_product(move, copy->objects[k].world_from_object);
    }
}

void scene_tint_lights(SceneCopy *copy, const LightTints *tints)
{
    for (int i = 0; i < copy->scene.light_count && i < SCENE_MAX_PLACED; i++) {
        if (!(tints->tinted >> i & 1))
            continue;
        copy->lights[i].diffuse = tints->diffuse[i];
        copy->lights[i].specular = tints->specular[i];
        for (int k = 0; k < copy->scene.object_count && !copy->lights[i].off; k++)
            if (copy->objects[k].lamp == 1 + i)
                copy->objects[k].front.emission = tints->diffuse[i];
    }
}

Mat4 scene_eye_from_object(const Camera *camera, Mat4 eye_from_world, Mat4 world_from_object)
{
    Mat4 relative = world_from_object;
    relative.m[12] -= camera->eye.x * relative.m[15];
    relative.m[13] -= camera->eye.y * relative.m[15];
    relative.m[14] -= camera->eye.z * relative.m[15];
    return mat4_product(rotation_of(eye_from_world), relative);
}

Vec3 scene_eye_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world)
{
    return mat4_transform_direction(eye_from_world, vec3_subtract(point_world, camera->eye));
}

/* Copies. */

/* The first object with the same mesh. */
static int first_with_mesh(const Scene *scene, int number)
{
    int i = 0;
    while (scene->objects[i].mesh != scene->objects[number].mesh)
        i++;
    return i;
}

void scene_copy_open(SceneCopy *copy, const Scene *scene)
{
    const size_t lights = (size_t)scene->light_count, objects = (size_t)scene->object_count;
    *copy = (SceneCopy){.scene = *scene,
                        .lights = memory_copy(scene->lights, lights * sizeof *copy->lights),
                        .objects = memory_copy(scene->objects, objects * sizeof *copy->objects)};
    copy->scene.lights = copy->lights;
    copy->scene.objects = copy->objects;
}

bool scene_copy_open_deep(SceneCopy *copy, const Scene *scene, Message *message)
{
    scene_copy_open(copy, scene);
    copy->meshes = memory_new((size_t)scene->object_count, sizeof *copy->meshes);
    for (int i = 0; i < scene->object_count; i++) {
        const Mesh *mesh = scene->objects[i].mesh;
        const int first = first_with_mesh(scene, i);
        if (mesh && first == i && !mesh_copy(&copy->meshes[i], mesh, NULL)) {
            scene_copy_close(copy);
            return message_set(message, "scene: not enough memory for a copy");
        }
        if (mesh)
            copy->objects[i].mesh = &copy->meshes[first];
    }
    return true;
}

void scene_copy_close(SceneCopy *copy)
{
    if (!copy)
        return;
    for (int i = 0; copy->meshes && i < copy->scene.object_count; i++)
        mesh_close(&copy->meshes[i]);
    free(copy->meshes);
    free(copy->objects);
    free(copy->lights);
    *copy = (SceneCopy){.lights = NULL};
}

void scene_key_mesh(CacheKey *key, const Mesh *mesh)
{
    cache_key_add(key, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    cache_key_add(key, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    if (mesh->colors)
        cache_key_add(key, mesh->colors, mesh->vertex_count * sizeof *mesh->colors);
    if (mesh->lit_positions)
        cache_key_add(key, mesh->lit_positions, mesh->vertex_count * sizeof *mesh->lit_positions);
}
