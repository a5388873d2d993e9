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

/* Whether light of this colour is reflected by reflectivity `front`, or `back` where that counts.
 */
static bool reflected(Vec3 light, Vec3 front, Vec3 back, bool two_sided)
{
    const Vec3 f = {light.x * front.x, light.y * front.y, light.z * front.z};
    const Vec3 b = {light.x * back.x, light.y * back.y, light.z * back.z};
    return !color_is_black(f) || (two_sided && !color_is_black(b));
}

MeshFacts mesh_facts(const Mesh *mesh)
{
    MeshFacts facts = {.low = {INFINITY, INFINITY, INFINITY},
                       .high = {-INFINITY, -INFINITY, -INFINITY},
                       .least_normal = INFINITY,
                       .most_normal = 0,
                       .least_cosine = 1};
    Vec3 *low = &facts.low, *high = &facts.high;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const Vec3 p = vec3_from_float(mesh->vertices[i].position);
        const double length = vec3_length(vec3_from_float(mesh->vertices[i].normal));
        *low = (Vec3){fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z)};
        *high = (Vec3){fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z)};
        /* One that is no number has no length. */
        facts.least_normal = length >= 0 ? fmin(facts.least_normal, length) : 0;
        facts.most_normal = fmax(facts.most_normal, length);
    }
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        Vec3 n[3];
        for (size_t k = 0; k < 3; k++)
            n[k] = vec3_from_float(mesh->vertices[mesh->indices[i + k]].normal);
        for (int k = 0; k < 3; k++) {
            const Vec3 a = n[k], b = n[(k + 1) % 3];
            const double cosine = vec3_dot(a, b) / sqrt(vec3_dot(a, a) * vec3_dot(b, b));
            facts.least_cosine = fmin(facts.least_cosine, cosine);
        }
    }
    return facts;
}

static Vec3 column_of(Mat4 m, int column)
{
    return (Vec3){m.m[4 * column], m.m[4 * column + 1], m.m[4 * column + 2]};
}

/* What an object is within, in the world: its mesh's box, transformed, as a sphere around that and
 * as the slabs between its opposite faces. */
typedef struct Sphere {
    Vec3 center;
    double radius;
} Sphere;

typedef struct Bounds {
    Sphere sphere;
    Vec3 normals[3]; /* unit; zero where the slab has none */
    double halves[3];
} Bounds;

static Bounds bounds_of(const Object *object, const MeshFacts *facts)
{
    const Mat4 m = object->world_from_object;
    const Vec3 axes[3] = {column_of(m, 0), column_of(m, 1), column_of(m, 2)};
    const Vec3 half = vec3_scale(vec3_subtract(facts->high, facts->low), 0.5);
    const Vec3 edges[3] = {vec3_scale(axes[0], half.x), vec3_scale(axes[1], half.y),
                           vec3_scale(axes[2], half.z)};
    Bounds bounds = {.sphere.center = mat4_transform_point(m, vec3_add(facts->low, half))};
    for (int corner = 0; corner < 4; corner++) { /* the other four lie opposite */
        const Vec3 to_corner =
            vec3_add(edges[0], vec3_add(vec3_scale(edges[1], corner & 1 ? -1 : 1),
                                        vec3_scale(edges[2], corner & 2 ? -1 : 1)));
        bounds.sphere.radius = fmax(bounds.sphere.radius, vec3_length(to_corner));
    }
    for (int i = 0; i < 3; i++) {
        vec3_normalize(vec3_cross(axes[(i + 1) % 3], axes[(i + 2) % 3]), &bounds.normals[i]);
        for (int k = 0; k < 3; k++)
            bounds.halves[i] += fabs(vec3_dot(bounds.normals[i], edges[k]));
    }
    return bounds;
}

/* The least distance that a segment has from the object, or less; negative where they may meet. */
static double gap_of(const Bounds *bounds, Vec3 from, Vec3 to)
{
    const Vec3 center = bounds->sphere.center;
    const Vec3 way = vec3_subtract(to, from), a = vec3_subtract(from, center);
    const Vec3 b = vec3_subtract(to, center);
    const double square = vec3_dot(way, way);
    const double share = square > 0 ? fmin(fmax(-vec3_dot(a, way) / square, 0), 1) : 0;
    double gap = vec3_length(vec3_add(a, vec3_scale(way, share))) - bounds->sphere.radius;
    for (int i = 0; i < 3; i++) {
        const double at_a = vec3_dot(a, bounds->normals[i]);
        const double at_b = vec3_dot(b, bounds->normals[i]);
        gap = fmax(gap, fmin(at_a, at_b) - bounds->halves[i]);
        gap = fmax(gap, fmin(-at_a, -at_b) - bounds->halves[i]);
    }
    return gap;
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
    /* Lengths beyond this lose digits, or everything, when a float squares them, which at fragments
     * may have 16 bits; the normal matrix comes scaled. */
    if (!(square > 1e-4 && square < 1e4))
        return GENERAL;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (fabs(dots[i][j] - (i == j ? square : 0)) > 1e-7 * square)
                return GENERAL;
    return fabs(square - 1) <= 1e-7 ? ORTHONORMAL : ORTHOGONAL;
}

/* Guards. One is left out where its bound is never reached, so that it would change nothing. Each
 * proof leaves a margin for what rounding and interpolation in floats add. */

/* How far anything must stay away from an object: a hundredth of its farthest point's distance from
 * the eye, and of that of the light as much as its rounding. */
static double margin_of(const Scene *scene, const Bounds *bounds, Vec3 light)
{
    const Vec3 eye = scene->camera.eye;
    return 1e-14 +
           0.01 * (vec3_length(vec3_subtract(bounds->sphere.center, eye)) + bounds->sphere.radius) +
           1e-6 * vec3_length(vec3_subtract(light, eye));
}

/* Whether light and viewer may be opposite each other at a point of the object. They are where it
 * lies between them: on the segment from the eye to the light, or on the ray from the one that is
 * near towards the one at infinity. Off it by a share of its distance, L + V has at least that
 * share for its length. */
static bool opposite(const Scene *scene, const Light *light, const Bounds *bounds)
{
    static const double FAR = 1e18; /* no coordinate is so large */
    const Camera *camera = &scene->camera;
    const bool positional = light->kind != LIGHT_DIRECTIONAL;
    Vec3 from = camera->eye, to = light->position, unit;
    if (scene->distant_viewer || !positional) {
        from = positional ? light->position : camera->eye;
        if (!vec3_normalize(
                positional ? vec3_subtract(camera->eye, camera->center) : light->direction, &unit))
            return true;
        to = vec3_add(from, vec3_scale(unit, FAR));
    }
    const double margin = margin_of(scene, bounds, positional ? light->position : camera->eye);
    return !(gap_of(bounds, from, to) > margin);
}

static LightGuards light_guards(const Scene *scene, const Light *light, const Bounds *bounds,
                                const LightTerms *terms, FILE *file)
{
    static const double FAR = 1e18; /* its square is a float */
    LightGuards guards = {false, false, false};
    if (light->kind != LIGHT_DIRECTIONAL) {
        /* Outside the bounds there is a distance to divide by. */
        const double gap = gap_of(bounds, light->position, light->position);
        guards.distance = !(gap > margin_of(scene, bounds, light->position));
        say(file, guards.distance ? "  guard of the distance: the light may touch the object"
                                  : "  without guard of the distance: the light is outside the "
                                    "object");
        /* The denominator is least where the light is nearest. */
        const double least = guards.distance ? 0 : gap;
        guards.attenuation =
            terms->attenuation &&
            (!(light->constant + least * (light->linear + least * light->quadratic) > 1e-29) ||
             !(vec3_length(vec3_subtract(bounds->sphere.center, light->position)) +
                   bounds->sphere.radius <
               FAR));
    }
    if (terms->attenuation)
        say(file, guards.attenuation
                      ? "  guard of the attenuation: its denominator may be 0, or too large"
                      : "  without guard of the attenuation: its denominator is never 0");
    if (terms->specular && scene->reflection == REFLECTION_BLINN_PHONG && !terms->half_vector) {
        guards.half_vector = opposite(scene, light, bounds);
        say(file, guards.half_vector
                      ? "  guard of the half vector: the object may lie between light and viewer"
                      : "  without guard of the half vector: the object does not lie between light "
                        "and viewer");
    }
    return guards;
}

/* How many times as far a matrix's upper left 3x3 part may stretch one direction as another, its
 * condition k. The square roots of the sums of squares of its entries, the size, and of those of
 * its inverse have a product of at least k + 1 + 1 / k. */
static double stretch_of(Mat4 m, double *size)
{
    double squares = 0, of_cofactors = 0, determinant = 0;
    for (int i = 0; i < 3; i++) {
        const Vec3 a = column_of(m, i);
        const Vec3 cofactor = vec3_cross(column_of(m, (i + 1) % 3), column_of(m, (i + 2) % 3));
        squares += vec3_dot(a, a);
        of_cofactors += vec3_dot(cofactor, cofactor);
        determinant = vec3_dot(a, cofactor);
    }
    *size = sqrt(squares);
    const double sum = sqrt(squares * of_cofactors) / fabs(determinant) - 1;
    return 0.5 * (sum + sqrt(fmax(sum * sum - 4, 0)));
}

/* Where normals made unit may have no length. */
static void guard_normals(const MeshFacts *facts, Mat4 matrix, Effects *effects, FILE *file)
{
    double size;
    const double stretch = stretch_of(matrix, &size);
    /* About unit normals, and no direction shrunk to rounding. */
    const bool sound = facts->least_normal > 0.5 && facts->most_normal < 2 && size > 1e-9 &&
                       size < 1e9 && stretch < 1e4;
    /* If all angles between vectors are less than 90 degrees, the square of their weighted mean is
     * at least a third of the least of theirs. A matrix makes of the angle a at most b, where
     * tan(b / 2) = stretch tan(a / 2) (Wielandt's inequality). */
    const double cosine = facts->least_cosine;
    const bool together = stretch * sqrt((1 - cosine) / (1 + cosine)) < 0.9;
    effects->guard_vertex = effects->normalize_vertex && !sound;
    effects->guard_fragment = effects->normalize_fragment && !(sound && together);
    if (effects->normalize_vertex)
        say(file, effects->guard_vertex
                      ? "guard of normals at the vertices: one may have no length"
                      : "without guard of normals at the vertices: all have a length");
    if (effects->normalize_fragment)
        say(file,
            !effects->guard_fragment ? "without guard of normals at the fragments: those of a "
                                       "triangle cannot cancel"
            : sound ? "guard of normals at the fragments: those of a triangle may cancel"
                    : "guard of normals at the fragments: one at a vertex may have no length");
}

/* What is seen is beyond the near plane; vertices may be anywhere. */
static void guard_viewer(const Scene *scene, const Bounds *bounds, Effects *effects, FILE *file)
{
    const Vec3 eye = scene->camera.eye;
    const bool away = gap_of(bounds, eye, eye) > margin_of(scene, bounds, eye);
    bool at_vertex = false;
    for (int g = 0; g < effects->group_count; g++)
        at_vertex |= effects->groups[g].terms.at_vertex && effects->groups[g].terms.specular;
    effects->guard_viewer =
        effects->local_viewer && !(scene->camera.near > 1e-14 && (away || !at_vertex));
    if (effects->local_viewer)
        say(file, effects->guard_viewer ? "guard of the viewer's direction: a vertex may be at the "
                                          "eye"
                  : at_vertex ? "without guard of the viewer's direction: the eye is outside the "
                                "object"
                              : "without guard of the viewer's direction: nearer than the near "
                                "plane nothing is seen");
}

void effects_guard(Effects *effects)
{
    effects->guard_vertex = effects->normalize_vertex;
    effects->guard_fragment = effects->normalize_fragment;
    effects->guard_viewer = effects->local_viewer;
    for (int g = 0; g < effects->group_count; g++) {
        const LightTerms *terms = &effects->groups[g].terms;
        effects->groups[g].guards =
            (LightGuards){.distance = terms->kind != LIGHT_DIRECTIONAL,
                          .attenuation = terms->attenuation,
                          .half_vector = terms->specular && !terms->half_vector &&
                                         effects->reflection == REFLECTION_BLINN_PHONG};
    }
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

static void add_light(Effects *effects, int number, const LightTerms *terms, LightGuards guards)
{
    LightGroup *group = effects->groups, *end = group + effects->group_count;
    while (group < end && memcmp(&group->terms, terms, sizeof *terms) != 0)
        group++;
    if (group == end) {
        effects->group_count++;
        group->terms = *terms;
    }
    group->guards.distance |= guards.distance;
    group->guards.attenuation |= guards.attenuation;
    group->guards.half_vector |= guards.half_vector;
    group->lights[group->count++] = number;
}

/* Emission, global ambient and what ambient light does not vary. */
static bool has_base(const Scene *scene, const Object *object, bool both)
{
    const Material *front = &object->front, *back = &object->back;
    if (!color_is_black(front->emission) || (both && !color_is_black(back->emission)) ||
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

static void decide_normals(const Scene *scene, const Object *object, const MeshFacts *facts,
                           Effects *effects, bool at_fragments, FILE *file)
{
    Mat4 eye_from_world, clip_from_eye;
    if (!effects->normals) {
        say(file, "without normals: nothing depends on them");
        return;
    }
    scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL);
    const Mat4 eye_from_object =
        scene_eye_from_object(&scene->camera, eye_from_world, object->world_from_object);
    const Transform transform = transform_of(eye_from_object);
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
    Mat4 matrix = eye_from_object;
    if (effects->normal_matrix)
        mat4_normal(eye_from_object, &matrix);
    guard_normals(facts, matrix, effects, file);
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

static Effects decide(const Scene *scene, const Object *object, const MeshFacts *facts, FILE *file)
{
    Effects effects;
    bool at_vertices = false, at_fragments = false;
    const Bounds bounds = bounds_of(object, facts);
    memset(&effects, 0, sizeof effects);
    effects.cull = outside_of(scene, object, bounds.sphere, file);
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
        if (!light_terms(scene, object, i, bounds.sphere, effects.two_sided, &terms, file))
            continue;
        add_light(&effects, i, &terms,
                  light_guards(scene, &scene->lights[i], &bounds, &terms, file));
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
    guard_viewer(scene, &bounds, &effects, file);
    decide_normals(scene, object, facts, &effects, at_fragments, file);
    decide_output(scene, &effects, at_vertices, file);
    return effects;
}

Effects effects_of_facts(const Scene *scene, const Object *object, const MeshFacts *facts)
{
    return decide(scene, object, facts, NULL);
}

Effects effects_of(const Scene *scene, const Object *object)
{
    const MeshFacts facts = mesh_facts(object->mesh);
    return decide(scene, object, &facts, NULL);
}

void effects_explain(const Scene *scene, const Object *object, FILE *file)
{
    const MeshFacts facts = mesh_facts(object->mesh);
    decide(scene, object, &facts, file);
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
    if (scene->light_count == 0) {
        effects_guard(&full);
        return full;
    }
    LightGroup *group = &full.groups[0];
    full.group_count = 1;
    group->terms.kind = LIGHT_SPOT;
    group->terms.any = group->terms.ambient = group->terms.diffuse = group->terms.specular = true;
    group->terms.attenuation = group->terms.exponent = true;
    group->terms.at_vertex = scene->interpolation != INTERPOLATION_PHONG;
    for (int i = 0; i < scene->light_count && i < EFFECTS_MOST_LIGHTS; i++)
        group->lights[group->count++] = i;
    effects_guard(&full);
    return full;
}
