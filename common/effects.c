#include "effects.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* Everything is decided in one walk over the scene, and each decision says its reason to `file`
 * where that is not NULL: what is explained is what was done. */
static void say(FILE *file, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void say(FILE *file, const char *format, ...)
{
    va_list arguments;
    if (!file)
        return;
    va_start(arguments, format);
    vfprintf(file, format, arguments);
    va_end(arguments);
    fputc('\n', file);
}

static bool black(Vec3 color)
{
    return color.x == 0 && color.y == 0 && color.z == 0;
}

/* Whether light of this colour is reflected by reflectivity `front`, or `back` where that counts.
 */
static bool reflected(Vec3 light, Vec3 front, Vec3 back, bool two_sided)
{
    const Vec3 f = {light.x * front.x, light.y * front.y, light.z * front.z};
    const Vec3 b = {light.x * back.x, light.y * back.y, light.z * back.z};
    return !black(f) || (two_sided && !black(b));
}

/* A sphere around the object, in the world: that around its box. */
typedef struct Sphere {
    Vec3 center;
    double radius;
} Sphere;

static Sphere bounding_sphere(const Object *object)
{
    const Mesh *mesh = object->mesh;
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position;
        const Vec3 world = mat4_transform_point(object->world_from_object,
                                                (Vec3){(double)p[0], (double)p[1], (double)p[2]});
        low = (Vec3){fmin(low.x, world.x), fmin(low.y, world.y), fmin(low.z, world.z)};
        high = (Vec3){fmax(high.x, world.x), fmax(high.y, world.y), fmax(high.z, world.z)};
    }
    const Vec3 diagonal = vec3_subtract(high, low);
    return (Sphere){.center = vec3_add(low, vec3_scale(diagonal, 0.5)),
                    .radius = 0.5 * vec3_length(diagonal)};
}

/* Whether a spot's cone and a sphere have no point in common: the centre lies farther than the
 * radius outside the plane that touches the cone on its side. */
static bool cone_misses(const Light *light, Sphere sphere)
{
    static const double RADIANS = 0.017453292519943295;
    Vec3 axis;
    const Vec3 to_center = vec3_subtract(sphere.center, light->position);
    if (!vec3_normalize(light->direction, &axis))
        return false;
    const double along = vec3_dot(to_center, axis);
    const double across = vec3_length(vec3_subtract(to_center, vec3_scale(axis, along)));
    const double angle = light->cutoff * RADIANS;
    return across * cos(angle) - along * sin(angle) > sphere.radius * (1 + 1e-9);
}

/* What normals need, for this object's transform. */
typedef enum Transform { ORTHONORMAL, ORTHOGONAL, GENERAL } Transform;

/* Whether the columns of the upper left 3x3 part are perpendicular and of equal length, which makes
 * it its own inverse transpose but for a factor; and whether that length is 1. A difference of
 * 1e-7 turns a normal by less than its rounding to float does. */
static Transform transform_of(Mat4 m)
{
    const double *a = m.m;
    double dots[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            dots[i][j] =
                a[4 * i] * a[4 * j] + a[4 * i + 1] * a[4 * j + 1] + a[4 * i + 2] * a[4 * j + 2];
    const double square = dots[0][0];
    /* Lengths beyond this lose digits, or everything, when a float squares them; the normal matrix
     * comes scaled. */
    if (!(square > 1e-20 && square < 1e20))
        return GENERAL;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (fabs(dots[i][j] - (i == j ? square : 0)) > 1e-7 * square)
                return GENERAL;
    return fabs(square - 1) <= 1e-7 ? ORTHONORMAL : ORTHOGONAL;
}

static void explain_light(FILE *file, const Scene *scene, int number, const LightTerms *terms)
{
    static const char *const kinds[] = {
        [LIGHT_DIRECTIONAL] = "directional", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot"};
    static const char *const black_there = "light or material is black there";
    const bool positional = terms->kind != LIGHT_DIRECTIONAL;
    say(file, "light %d: %s, computed at the %s", number, kinds[terms->kind],
        !terms->at_vertex                             ? "fragments"
        : scene->interpolation == INTERPOLATION_PHONG ? "vertices: it is the same all over a flat "
                                                        "triangle"
        : scene->interpolation == INTERPOLATION_GOURAUD ? "vertices: colours are interpolated"
                                                        : "vertices: of flat triangles");
    say(file, "  %s",
        terms->ambient
            ? "ambient: varies over the surface, for the light does"
            : "without ambient: there is none, or it is the same everywhere, in the base");
    say(file,
        terms->diffuse ? "  diffuse: light and material both have it" : "  without diffuse: %s",
        black_there);
    say(file,
        terms->specular ? "  specular: light and material both have it" : "  without specular: %s",
        black_there);
    if (terms->half_vector)
        say(file, "  half vector: one for all, since light and viewer are at infinity: computed "
                  "once");
    else if (terms->specular)
        say(file, "  without one half vector for all: %s",
            scene->reflection == REFLECTION_PHONG ? "the Phong reflection has none"
            : positional                          ? "the light is near"
                                                  : "the viewer is near");
    say(file,
        terms->attenuation ? "  attenuation: depends on the distance" : "  without attenuation: %s",
        positional ? "it is the same at every distance" : "the light is at infinity");
    if (terms->kind == LIGHT_SPOT)
        say(file, "  spot: only within its cone, %s",
            terms->exponent ? "with a fall-off there" : "without fall-off: its exponent is 0");
}

/* The terms of one light on one object; false, with the reason said, where it has none. */
static bool light_terms(const Scene *scene, const Object *object, int number, Sphere sphere,
                        bool both, LightTerms *terms, FILE *file)
{
    const Light *light = &scene->lights[number];
    const Material *front = &object->front, *back = &object->back;
    const bool positional = light->kind != LIGHT_DIRECTIONAL;
    memset(terms, 0, sizeof *terms); /* padding too: terms are compared as bytes */
    if (light->off) {
        say(file, "without light %d: it is off", number);
        return false;
    }
    if (light->kind == LIGHT_SPOT && cone_misses(light, sphere)) {
        say(file, "without light %d: its cone misses the object", number);
        return false;
    }
    terms->kind = light->kind;
    terms->diffuse = reflected(light->diffuse, front->diffuse, back->diffuse, both);
    terms->specular = reflected(light->specular, front->specular, back->specular, both);
    terms->attenuation = light_fades(light);
    terms->exponent = light->kind == LIGHT_SPOT && light->exponent != 0;
    terms->ambient = light_ambient_varies(light) &&
                     reflected(light->ambient, front->ambient, back->ambient, both);
    if (!terms->diffuse && !terms->specular && !terms->ambient) {
        say(file, "without light %d: it has no colour that the material reflects%s", number,
            reflected(light->ambient, front->ambient, back->ambient, both)
                ? ", but an ambient one, which is the same everywhere and in the base"
                : "");
        return false;
    }
    terms->half_vector = terms->specular && !positional && scene->distant_viewer &&
                         scene->reflection == REFLECTION_BLINN_PHONG;
    const bool same_over_triangle =
        object->flat && !positional && (!terms->specular || scene->distant_viewer);
    terms->at_vertex = scene->interpolation != INTERPOLATION_PHONG || same_over_triangle;
    explain_light(file, scene, number, terms);
    return true;
}

static void add_light(Effects *effects, int number, const LightTerms *terms)
{
    LightGroup *group = effects->groups, *end = group + effects->group_count;
    while (group < end && memcmp(&group->terms, terms, sizeof *terms) != 0)
        group++;
    if (group == end) {
        effects->group_count++;
        group->terms = *terms;
    }
    group->lights[group->count++] = number;
}

/* Emission, global ambient and what ambient light does not vary. */
static bool has_base(const Scene *scene, const Object *object, bool both)
{
    const Material *front = &object->front, *back = &object->back;
    if (!black(front->emission) || (both && !black(back->emission)) ||
        reflected(scene->global_ambient, front->ambient, back->ambient, both))
        return true;
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        if (!light->off && !light_ambient_varies(light) &&
            reflected(light->ambient, front->ambient, back->ambient, both))
            return true;
    }
    return false;
}

static void decide_normals(const Scene *scene, const Object *object, Effects *effects,
                           bool at_fragments, FILE *file)
{
    Mat4 eye_from_world, clip_from_eye;
    if (!effects->normals) {
        say(file, "without normals: nothing depends on them");
        return;
    }
    scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL);
    const Transform transform = transform_of(
        scene_eye_from_object(&scene->camera, eye_from_world, object->world_from_object));
    effects->normal_matrix = transform == GENERAL && !object->wrong_normals;
    if (effects->normal_matrix)
        say(file, "normal matrix: the model-view matrix scales unevenly or shears");
    else if (object->wrong_normals)
        say(file, "without normal matrix: the scene asks for the wrong one, the model-view matrix");
    else
        say(file, "without normal matrix: the model-view matrix is orthogonal, and serves");
    effects->normalize_fragment = at_fragments && !object->flat && !scene->skip_renormalization;
    /* Where fragments make the normal unit, equal lengths at the vertices do no harm. */
    const bool equal_lengths = transform != GENERAL;
    bool at_vertices = object->flat || scene->skip_renormalization;
    for (int i = 0; i < effects->group_count; i++)
        at_vertices |= effects->groups[i].terms.at_vertex;
    effects->normalize_vertex = transform != ORTHONORMAL && (at_vertices || !equal_lengths);
    say(file,
        effects->normalize_vertex
            ? "normals made unit at the vertices: the transform changes their length"
            : "normals not made unit at the vertices: %s",
        transform == ORTHONORMAL ? "the transform keeps their length"
                                 : "the fragments do it, and all are equally long");
    say(file,
        effects->normalize_fragment
            ? "normals made unit at the fragments: interpolated ones are shorter"
            : "normals not made unit at the fragments: %s",
        !at_fragments  ? "no light is computed there"
        : object->flat ? "they are the same all over a triangle"
                       : "the scene asks so");
}

/* Whether the object is a solid that is seen from outside, and not cut by the near plane. */
static bool outside_of(const Scene *scene, const Object *object, Sphere sphere, FILE *file)
{
    Mat4 eye_from_world, clip_from_eye;
    scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL);
    const Vec3 center = scene_eye_point(&scene->camera, eye_from_world, sphere.center);
    const bool outside = object->closed && -center.z - sphere.radius > scene->camera.near;
    say(file,
        outside ? "culling of back faces: a closed object, seen from outside"
                : "without culling: %s",
        object->closed ? "the near plane may cut the object" : "the object is open");
    return outside;
}

/* At the end of the pipeline. */
static void decide_output(const Scene *scene, Effects *effects, bool at_vertices, FILE *file)
{
    const bool clamped = scene->clamp_vertex && scene->interpolation != INTERPOLATION_PHONG;
    effects->clamp_vertex = clamped && at_vertices;
    say(file,
        effects->clamp_vertex ? "clamping at the vertices: asked for"
                              : "without clamping at the vertices: %s",
        !scene->clamp_vertex ? "not asked for" : "their colours are not what is interpolated");
    effects->show_clipped = scene->show_clipped && !clamped;
    say(file,
        effects->show_clipped ? "over-exposed pixels painted: asked for"
                              : "without painting over-exposed pixels: %s",
        scene->show_clipped ? "clamped at the vertices, none is" : "not asked for");
    effects->linear = scene->linear;
    say(file, effects->linear ? "sRGB encoding at the end: asked for"
                              : "without sRGB encoding: not asked for");
}

static Effects decide(const Scene *scene, const Object *object, FILE *file)
{
    Effects effects;
    bool at_vertices = false, at_fragments = false;
    const Sphere sphere = bounding_sphere(object);
    memset(&effects, 0, sizeof effects);
    effects.cull = outside_of(scene, object, sphere, file);
    effects.two_sided = object->two_sided && !effects.cull;
    say(file,
        effects.two_sided ? "two-sided: the back has its own material and the reversed normal"
                          : "without a back: %s",
        object->two_sided ? "it is never seen" : "it is lit as the front");
    effects.base = has_base(scene, object, effects.two_sided);
    say(file, effects.base ? "base: emission or ambient light that is the same everywhere"
                           : "without base: neither emission nor even ambient light");
    effects.alpha = object->front.alpha != 1 || (effects.two_sided && object->back.alpha != 1);
    say(file, effects.alpha ? "alpha: the surface is not opaque"
                            : "without alpha: the surface is opaque");
    for (int i = 0; i < scene->light_count && i < EFFECTS_MOST_LIGHTS; i++) {
        LightTerms terms;
        if (!light_terms(scene, object, i, sphere, effects.two_sided, &terms, file))
            continue;
        add_light(&effects, i, &terms);
        effects.normals |= terms.diffuse || terms.specular;
        /* R.V and N.H alike depend on V, but for a half vector that holds it. */
        effects.local_viewer |= terms.specular && !scene->distant_viewer;
        if (terms.specular)
            effects.reflection = scene->reflection;
        at_vertices |= terms.at_vertex;
        at_fragments |= !terms.at_vertex;
    }
    say(file,
        effects.local_viewer ? "local viewer: the direction to the eye differs from point to point"
                             : "without local viewer: %s",
        scene->distant_viewer ? "it is at infinity" : "nothing is specular");
    decide_normals(scene, object, &effects, at_fragments, file);
    decide_output(scene, &effects, at_vertices, file);
    return effects;
}

Effects effects_of(const Scene *scene, const Object *object)
{
    return decide(scene, object, NULL);
}

void effects_explain(const Scene *scene, const Object *object, FILE *file)
{
    decide(scene, object, file);
}

Effects effects_full(const Scene *scene, const Object *object)
{
    Effects full;
    memset(&full, 0, sizeof full);
    full.alpha = full.base = full.normals = true;
    full.local_viewer = full.two_sided = true;
    full.normal_matrix = full.normalize_vertex = true;
    full.normalize_fragment = !scene->skip_renormalization;
    full.reflection = scene->reflection;
    decide_output(scene, &full, scene->light_count > 0, NULL);
    (void)object;
    if (scene->light_count == 0)
        return full;
    LightGroup *group = &full.groups[0];
    full.group_count = 1;
    group->terms.kind = LIGHT_SPOT;
    group->terms.any = group->terms.ambient = group->terms.diffuse = group->terms.specular = true;
    group->terms.attenuation = group->terms.exponent = true;
    group->terms.at_vertex = scene->interpolation != INTERPOLATION_PHONG;
    for (int i = 0; i < scene->light_count && i < EFFECTS_MOST_LIGHTS; i++)
        group->lights[group->count++] = i;
    return full;
}
