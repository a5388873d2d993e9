/*
 * What is looked at for each object in each frame: which channels of which colors are black,
 * whether a light reaches the object, whether its transform keeps lengths and angles. What a mesh
 * and a transform alone decide is kept while they stay; the rest takes some tens of nanoseconds,
 * and more only for spots and for lights that fade.
 */
#include "scene/effects.h"

#include "core/matrix_vectors.h"
#include "scene/shadow_pairs.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static_assert(OBJECT_FACTS_DECIDE == 6 * 4 + 2 * sizeof(SideFacts) + 10, "no padding");
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
EffectsTransform effects_transform(Mat4 m)
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

/* Whether a normal, if it is not zero, is in a cone, which may grow. */
static bool widen(NormalCone *cone, Vec3 normal)
{
    static const double WIDEST = 0.1;
    if (vec3_dot(normal, normal) > 0)
        cone->cosine = fmin(cone->cosine, vec3_dot(cone->axis, normal));
    return cone->cosine > WIDEST;
}

/* Around the mean normal of the vertices. Of a closed mesh the first few show that there is none.
 */
NormalCone effects_normal_cone(const Mesh *mesh)
{
    const NormalCone any = {.cosine = 0};
    NormalCone cone = {.cosine = 1, .low = HUGE_VAL};
    Vec3 sum = {0, 0, 0}, face;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        sum = vec3_add(sum, vec3_from_float(mesh->vertices[i].normal));
    if (mesh->lit_positions || !vec3_normalize(sum, &cone.axis))
        return any;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (!widen(&cone, vec3_from_float(mesh->vertices[i].normal)))
            return any;
        cone.low = fmin(cone.low, vec3_dot(cone.axis, vec3_from_float(mesh->vertices[i].position)));
    }
    for (size_t i = 0; i < mesh->index_count / 3; i++)
        if (mesh_face(mesh, i, &face) && !widen(&cone, face))
            return any;
    return cone;
}

/* Its axis is a normal, and a . p is (M^-T a) . (M p). Angles stay where M scales evenly. Else, of
 * a normal n that is |n - a| from the axis, B n with B = M^-T is at most |B| |n - a| from B a,
 * which is no shorter than 1 / |B^-1|: that bounds the sine of their angle. */
static NormalCone placed_cone(Mat4 m, const NormalCone *normals, EffectsTransform transform)
{
    Mat4 inverse;
    NormalCone cone = {.cosine = 0};
    double sine = 0, norms[2] = {0, 0};
    if (normals->cosine == 0 || !mat4_inverse(m, &inverse))
        return cone;
    for (int i = 0; i < 12; i++) {
        norms[0] += m.m[i] * m.m[i]; /* the last row is 0 */
        norms[1] += inverse.m[i] * inverse.m[i];
    }
    if (transform == GENERAL)
        sine = sqrt(norms[0] * norms[1] * 2 * (1 - normals->cosine));
    const Vec3 normal = mat4_transform_direction(mat4_transpose(inverse), normals->axis);
    const double length = vec3_length(normal);
    cone.axis = vec3_scale(normal, 1 / length);
    cone.low = normals->low / length + vec3_dot(cone.axis, (Vec3){m.m[12], m.m[13], m.m[14]});
    if (sine < 1 && isfinite(cone.low))
        cone.cosine = transform == GENERAL ? sqrt(1 - sine * sine) : normals->cosine;
    return cone;
}

EffectsPlace effects_place(const Object *object, const MeshBox *box, const NormalCone *normals)
{
    const EffectsTransform transform = effects_transform(object->world_from_object);
    return (EffectsPlace){scene_sphere(object, box), transform,
                          placed_cone(object->world_from_object, normals, transform)};
}

void effects_view(EffectsView *view, const Scene *scene)
{
    Mat4 clip_from_eye;
    view->scene = scene;
    view->on = view->spots = view->fading = 0;
    scene_camera(&scene->camera, 1, &view->eye_from_world, &clip_from_eye, NULL);
    for (int i = 0; i < scene->light_count && i < EFFECTS_MAX_LIGHTS; i++) {
        const Light *light = &scene->lights[i];
        const uint32_t bit = (uint32_t)1 << i;
        view->lights[i] = scene_world_light(scene, i);
        view->brightest[i][0] = light_ambient_varies(light) ? largest_of(light->ambient) : 0;
        view->brightest[i][1] = largest_of(light->diffuse);
        view->brightest[i][2] = largest_of(light->specular);
        view->on |= light->off ? 0 : bit;
        view->spots |= !light->off && light->kind == LIGHT_SPOT ? bit : 0;
        view->fading |= !light->off && light_fades(light) ? bit : 0;
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

/* How near a light comes to the object at least. */
static double nearest_to(const Light *light, Sphere sphere)
{
    return fmax(vec3_length(vec3_subtract(sphere.center, light->position)) - sphere.radius, 0);
}

/* Whether no point of the object is as near as the light's range. */
static bool beyond_range(const Light *light, Sphere sphere)
{
    return light->range > 0 && nearest_to(light, sphere) > light->range * (1 + 1e-6);
}

/* Whether N.L is negative for each normal N of the cone at each point p of the surface. Along the
 * axis the light is at least `depth` below the surface, and at most `beside` from it across: then
 * N.(light - p) <= sin(angle) beside - cos(angle) depth. What is so close to 0 that a float's
 * rounding may turn it is not meant: N.L > 0 would have a highlight. */
static bool is_behind(const EffectsView *view, const Light *light, const EffectsPlace *place)
{
    static const double ROUNDING = 1e-5;
    const NormalCone *normals = &place->normals;
    const double cosine = normals->cosine, sine = sqrt(fmax(1 - cosine * cosine, 0));
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    const Vec3 eye = view->scene->camera.eye;
    Vec3 way = vec3_subtract(light->position, place->sphere.center);
    double size = vec3_length(vec3_subtract(light->position, eye)) +
                  vec3_length(vec3_subtract(place->sphere.center, eye)) + place->sphere.radius;
    if (cosine == 0 || (directional && !vec3_normalize(light->direction, &way)))
        return false;
    const double along = vec3_dot(way, normals->axis);
    const double depth =
        directional ? -along : normals->low - vec3_dot(light->position, normals->axis);
    const double beside = vec3_length(vec3_subtract(way, vec3_scale(normals->axis, along))) +
                          (directional ? 0 : place->sphere.radius);
    return cosine * depth - sine * beside > ROUNDING * (directional ? 1 : size);
}

/* The lights that are too faint, the faintest first, as long as all together add less than half a
 * step to any pixel. A light adds its colours times the material's at most, for no cosine, power of
 * one or spot is above 1, times its attenuation where it comes nearest. Encoding as sRGB makes a
 * step near black up to 12.92 steps (IEC 61966-2-1). Where a colour above 1 is highlighted, any
 * light may decide. */
static uint32_t faint_lights(const EffectsView *view, const Object *object, Sphere sphere,
                             uint32_t lights, float steps[EFFECTS_MAX_LIGHTS])
{
    static const double ROUNDING = 1.001;
    const Scene *scene = view->scene;
    const Material sides[2] = {effects_material(object, false), effects_material(object, true)};
    const double step = 1.0 / 255 / (scene->linear ? 12.92 : 1);
    double left = step / 2, adds[EFFECTS_MAX_LIGHTS], reflects[3];
    uint32_t faint = 0, candidates = 0;
    if (scene->show_clipped || object->mesh->lit_positions)
        return 0;
    reflects[0] = fmax(largest_of(sides[0].ambient), largest_of(sides[1].ambient));
    reflects[1] = fmax(largest_of(sides[0].diffuse), largest_of(sides[1].diffuse));
    reflects[2] = fmax(largest_of(sides[0].specular), largest_of(sides[1].specular));
    for (uint32_t rest = lights; rest; rest &= rest - 1) {
        const int i = __builtin_ctz(rest);
        const Light *light = &view->lights[i];
        const double *color = view->brightest[i];
        const double sum = reflects[0] * color[0] + reflects[1] * color[1] + reflects[2] * color[2];
        const double distance = rest & -rest & view->fading ? nearest_to(light, sphere) : 0;
        adds[i] = ROUNDING * sum * light_attenuation(light, distance);
        candidates |= adds[i] > 0 && adds[i] < left ? rest & -rest : 0;
    }
    while (candidates) {
        int least = __builtin_ctz(candidates);
        for (uint32_t rest = candidates; rest; rest &= rest - 1)
            least = adds[__builtin_ctz(rest)] < adds[least] ? __builtin_ctz(rest) : least;
        left -= adds[least];
        if (left < 0)
            break;
        faint |= (uint32_t)1 << least;
        steps[least] = (float)(adds[least] / step);
        candidates &= ~((uint32_t)1 << least);
    }
    return faint;
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
    const bool one_side = place->normals.cosine > 0 && !object->two_sided && !object->wrong_normals;
    for (uint32_t left = one_side ? view->on : 0; left; left &= left - 1)
        if (is_behind(view, &view->lights[__builtin_ctz(left)], place))
            facts.behind |= left & -left;
    facts.faint =
        faint_lights(view, object, place->sphere,
                     view->on & ~(facts.missed | facts.beyond_range | facts.behind), facts.steps);
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
