#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const REFLECTION_NAMES[] = {
    [REFLECTION_BLINN_PHONG] = "blinn-phong", [REFLECTION_PHONG] = "phong", NULL};
const char *const INTERPOLATION_NAMES[] = {[INTERPOLATION_PHONG] = "phong",
                                           [INTERPOLATION_GOURAUD] = "gouraud",
                                           [INTERPOLATION_FLAT] = "flat",
                                           NULL};

/* Each check leaves a message that begins with its subject, "light 2: cutoff". */

/* Squares of distances must fit into a float. */
static const double MOST_POSITION = 1e15;

static bool in_range(Vec3 v)
{
    return fabs(v.x) <= MOST_POSITION && fabs(v.y) <= MOST_POSITION && fabs(v.z) <= MOST_POSITION;
}

static bool check_vector(const char *subject, const char *name, Vec3 v, Message *message)
{
    if (in_range(v))
        return true;
    return message_set(message, "%s: %s (%g, %g, %g): must be %g at most", subject, name, v.x, v.y,
                       v.z, MOST_POSITION);
}

static bool check_direction(const char *subject, const char *name, Vec3 v, Message *message)
{
    Vec3 unit;
    if (vec3_normalize(v, &unit))
        return true;
    return message_set(message, "%s: %s (%g, %g, %g): must be finite and not zero", subject, name,
                       v.x, v.y, v.z);
}

static bool check_range(const char *subject, const char *name, double value, double least,
                        double most, Message *message)
{
    if (value >= least && value <= most)
        return true;
    return message_set(message, "%s: %s %g: must be %g to %g", subject, name, value, least, most);
}

/* Intensities may exceed 1, reflectivities may not; `most` tells which. */
static bool check_color(const char *subject, const char *name, Vec3 c, double most,
                        Message *message)
{
    return check_range(subject, name, c.x, 0, most, message) &&
           check_range(subject, name, c.y, 0, most, message) &&
           check_range(subject, name, c.z, 0, most, message);
}

static const double MOST_INTENSITY = 1e6, MOST_COEFFICIENT = 1e30;

static bool check_light(const Light *light, int number, Message *message)
{
    char subject[32];
    snprintf(subject, sizeof subject, "light %d", number);
    if (!check_range(subject, "kind", light->kind, LIGHT_DIRECTIONAL, LIGHT_SPOT, message) ||
        !check_color(subject, "ambient", light->ambient, MOST_INTENSITY, message) ||
        !check_color(subject, "diffuse", light->diffuse, MOST_INTENSITY, message) ||
        !check_color(subject, "specular", light->specular, MOST_INTENSITY, message))
        return false;
    if (light->kind == LIGHT_DIRECTIONAL)
        return check_direction(subject, "direction", light->direction, message);
    if (!check_vector(subject, "position", light->position, message) ||
        !check_range(subject, "constant", light->constant, 0, MOST_COEFFICIENT, message) ||
        !check_range(subject, "linear", light->linear, 0, MOST_COEFFICIENT, message) ||
        !check_range(subject, "quadratic", light->quadratic, 0, MOST_COEFFICIENT, message))
        return false;
    if (light->kind == LIGHT_POINT)
        return true;
    return check_direction(subject, "direction", light->direction, message) &&
           check_range(subject, "cutoff", light->cutoff, 0, 90, message) &&
           check_range(subject, "exponent", light->exponent, 0, 128, message);
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
        !check_color("scene", "global ambient", scene->global_ambient, MOST_INTENSITY, message) ||
        !check_range("scene", "reflection", scene->reflection, 0, REFLECTION_PHONG, message) ||
        !check_range("scene", "interpolation", scene->interpolation, 0, INTERPOLATION_FLAT,
                     message))
        return false;
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
    if (!mat4_look_at(camera->eye, camera->center, camera->up, eye_from_world))
        return message_set(message,
                           "camera: eye (%g, %g, %g), center (%g, %g, %g), up (%g, %g, %g): eye "
                           "and center must differ, and up must not lie along the view",
                           camera->eye.x, camera->eye.y, camera->eye.z, camera->center.x,
                           camera->center.y, camera->center.z, camera->up.x, camera->up.y,
                           camera->up.z);
    if (!mat4_perspective(camera->fovy, aspect, camera->near, camera->far, clip_from_eye))
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

static bool copy_mesh(Mesh *copy, const Mesh *mesh)
{
    if (!mesh_open(copy, mesh->vertex_count, mesh->index_count, NULL))
        return false;
    memcpy(copy->vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    memcpy(copy->indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    return true;
}

/* The first object with the same mesh. */
static int first_with_mesh(const Scene *scene, int number)
{
    int i = 0;
    while (scene->objects[i].mesh != scene->objects[number].mesh)
        i++;
    return i;
}

static bool copy_objects(SceneCopy *copy, const Scene *scene)
{
    for (int i = 0; i < scene->object_count; i++) {
        const Mesh *mesh = scene->objects[i].mesh;
        const int first = first_with_mesh(scene, i);
        copy->objects[i] = scene->objects[i];
        if (!mesh)
            continue;
        if (first == i && !copy_mesh(&copy->meshes[i], mesh))
            return false;
        copy->objects[i].mesh = &copy->meshes[first];
    }
    return true;
}

bool scene_copy_open(SceneCopy *copy, const Scene *scene, Message *message)
{
    const size_t lights = (size_t)scene->light_count, objects = (size_t)scene->object_count;
    *copy = (SceneCopy){.scene = *scene,
                        .lights = calloc(lights + 1, sizeof *copy->lights),
                        .objects = calloc(objects + 1, sizeof *copy->objects),
                        .meshes = calloc(objects + 1, sizeof *copy->meshes)};
    if (!copy->lights || !copy->objects || !copy->meshes || !copy_objects(copy, scene)) {
        scene_copy_close(copy);
        return message_set(message, "scene: not enough memory for a copy");
    }
    for (size_t i = 0; i < lights; i++)
        copy->lights[i] = scene->lights[i];
    copy->scene.lights = copy->lights;
    copy->scene.objects = copy->objects;
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
