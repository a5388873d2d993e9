#include "scene/effects.h"

#include "shadows/shadow_mask.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* One walk over the scene decides everything and writes each reason to `file`, unless that is NULL,
 * so that --explain cannot differ from what is drawn. */
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

/* Whether a material of reflectivity `front`, or `back` if two-sided, reflects light of this color.
 */
static bool reflected(Vec3 light, Vec3 front, Vec3 back, bool two_sided)
{
    const Vec3 f = {light.x * front.x, light.y * front.y, light.z * front.z};
    const Vec3 b = {light.x * back.x, light.y * back.y, light.z * back.z};
    return !color_is_black(f) || (two_sided && !color_is_black(b));
}

Material effects_material(const Object *object, bool back)
{
    Material material = back && object->two_sided ? object->back : object->front;
    if (object->mesh->colors)
        material.ambient = material.diffuse = (Vec3){1, 1, 1};
    return material;
}

/* Whether a spot's cone misses a sphere: its center lies farther than the radius outside the
 * tangent plane of the cone on its side. */
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

typedef enum Transform { ORTHONORMAL, ORTHOGONAL, GENERAL } Transform;

/* Orthogonal: the columns of the upper left 3x3 part are perpendicular and of equal length, so that
 * it is its own inverse transpose up to a factor. Orthonormal: that length is 1. A difference of
 * 1e-7 rotates a normal by less than rounding to float. */
static Transform transform_of(Mat4 m)
{
    const double *a = m.m;
    double dots[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            dots[i][j] =
                a[4 * i] * a[4 * j] + a[4 * i + 1] * a[4 * j + 1] + a[4 * i + 2] * a[4 * j + 2];
    const double square = dots[0][0];
    /* The squares of other lengths lose digits, or overflow, in a fragment's 16-bit float. The
     * normal matrix is scaled. */
    if (!(square > 1e-4 && square < 1e4))
        return GENERAL;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (fabs(dots[i][j] - (i == j ? square : 0)) > 1e-7 * square)
                return GENERAL;
    return fabs(square - 1) <= 1e-7 ? ORTHONORMAL : ORTHOGONAL;
}

/* Whether the attenuation of a light at the object needs a guard: its denominator may vanish in
 * float, or the square of a distance overflow. */
static bool attenuation_guarded(const Light *light, Sphere sphere)
{
    static const double FAR = 1e18; /* its square fits into a float */
    const double distance = vec3_length(vec3_subtract(sphere.center, light->position));
    return light_fades(light) && !(light->constant > 1e-29 && distance + sphere.radius < FAR);
}

static void explain_light(FILE *file, const Scene *scene, int number, const LightTerms *terms)
{
    static const char *const kinds[] = {
        [LIGHT_DIRECTIONAL] = "directional", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot"};
    static const char *const black = "black in light or material";
    const bool positional = terms->kind != LIGHT_DIRECTIONAL;
    say(file, "light %d: %s, computed at the %s", number, kinds[terms->kind],
        !terms->at_vertex                               ? "fragments"
        : scene->interpolation == INTERPOLATION_PHONG   ? "vertices: constant over a flat triangle"
        : scene->interpolation == INTERPOLATION_GOURAUD ? "vertices: colours are interpolated"
        : scene->interpolation == INTERPOLATION_FLAT    ? "vertices: of flat triangles"
                                                        : "last vertex of each triangle");
    say(file, "  %s",
        terms->ambient ? "ambient: varies over the surface, as the light does"
                       : "without ambient: none, or constant and part of the base");
    say(file, terms->diffuse ? "  diffuse: in light and material" : "  without diffuse: %s", black);
    say(file, terms->specular ? "  specular: in light and material" : "  without specular: %s",
        black);
    if (terms->half_vector)
        say(file, "  half vector: a uniform, because light and viewer are at infinity");
    else if (terms->specular)
        say(file, "  without half vector as a uniform: %s",
            scene->reflection == REFLECTION_PHONG ? "the Phong reflection has none"
            : positional                          ? "the light is near"
                                                  : "the viewer is near");
    say(file,
        terms->attenuation ? "  attenuation: depends on the distance" : "  without attenuation: %s",
        positional ? "constant" : "the light is at infinity");
    if (terms->kind == LIGHT_SPOT)
        say(file, "  spot: only within its cone, %s",
            terms->exponent ? "with falloff" : "without falloff: its exponent is 0");
    if (scene->lights[number].shadows)
        say(file, "  %s",
            terms->shadow ? "shadow: looked up, because a surface may come between"
                          : "without shadow: no surface can come between");
}

/* The terms of one light on one object; false if it has none. */
static bool light_terms(const Scene *scene, const Object *object, int number, const Light *light,
                        Sphere sphere, bool both, bool shadowed, LightTerms *terms, FILE *file)
{
    const Material front_side = effects_material(object, false), *front = &front_side;
    const Material back_side = effects_material(object, true), *back = &back_side;
    const bool positional = light->kind != LIGHT_DIRECTIONAL;
    memset(terms, 0, sizeof *terms); /* including padding: terms are compared as bytes */
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
        say(file, "without light %d: the material reflects none of its colour%s", number,
            reflected(light->ambient, front->ambient, back->ambient, both)
                ? " but the ambient, which is constant and part of the base"
                : "");
        return false;
    }
    terms->half_vector = terms->specular && !positional && scene->distant_viewer &&
                         scene->reflection == REFLECTION_BLINN_PHONG;
    const bool same_over_triangle =
        object->flat && !positional && (!terms->specular || scene->distant_viewer);
    if (shadowed && (terms->diffuse || terms->specular))
        terms->shadow = 1 + effects_channel(scene, number) / SHADOW_CHANNELS;
    terms->at_vertex =
        scene->interpolation != INTERPOLATION_PHONG || (same_over_triangle && !terms->shadow);
    explain_light(file, scene, number, terms);
    if (terms->attenuation)
        say(file, attenuation_guarded(light, sphere)
                      ? "  guard of the attenuation: its denominator may be 0, or overflow"
                      : "  without guard of the attenuation: its constant coefficient is not 0");
    return true;
}

static void add_light(Effects *effects, int number, const LightTerms *terms, bool guarded)
{
    LightGroup *group = effects->groups, *end = group + effects->group_count;
    while (group < end && memcmp(&group->terms, terms, sizeof *terms) != 0)
        group++;
    if (group == end) {
        effects->group_count++;
        group->terms = *terms;
    }
    group->guard_attenuation |= guarded;
    group->lights[group->count++] = number;
}

/* Emission, global ambient and constant ambient light. */
static bool has_base(const Scene *scene, const Object *object, bool both)
{
    const Material front_side = effects_material(object, false), *front = &front_side;
    const Material back_side = effects_material(object, true), *back = &back_side;
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

static void decide_normals(const Scene *scene, const Object *object, Effects *effects,
                           bool at_fragments, FILE *file)
{
    Mat4 eye_from_world, clip_from_eye;
    if (!effects->normals) {
        say(file, "without normals: no term depends on them");
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
        say(file, "without normal matrix: the scene requests the wrong one, the model-view matrix");
    else
        say(file, "without normal matrix: the model-view matrix is orthogonal");
    effects->normalize_fragment = at_fragments && !object->flat && !scene->skip_renormalization;
    /* If fragments normalize, equal lengths at the vertices do not matter. */
    const bool equal_lengths = transform != GENERAL;
    bool at_vertices = object->flat || scene->skip_renormalization;
    for (int i = 0; i < effects->group_count; i++)
        at_vertices |= effects->groups[i].terms.at_vertex;
    effects->normalize_vertex = transform != ORTHONORMAL && (at_vertices || !equal_lengths);
    say(file,
        effects->normalize_vertex
            ? "normals normalized at the vertices: the transform changes their length"
            : "normals not normalized at the vertices: %s",
        transform == ORTHONORMAL ? "the transform keeps their length"
                                 : "the fragments do it, and all lengths are equal");
    say(file,
        effects->normalize_fragment
            ? "normals normalized at the fragments: interpolation shortens them"
            : "normals not normalized at the fragments: %s",
        !at_fragments  ? "no light is computed there"
        : object->flat ? "constant over a triangle"
                       : "the scene skips it");
}

/* Shadows */

int effects_channel(const Scene *scene, int light)
{
    int channel = 0;
    for (int i = 0; i < light; i++)
        channel += scene->lights[i].shadows;
    return channel;
}

/* Whether the object is closed, seen from outside, and not cut by the near plane. */
static bool outside_of(const Scene *scene, const Object *object, Sphere sphere, FILE *file)
{
    Mat4 eye_from_world, clip_from_eye;
    scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL);
    const Vec3 center = scene_eye_point(&scene->camera, eye_from_world, sphere.center);
    const bool outside =
        object->closed && !object->clockwise && -center.z - sphere.radius > scene->camera.near;
    say(file,
        outside ? "culling of back faces: a closed object, seen from outside"
                : "without culling: %s",
        !object->closed     ? "the object is open"
        : object->clockwise ? "front faces are clockwise"
                            : "the near plane may cut the object");
    return outside;
}

bool effects_may_shadow(const Scene *scene, int light, int occluder, int receiver,
                        const MeshBox *boxes, const PlacedBox *placed)
{
    const Object *before = &scene->objects[occluder], *behind = &scene->objects[receiver];
    const Light *given = &scene->lights[light];
    if (!given->shadows || given->off || before->lamp ||
        (color_is_black(given->diffuse) && color_is_black(given->specular)))
        return false;
    const Light world = scene_world_light(scene, light);
    if (world.kind == LIGHT_SPOT && (cone_misses(&world, scene_sphere(before, &boxes[occluder])) ||
                                     cone_misses(&world, scene_sphere(behind, &boxes[receiver]))))
        return false;
    /* What is seen from the eye sees a light there. */
    const Vec3 to_eye = vec3_subtract(world.position, scene->camera.eye);
    if (world.kind != LIGHT_DIRECTIONAL && vec3_length(to_eye) == 0)
        return false;
    if (occluder == receiver)
        return !object_is_convex(before);
    return may_come_between(&placed[occluder], &placed[receiver], light_place(&world));
}

/* The lights in whose shadow an object may lie; all that have one if it is not the scene's. */
static uint32_t shadowed_by(const Scene *scene, const Object *object)
{
    uint32_t lights = 0;
    bool any = false;
    for (int l = 0; l < scene->light_count; l++)
        any |= scene->lights[l].shadows;
    const size_t count = (size_t)scene->object_count + 1;
    MeshBox *boxes = any ? malloc(count * sizeof *boxes) : NULL;
    PlacedBox *placed = any ? malloc(count * sizeof *placed) : NULL;
    for (int i = 0; boxes && placed && i < scene->object_count; i++) {
        boxes[i] = mesh_bounds(scene->objects[i].mesh);
        placed[i] = placed_box(&boxes[i], scene->objects[i].world_from_object);
    }
    const bool own = object >= scene->objects && object < scene->objects + scene->object_count;
    for (int l = 0; any && l < scene->light_count && l < EFFECTS_MAX_LIGHTS; l++)
        for (int o = 0; o < scene->object_count; o++)
            if (!boxes || !placed || !own ||
                effects_may_shadow(scene, l, o, (int)(object - scene->objects), boxes, placed))
                lights |= scene->lights[l].shadows ? (uint32_t)1 << l : 0;
    free(boxes);
    free(placed);
    return lights;
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

static void decide_output(const Scene *scene, Effects *effects, bool at_vertices, FILE *file)
{
    const bool clamped = scene->clamp_vertex && scene->interpolation != INTERPOLATION_PHONG;
    effects->clamp_vertex = clamped && at_vertices;
    say(file,
        effects->clamp_vertex ? "clamping at the vertices: requested"
                              : "without clamping at the vertices: %s",
        !scene->clamp_vertex ? "not requested" : "colours are not interpolated");
    effects->show_clipped = scene->show_clipped && !clamped;
    say(file,
        effects->show_clipped ? "overexposed pixels highlighted: requested"
                              : "without highlighting overexposed pixels: %s",
        scene->show_clipped ? "colours are clamped at the vertices" : "not requested");
    effects->linear = scene->linear;
    say(file,
        effects->linear ? "sRGB encoding: requested" : "without sRGB encoding: not requested");
    /* llvmpipe without AVX makes integers of 255 times a color, and black of what exceeds them;
     * colors of the vertices that exceed 16 bits are infinite in mediump. */
    effects->limit = brightest(scene) > 6e4;
    if (effects->limit)
        say(file, "colours limited: drivers may draw very large ones as black");
}

static Effects decide(const Scene *scene, const Object *object, const MeshBox *box,
                      uint32_t shadowed, FILE *file)
{
    Effects effects;
    bool at_vertices = false, at_fragments = false;
    const Sphere sphere = scene_sphere(object, box);
    memset(&effects, 0, sizeof effects);
    effects.cull = outside_of(scene, object, sphere, file);
    effects.two_sided = object->two_sided && !effects.cull;
    say(file,
        effects.two_sided ? "two-sided: the back has its own material and the opposite normal"
                          : "without a back side: %s",
        object->two_sided ? "it is never seen" : "it is lit like the front");
    effects.lit_positions = scene->interpolation == INTERPOLATION_CONSTANT;
    effects.base = has_base(scene, object, effects.two_sided);
    bool colored = effects.base;
    say(file, effects.base ? "base: emission or constant ambient light"
                           : "without base: neither emission nor constant ambient light");
    effects.alpha = object->front.alpha != 1 || (effects.two_sided && object->back.alpha != 1);
    say(file, effects.alpha ? "alpha: the surface is not opaque"
                            : "without alpha: the surface is opaque");
    for (int i = 0; i < scene->light_count && i < EFFECTS_MAX_LIGHTS; i++) {
        LightTerms terms;
        const Light light = scene_world_light(scene, i);
        if (!light_terms(scene, object, i, &light, sphere, effects.two_sided, shadowed >> i & 1,
                         &terms, file))
            continue;
        add_light(&effects, i, &terms, attenuation_guarded(&light, sphere));
        effects.normals |= terms.diffuse || terms.specular;
        colored |= terms.ambient || terms.diffuse;
        /* R.V and N.H both depend on V. */
        effects.local_viewer |= terms.specular && !scene->distant_viewer;
        if (terms.specular)
            effects.reflection = scene->reflection;
        at_vertices |= terms.at_vertex;
        at_fragments |= !terms.at_vertex;
    }
    effects.vertex_color = object->mesh->colors && colored;
    if (object->mesh->colors)
        say(file, effects.vertex_color
                      ? "vertex colours: the mesh has them, instead of ambient and diffuse colour"
                      : "without vertex colours: no term depends on them");
    say(file,
        effects.local_viewer ? "local viewer: the direction to the eye varies over the surface"
                             : "without local viewer: %s",
        scene->distant_viewer ? "the viewer is at infinity" : "no term is specular");
    decide_normals(scene, object, &effects, at_fragments, file);
    /* The base varies over the surface as the colors of its vertices do. */
    decide_output(scene, &effects, at_vertices || (effects.base && effects.vertex_color), file);
    return effects;
}

Effects effects_of_boxed(const Scene *scene, const Object *object, const MeshBox *box,
                         uint32_t shadowed)
{
    return decide(scene, object, box, shadowed, NULL);
}

Effects effects_of(const Scene *scene, const Object *object)
{
    const MeshBox box = mesh_bounds(object->mesh);
    return decide(scene, object, &box, shadowed_by(scene, object), NULL);
}

void effects_explain(const Scene *scene, const Object *object, FILE *file)
{
    const MeshBox box = mesh_bounds(object->mesh);
    decide(scene, object, &box, shadowed_by(scene, object), file);
}

Effects effects_full(const Scene *scene, const Object *object)
{
    Effects full;
    memset(&full, 0, sizeof full);
    full.vertex_color = object->mesh->colors != NULL;
    full.alpha = full.base = full.normals = true;
    full.local_viewer = full.two_sided = true;
    full.normal_matrix = full.normalize_vertex = true;
    full.normalize_fragment = !scene->skip_renormalization;
    full.reflection = scene->reflection;
    full.lit_positions = scene->interpolation == INTERPOLATION_CONSTANT;
    decide_output(scene, &full, true, NULL);
    for (int i = 0; i < scene->light_count && i < EFFECTS_MAX_LIGHTS; i++) {
        LightTerms terms;
        memset(&terms, 0, sizeof terms);
        terms.kind = LIGHT_SPOT;
        terms.any = terms.ambient = terms.diffuse = terms.specular = true;
        terms.attenuation = terms.exponent = true;
        terms.at_vertex = scene->interpolation != INTERPOLATION_PHONG;
        if (scene->lights[i].shadows)
            terms.shadow = 1 + effects_channel(scene, i) / SHADOW_CHANNELS;
        add_light(&full, i, &terms, true);
    }
    return full;
}
