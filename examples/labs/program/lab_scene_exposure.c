/* Light is linear: the brightness of the brightest visible vertex says by what factor all lights
 * have to be multiplied. */
#include "labs/program/lab_scene_parts.h"

#include "labs/program/binding.h"

#include <math.h>
#include <string.h>

/* A vertex in world space. */
typedef struct Spot {
    Vec3 place, normal;
    double seen; /* the cosine of the angle between its normal and the eye */
} Spot;

static Spot spot_of(const LabScene *lab_scene, const Object *object, size_t vertex)
{
    const MeshVertex *of = &object->mesh->vertices[vertex];
    Spot spot = {
        .place = mat4_transform_point(object->world_from_object, vec3_from_float(of->position))};
    Vec3 view = vec3_subtract(lab_scene->scene.camera.eye, spot.place);
    vec3_normalize(mat4_transform_direction(binding_normal_matrix(object->world_from_object),
                                            vec3_from_float(of->normal)),
                   &spot.normal);
    vec3_normalize(view, &view);
    spot.seen = vec3_dot(spot.normal, view);
    if (object->two_sided && spot.seen < 0) {
        spot.normal = vec3_scale(spot.normal, -1);
        spot.seen = -spot.seen;
    }
    return spot;
}

/* What reaches a vertex of a light, without its colour: cosine, cone and attenuation. */
static double reaching(const Light *light, const Spot *spot)
{
    Vec3 way = light->kind == LIGHT_DIRECTIONAL ? light->direction
                                                : vec3_subtract(light->position, spot->place);
    Vec3 axis = light->direction;
    const double d = vec3_length(way);
    vec3_normalize(way, &way);
    const double cosine = fmax(vec3_dot(spot->normal, way), 0);
    if (light->kind != LIGHT_SPOT)
        return cosine;
    vec3_normalize(axis, &axis);
    const double along = -vec3_dot(way, axis);
    if (along < cos(light->cutoff * acos(-1) / 180))
        return 0;
    return cosine * pow(along, light->exponent) /
           (light->constant + light->linear * d + light->quadratic * d * d);
}

static double largest(Vec3 v)
{
    return fmax(fmax(v.x, v.y), v.z);
}

static double middle(Vec3 v)
{
    return fmax(fmin(v.x, v.y), fmin(fmax(v.x, v.y), v.z));
}

/* At the brightest visible vertex: two channels of the first light alone, or one of the picture. */
static double brightest(const LabScene *lab_scene, bool picture)
{
    /* At a grazing angle it may be hidden. */
    const double grazing = 0.3;
    double most = 0;
    for (int k = 0; k < lab_scene->scene.object_count; k++) {
        const Object *object = &lab_scene->objects[k];
        for (size_t v = 0; v < object->mesh->vertex_count; v++) {
            const Spot spot = spot_of(lab_scene, object, v);
            if (spot.seen < grazing)
                continue;
            const Vec3 color = object->front.diffuse;
            Vec3 sum = {0, 0, 0};
            for (int i = 0; i < (picture ? lab_scene->scene.light_count : 1); i++)
                sum = vec3_add(sum, vec3_scale(lab_scene->lights[i].diffuse,
                                               reaching(&lab_scene->lights[i], &spot)));
            const Vec3 shown = {sum.x * color.x, sum.y * color.y, sum.z * color.z};
            most = fmax(most, picture ? largest(shown) : middle(sum));
        }
    }
    return most;
}

static void scale_lights(LabScene *lab_scene, double factor)
{
    for (int i = 0; i < lab_scene->scene.light_count; i++) {
        Light *light = &lab_scene->lights[i];
        light->diffuse = light->specular = vec3_scale(light->diffuse, factor);
    }
}

/* Moves the first light to where it faces the face that the eye sees best. */
static void face_light(LabScene *lab_scene)
{
    const Object *object = &lab_scene->objects[0];
    const Mesh *mesh = object->mesh;
    Light *light = &lab_scene->lights[0];
    size_t best = 0;
    double count = 0;
    Vec3 center = {0, 0, 0};
    for (size_t v = 1; v < mesh->vertex_count; v++)
        if (spot_of(lab_scene, object, v).seen > spot_of(lab_scene, object, best).seen)
            best = v;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        if (memcmp(mesh->vertices[v].normal, mesh->vertices[best].normal,
                   sizeof mesh->vertices[v].normal) != 0)
            continue;
        center = vec3_add(center, spot_of(lab_scene, object, v).place);
        count++;
    }
    const Vec3 normal = spot_of(lab_scene, object, best).normal;
    if (light->kind == LIGHT_DIRECTIONAL)
        light->direction = normal;
    else
        light->position = vec3_add(vec3_scale(center, 1 / count),
                                   vec3_scale(normal, vec3_length(light->position)));
}

static double *channel(Vec3 *v, int i)
{
    return i == 0 ? &v->x : i == 1 ? &v->y : &v->z;
}

void lab_scene_overexpose_light(LabScene *lab_scene, const Lab *lab)
{
    const double wanted = 1.15;
    if (lab->flat && !lab->shadow)
        face_light(lab_scene);
    const double found = brightest(lab_scene, false);
    if (found > 0)
        scale_lights(lab_scene, wanted / found);
    if (!lab->specular || lab->fitted)
        return;
    Light *light = &lab_scene->lights[0];
    const double strongest = largest(light->diffuse), share = wanted / middle(light->diffuse);
    for (int i = 0; i < 3; i++) {
        if (*channel(&light->diffuse, i) < strongest)
            continue;
        for (int k = 0; k < lab_scene->scene.object_count; k++) {
            Material *material = &lab_scene->objects[k].front;
            *channel(&material->ambient, i) = *channel(&material->diffuse, i) = 0;
            *channel(&material->specular, i) = fmin(1 / (strongest * share), 1);
        }
    }
}

void lab_scene_overexpose_picture(LabScene *lab_scene)
{
    const double wanted = 1.12, found = brightest(lab_scene, true);
    if (found > 0 && found < wanted)
        scale_lights(lab_scene, wanted / found);
}
