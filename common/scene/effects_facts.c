/*
 * What is looked at for each object in each frame: which channels of which colors are black,
 * whether a cone misses the object, whether its transform keeps lengths and angles. What a mesh and
 * a transform alone decide is kept while they stay; the rest takes some tens of nanoseconds, and
 * more only for spots and for lights that fade.
 */
#include "scene/effects.h"

#include "scene/shadow_pairs.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static_assert(sizeof(ObjectFacts) == 4 * 4 + 2 * sizeof(SideFacts) + 10, "no padding");
static_assert(sizeof(SceneFacts) == EFFECTS_MAX_LIGHTS * sizeof(LightFacts) + 11, "no padding");

static uint8_t channels_of(Vec3 color)
{
    return (uint8_t)((color.x != 0) | (color.y != 0) << 1 | (color.z != 0) << 2);
}

static double largest_of(Vec3 color)
{
    return fmax(fmax(color.x, color.y), color.z);
}

/* A bound of a scene's colors. */
static double brightest(const Scene *scene)
{
    double sum = 1 + largest_of(scene->global_ambient); /* 1: emission */
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        const double nearest = light->constant != 0 ? light->constant : light_fades(light) ? 0 : 1;
        const double color =
            largest_of(light->ambient) + largest_of(light->diffuse) + largest_of(light->specular);
        if (!light->off && color > 0)
            sum += color / (light->kind == LIGHT_DIRECTIONAL ? 1 : nearest);
    }
    return sum;
}

SceneFacts effects_scene(const Scene *scene)
{
    SceneFacts facts;
    memset(&facts, 0, sizeof facts);
    const int count =
        scene->light_count < EFFECTS_MAX_LIGHTS ? scene->light_count : EFFECTS_MAX_LIGHTS;
    for (int i = 0; i < count; i++) {
        const Light *light = &scene->lights[i];
        facts.lights[i] = (LightFacts){
            .kind = (uint8_t)light->kind,
            .off = light->off,
            .shadows = light->shadows,
            .fades = light_fades(light),
            .exponent = light->kind == LIGHT_SPOT && light->exponent != 0,
            .range = light->kind != LIGHT_DIRECTIONAL && light->range != 0,
            .ambient = channels_of(light->ambient),
            .diffuse = channels_of(light->diffuse),
            .specular = channels_of(light->specular),
        };
    }
    facts.light_count = (uint8_t)count;
    facts.global_ambient = channels_of(scene->global_ambient);
    facts.reflection = (uint8_t)scene->reflection;
    facts.interpolation = (uint8_t)scene->interpolation;
    facts.distant_viewer = scene->distant_viewer;
    facts.clamp_vertex = scene->clamp_vertex;
    facts.skip_renormalization = scene->skip_renormalization;
    facts.linear = scene->linear;
    facts.signed_dots = scene->signed_dots;
    facts.show_clipped = scene->show_clipped;
    facts.limit = brightest(scene) > 6e4;
    return facts;
}

Material effects_material(const Object *object, bool back)
{
    Material material = back && object->two_sided ? object->back : object->front;
    if (object->mesh->colors)
        material.ambient = material.diffuse = (Vec3){1, 1, 1};
    return material;
}

/* Orthogonal: the columns of the upper left 3x3 part are perpendicular and of equal length, so that
 * it is its own inverse transpose up to a factor. Orthonormal: that length is 1. A difference of
 * 1e-7 rotates a normal by less than rounding to float. The eye's rotation changes none of that. */
static EffectsTransform transform_of(Mat4 m)
{
    const double *a = m.m;
    double dots[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            dots[i][j] =
                a[4 * i] * a[4 * j] + a[4 * i + 1] * a[4 * j + 1] + a[4 * i + 2] * a[4 * j + 2];
    const double square = dots[0][0];
    if (!(square > 0))
        return GENERAL;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (fabs(dots[i][j] - (i == j ? square : 0)) > 1e-7 * square)
                return GENERAL;
    /* The squares of other lengths lose digits, or overflow, in a fragment's 16-bit float. The
     * normal matrix is scaled. */
    if (!(square > 1e-4 && square < 1e4))
        return EXTREME;
    return fabs(square - 1) <= 1e-7 ? ORTHONORMAL : ORTHOGONAL;
}

EffectsPlace effects_place(const Object *object, const MeshBox *box)
{
    return (EffectsPlace){scene_sphere(object, box), transform_of(object->world_from_object)};
}

void effects_view(EffectsView *view, const Scene *scene)
{
    Mat4 clip_from_eye;
    view->scene = scene;
    view->spots = view->fading = 0;
    scene_camera(&scene->camera, 1, &view->eye_from_world, &clip_from_eye, NULL);
    for (int i = 0; i < scene->light_count && i < EFFECTS_MAX_LIGHTS; i++) {
        const Light *light = &scene->lights[i];
        view->lights[i] = scene_world_light(scene, i);
        if (!light->off && light->kind == LIGHT_SPOT)
            view->spots |= (uint32_t)1 << i;
        if (!light->off && light_fades(light))
            view->fading |= (uint32_t)1 << i;
    }
}

/* Whether the attenuation of a light at the object needs a guard: its denominator may vanish in
 * float, or the square of a distance overflow. */
static bool attenuation_guarded(const Light *light, Sphere sphere)
{
    static const double FAR = 1e18; /* its square fits into a float */
    const double distance = vec3_length(vec3_subtract(sphere.center, light->position));
    return !(light->constant > 1e-29 && distance + sphere.radius < FAR);
}

/* Whether no point of the object is as near as the light's range. */
static bool beyond_range(const Light *light, Sphere sphere)
{
    const double distance = vec3_length(vec3_subtract(sphere.center, light->position));
    return light->range > 0 && distance - sphere.radius > light->range * (1 + 1e-6);
}

static SideFacts side_facts(const Object *object, const Material *material)
{
    const bool colors = object->mesh->colors; /* as effects_material: white here */
    return (SideFacts){colors ? 7 : channels_of(material->ambient),
                       colors ? 7 : channels_of(material->diffuse), channels_of(material->specular),
                       channels_of(material->emission), material->alpha != 1};
}

ObjectFacts effects_object(const EffectsView *view, const Object *object, const EffectsPlace *place,
                           uint32_t shadowed)
{
    const Camera *camera = &view->scene->camera;
    const Vec3 center = scene_eye_point(camera, view->eye_from_world, place->sphere.center);
    ObjectFacts facts = {
        .shadowed = shadowed,
        .front = side_facts(object, &object->front),
        .colors = object->mesh->colors != NULL,
        .flat = object->flat,
        .closed = object->closed,
        .clockwise = object->clockwise,
        .two_sided = object->two_sided,
        .wrong_normals = object->wrong_normals,
        .transform = (uint8_t)place->transform,
        .beyond = -center.z - place->sphere.radius > camera->near,
    };
    facts.back = object->two_sided ? side_facts(object, &object->back) : facts.front;
    for (uint32_t left = view->spots; left; left &= left - 1)
        if (cone_misses(&view->lights[__builtin_ctz(left)], place->sphere))
            facts.missed |= left & -left;
    for (uint32_t left = view->fading; left; left &= left - 1)
        if (beyond_range(&view->lights[__builtin_ctz(left)], place->sphere))
            facts.beyond_range |= left & -left;
        else if (attenuation_guarded(&view->lights[__builtin_ctz(left)], place->sphere))
            facts.guarded |= left & -left;
    return facts;
}

uint32_t effects_shadows(const SceneFacts *scene)
{
    uint32_t shadows = 0;
    for (int i = 0; i < scene->light_count; i++)
        shadows |= (uint32_t)scene->lights[i].shadows << i;
    return shadows;
}

int effects_channel(uint32_t shadows, int light)
{
    return __builtin_popcount(shadows & (((uint32_t)1 << light) - 1));
}
