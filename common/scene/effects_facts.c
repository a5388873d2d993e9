/*
 * What is looked at for each object in each frame: which channels of which colors are black,
 * whether a light reaches the object, whether its transform keeps lengths and angles. What a mesh
 * and a transform alone decide is kept while they stay; the rest takes some tens of nanoseconds,
 * and more only for spots and for lights that fade.
 */
#include "scene/effects.h"

#include "base/memory.h"
#include "core/matrix_vectors.h"
#include "scene/shadow_pairs.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static_assert(OBJECT_FACTS_DECIDE == 6 * 4 + 2 * sizeof(SideFacts) + 10, "no padding");
static_assert(sizeof(SceneFacts) == EFFECTS_MAX_LIGHTS * (sizeof(LightFacts) + 2) + 16,
              "no padding");

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

SceneFacts effects_scene(const EffectsView *view, const EffectsLights *lights)
{
    const Scene *scene = view->scene;
    SceneFacts facts;
    memset(&facts, 0, sizeof facts);
    for (int i = 0; i < lights->count; i++) {
        const Light *light = &scene->lights[lights->numbers[i]];
        facts.numbers[i] = lights->numbers[i];
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
    facts.shadows = view->shadows;
    facts.light_count = (uint8_t)lights->count;
    facts.ambient = view->ambient;
    facts.reflection = (uint8_t)scene->reflection;
    facts.interpolation = (uint8_t)scene->interpolation;
    facts.distant_viewer = scene->distant_viewer;
    facts.clamp_vertex = scene->clamp_vertex;
    facts.skip_renormalization = scene->skip_renormalization;
    facts.linear = scene->linear;
    facts.signed_dots = scene->signed_dots;
    facts.show_clipped = scene->show_clipped;
    facts.limit = view->limit;
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

static const Light *light_of(const EffectsView *view, const EffectsLights *lights, int number)
{
    return &view->lights[lights->numbers[number]].light;
}

static void find_bits(EffectsLights *lights, const EffectsView *view)
{
    lights->on = lights->spots = lights->fading = 0;
    for (int i = 0; i < lights->count; i++) {
        const Light *light = light_of(view, lights, i);
        const uint32_t bit = light->off ? 0 : (uint32_t)1 << i;
        lights->on |= bit;
        lights->spots |= light->kind == LIGHT_SPOT ? bit : 0;
        lights->fading |= light_fades(light) ? bit : 0;
    }
}

void effects_view(EffectsView *view, const Scene *scene)
{
    Mat4 clip_from_eye;
    view->scene = scene;
    view->shadows = 0;
    view->ambient = channels_of(scene->global_ambient);
    view->limit = brightest(scene) > 6e4;
    view->all.count = 0;
    scene_camera(&scene->camera, 1, &view->eye_from_world, &clip_from_eye, NULL);
    if (scene->light_count > view->room) {
        view->room = scene->light_count;
        view->lights = memory_grow(view->lights, (size_t)view->room, sizeof *view->lights);
    }
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        const bool varies = light_ambient_varies(light);
        EffectsLight *made = &view->lights[i];
        made->light = scene_world_light(scene, i);
        made->brightest[0] = varies ? largest_of(light->ambient) : 0;
        made->brightest[1] = largest_of(light->diffuse);
        made->brightest[2] = largest_of(light->specular);
        view->ambient |= light->off || varies ? 0 : channels_of(light->ambient);
        if (i < SCENE_MAX_CASTING)
            view->shadows |= (uint32_t)light->shadows << i;
        if (scene->light_count <= EFFECTS_MAX_LIGHTS)
            view->all.numbers[view->all.count++] = (uint16_t)i;
    }
    find_bits(&view->all, view);
}

void effects_view_close(EffectsView *view)
{
    free(view->lights);
    *view = (EffectsView){.scene = NULL};
}

/* Whether the attenuation of a light at the object needs a guard: its denominator may vanish in
 * float, or the square of a distance overflow. */
static bool attenuation_guarded(const Light *light, Sphere sphere)
{
    static const double FAR = 1e18; /* its square fits into a float */
    const double distance = vec3_length(vec3_subtract(sphere.center, light->position));
    return !(light->constant > 1e-29 && distance + sphere.radius < FAR);
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

/* What an object reflects of ambient, diffuse and specular light at most. */
typedef struct Reflects {
    double most[3];
} Reflects;

static Reflects reflects_of(const Object *object)
{
    const Material front = effects_material(object, false), back = effects_material(object, true);
    return (Reflects){{fmax(largest_of(front.ambient), largest_of(back.ambient)),
                       fmax(largest_of(front.diffuse), largest_of(back.diffuse)),
                       fmax(largest_of(front.specular), largest_of(back.specular))}};
}

/* A light adds its colours times the material's at most, for no cosine, power of one or spot is
 * above 1, times its attenuation where it comes nearest. */
static double most_added(const EffectsLight *light, const Reflects *reflects, Sphere sphere)
{
    static const double ROUNDING = 1.001;
    const double *color = light->brightest, *most = reflects->most;
    const double sum = most[0] * color[0] + most[1] * color[1] + most[2] * color[2];
    const double distance = light_fades(&light->light) ? nearest_to(&light->light, sphere) : 0;
    return ROUNDING * sum * light_attenuation(&light->light, distance);
}

/* Encoding as sRGB makes a step near black up to 12.92 steps (IEC 61966-2-1). */
static double step_of(const Scene *scene)
{
    return 1.0 / 255 / (scene->linear ? 12.92 : 1);
}

/* What too faint lights may add together: less than half a step. Where a colour above 1 is
 * highlighted, any light may decide. */
static double most_faint(const Scene *scene, const Object *object)
{
    return scene->show_clipped || object->mesh->lit_positions ? 0 : step_of(scene) / 2;
}

/* The lights that are too faint, the faintest first, as long as all together may be. */
static uint32_t faint_lights(const EffectsView *view, const EffectsLights *lights,
                             const Object *object, Sphere sphere, ObjectFacts *facts)
{
    const Reflects reflects = reflects_of(object);
    double left = most_faint(view->scene, object) - lights->spent, adds[EFFECTS_MAX_LIGHTS];
    uint32_t faint = 0, candidates = 0;
    facts->spent = (float)(lights->spent / step_of(view->scene));
    for (uint32_t rest = lights->on & ~(facts->missed | facts->beyond_range | facts->behind);
         rest && left > 0; rest &= rest - 1) {
        const int i = __builtin_ctz(rest);
        adds[i] = most_added(&view->lights[lights->numbers[i]], &reflects, sphere);
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
        facts->steps[least] = (float)(adds[least] / step_of(view->scene));
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

/* Whether its surface may turn away from a light. */
static bool has_one_side(const Object *object, const EffectsPlace *place)
{
    return place->normals.cosine > 0 && !object->two_sided && !object->wrong_normals;
}

ObjectFacts effects_object(const EffectsView *view, const EffectsLights *lights,
                           const Object *object, const EffectsPlace *place, uint32_t shadowed)
{
    const Camera *camera = &view->scene->camera;
    const Vec3 center = scene_eye_point(camera, view->eye_from_world, place->sphere.center);
    ObjectFacts facts = {
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
    for (int i = 0; i < lights->count && shadowed; i++)
        if (lights->numbers[i] < SCENE_MAX_CASTING && shadowed >> lights->numbers[i] & 1)
            facts.shadowed |= (uint32_t)1 << i;
    for (uint32_t left = lights->spots; left; left &= left - 1)
        if (cone_misses(light_of(view, lights, __builtin_ctz(left)), place->sphere))
            facts.missed |= left & -left;
    for (uint32_t left = lights->fading; left; left &= left - 1)
        if (beyond_range(light_of(view, lights, __builtin_ctz(left)), place->sphere))
            facts.beyond_range |= left & -left;
        else if (attenuation_guarded(light_of(view, lights, __builtin_ctz(left)), place->sphere))
            facts.guarded |= left & -left;
    for (uint32_t left = has_one_side(object, place) ? lights->on : 0; left; left &= left - 1)
        if (is_behind(view, light_of(view, lights, __builtin_ctz(left)), place))
            facts.behind |= left & -left;
    facts.faint = faint_lights(view, lights, object, place->sphere, &facts);
    return facts;
}

/* Of more lights than an object may have. */

static EffectsReach reach_of(const EffectsView *view, const EffectsLight *light,
                             const Object *object, const EffectsPlace *place)
{
    const Light *placed = &light->light;
    if (placed->off)
        return REACH_OFF;
    if (beyond_range(placed, place->sphere))
        return REACH_RANGE;
    if (placed->kind == LIGHT_SPOT && cone_misses(placed, place->sphere))
        return REACH_CONE;
    /* Ambient light arrives from behind, and a negative N.L takes light away. */
    if (light->brightest[0] == 0 && (!view->scene->signed_dots || placed->shadows) &&
        !view->any_normals && has_one_side(object, place) && is_behind(view, placed, place))
        return REACH_BEHIND;
    return REACH_YES;
}

static int by_number(const void *a, const void *b)
{
    return (int)*(const uint16_t *)a - (int)*(const uint16_t *)b;
}

/* What is kept of those that reach an object: so many of the brightest. */
typedef struct Kept {
    EffectsLights *lights;
    double adds[EFFECTS_MAX_LIGHTS];
    int least;
    double left_out; /* what the others add */
} Kept;

/* Returns which light is left out; -1: none. */
static int keep(Kept *kept, int number, double adds)
{
    EffectsLights *lights = kept->lights;
    int place = lights->count, out = -1;
    if (place == EFFECTS_MAX_LIGHTS) {
        kept->left_out += fmin(adds, kept->adds[kept->least]);
        if (adds <= kept->adds[kept->least])
            return number;
        place = kept->least;
        out = lights->numbers[place];
    } else {
        lights->count++;
    }
    lights->numbers[place] = (uint16_t)number;
    kept->adds[place] = adds;
    for (int i = 0; lights->count == EFFECTS_MAX_LIGHTS && i < EFFECTS_MAX_LIGHTS; i++)
        kept->least = i == 0 || kept->adds[i] < kept->adds[kept->least] ? i : kept->least;
    return out;
}

const EffectsLights *effects_lights(const EffectsView *view, const Object *object,
                                    const EffectsPlace *place, EffectsLights *chosen, uint8_t *why)
{
    const int count = view->scene->light_count;
    if (count <= EFFECTS_MAX_LIGHTS)
        return &view->all;
    const double most = most_faint(view->scene, object);
    const Reflects reflects = reflects_of(object);
    Kept kept = {.lights = chosen};
    *chosen = (EffectsLights){.count = 0};
    for (int i = 0; i < count; i++) {
        const EffectsLight *light = &view->lights[i];
        EffectsReach reach = reach_of(view, light, object, place);
        const double adds = reach ? 0 : most_added(light, &reflects, place->sphere);
        reach = reach || adds > 0 ? reach : REACH_BLACK;
        const int out = reach ? -1 : keep(&kept, i, adds);
        if (why)
            why[i] = (uint8_t)reach;
        if (why && out >= 0)
            why[out] = REACH_MORE;
    }
    for (int i = 0; why && kept.left_out <= most && i < count; i++)
        why[i] = why[i] == REACH_MORE ? REACH_FAINT : why[i];
    if (kept.left_out > 0)
        qsort(chosen->numbers, EFFECTS_MAX_LIGHTS, sizeof *chosen->numbers, by_number);
    chosen->spent = fmin(kept.left_out, most);
    find_bits(chosen, view);
    return chosen;
}

int effects_channel(uint32_t shadows, int light)
{
    return __builtin_popcount(shadows & (((uint32_t)1 << light) - 1));
}
