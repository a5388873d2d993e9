/*
 * One walk over the facts decides everything and writes each reason, if there is a file for them,
 * so that --explain cannot differ from what is drawn. The terms are those of the OpenGL 1.1
 * specification, section 2.13.1; one is left out where it would add zero to every pixel.
 */
#include "scene/effects.h"

#include "shadows/shadow_mask.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

static_assert(sizeof(LightTerms) == 2 * sizeof(int) + 12, "no padding");
static_assert(sizeof(Effects) == 16 + sizeof(int) + EFFECTS_MAX_LIGHTS * sizeof(LightGroup),
              "none");

/* The decision */

typedef struct Decision {
    const SceneFacts *scene;
    const ObjectFacts *object;
    bool at_vertices, at_fragments; /* where a light is computed */
    FILE *why;
    Effects effects;
} Decision;

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

/* Whether a side that is seen reflects light of a color. */
static bool reflected(const Decision *made, uint8_t light, uint8_t front, uint8_t back)
{
    return (light & front) || (made->effects.two_sided && (light & back));
}

static bool varies(const LightFacts *light)
{
    return light->kind == LIGHT_SPOT || light->fades;
}

const char *const EFFECTS_REACHES[REACH_COUNT] = {
    [REACH_YES] = "it reaches the object",
    [REACH_OFF] = "it is off",
    [REACH_RANGE] = "the object is beyond its range",
    [REACH_CONE] = "its cone misses the object",
    [REACH_BEHIND] = "all of the surface turns away from it",
    [REACH_BLACK] = "the material reflects none of its colour",
    [REACH_FAINT] = "too faint: with all that are less than half a step of 1/255",
    [REACH_MORE] = "lights but the 32 brightest: left out",
};

/* Where nothing of it is reflected; a negative N.L may take light away. */
static bool is_behind(const Decision *made, int number)
{
    const SceneFacts *scene = made->scene;
    return (made->object->behind >> number & 1) &&
           (!scene->signed_dots || scene->lights[number].shadows);
}

static void explain_light(const Decision *made, int number, const LightTerms *terms)
{
    static const char *const kinds[] = {
        [LIGHT_DIRECTIONAL] = "directional", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot"};
    const char *const black =
        is_behind(made, number) ? EFFECTS_REACHES[REACH_BEHIND] : "black in light or material";
    const int interpolation = made->scene->interpolation;
    const bool positional = terms->kind != LIGHT_DIRECTIONAL;
    FILE *why = made->why;
    say(why, "light %d: %s, computed at the %s", made->scene->numbers[number], kinds[terms->kind],
        !terms->at_vertex                        ? "fragments"
        : interpolation == INTERPOLATION_PHONG   ? "vertices: constant over a flat triangle"
        : interpolation == INTERPOLATION_GOURAUD ? "vertices: colours are interpolated"
        : interpolation == INTERPOLATION_FLAT    ? "vertices: of flat triangles"
                                                 : "last vertex of each triangle");
    say(why, "  %s",
        terms->ambient ? "ambient: varies over the surface, as the light does"
                       : "without ambient: none, or constant and part of the base");
    say(why, terms->diffuse ? "  diffuse: in light and material" : "  without diffuse: %s", black);
    say(why, terms->specular ? "  specular: in light and material" : "  without specular: %s",
        black);
    if (terms->half_vector)
        say(why, "  half vector: a uniform, because light and viewer are at infinity");
    else if (terms->specular)
        say(why, "  without half vector as a uniform: %s",
            made->scene->reflection == REFLECTION_PHONG ? "the Phong reflection has none"
            : positional                                ? "the light is near"
                                                        : "the viewer is near");
    say(why,
        terms->attenuation ? "  attenuation: depends on the distance" : "  without attenuation: %s",
        positional ? "constant" : "the light is at infinity");
    if (terms->range)
        say(why, "  range: it ends at a distance");
    if (terms->kind == LIGHT_SPOT)
        say(why, "  spot: only within its cone, %s",
            terms->exponent ? "with falloff" : "without falloff: its exponent is 0");
    if (made->scene->lights[number].shadows)
        say(why, "  %s",
            terms->shadow ? "shadow: looked up, because a surface may come between"
                          : "without shadow: no surface can come between");
    if (made->scene->signed_dots && terms->diffuse)
        say(why, terms->signed_dots
                     ? "  dot products not clamped: requested; where N.L is negative, the light "
                       "takes light away"
                     : "  dot products clamped: none of a light with shadows arrives from behind");
    if (terms->attenuation)
        say(why, made->object->guarded >> number & 1
                     ? "  guard of the attenuation: its denominator may be 0, or overflow"
                     : "  without guard of the attenuation: its constant coefficient is not 0");
}

/* The terms of a light that is on and does not miss; false if the material reflects none. */
static bool reflected_terms(const Decision *made, int number, LightTerms *terms)
{
    const LightFacts *light = &made->scene->lights[number];
    const bool behind = is_behind(made, number);
    const SideFacts *front = &made->object->front, *back = &made->object->back;
    memset(terms, 0, sizeof *terms);
    terms->kind = (LightKind)light->kind;
    terms->diffuse = !behind && reflected(made, light->diffuse, front->diffuse, back->diffuse);
    terms->specular = !behind && reflected(made, light->specular, front->specular, back->specular);
    terms->attenuation = light->fades;
    terms->exponent = light->exponent;
    terms->range = light->range;
    terms->signed_dots = made->scene->signed_dots && terms->diffuse && !light->shadows;
    terms->ambient =
        varies(light) && reflected(made, light->ambient, front->ambient, back->ambient);
    return terms->diffuse || terms->specular || terms->ambient;
}

/* False if the light adds nothing to the object. */
static bool decide_terms(const Decision *made, int number, LightTerms *terms)
{
    const SceneFacts *scene = made->scene;
    const ObjectFacts *object = made->object;
    const LightFacts *light = &scene->lights[number];
    const bool positional = light->kind != LIGHT_DIRECTIONAL;
    const int named = scene->numbers[number];
    const EffectsReach reach = light->off                           ? REACH_OFF
                               : object->missed >> number & 1       ? REACH_CONE
                               : object->beyond_range >> number & 1 ? REACH_RANGE
                                                                    : REACH_YES;
    if (reach) {
        say(made->why, "without light %d: %s", named, EFFECTS_REACHES[reach]);
        return false;
    }
    if (object->faint >> number & 1) {
        say(made->why,
            "without light %d: too faint: at most %.1f steps of 1/255, with all that are less than half",
            named, ceil(10 * (double)object->steps[number]) / 10);
        return false;
    }
    if (!reflected_terms(made, number, terms)) {
        say(made->why, "without light %d: %s%s", named,
            EFFECTS_REACHES[is_behind(made, number) ? REACH_BEHIND : REACH_BLACK],
            reflected(made, light->ambient, object->front.ambient, object->back.ambient)
                ? " but the ambient, which is constant and part of the base"
                : "");
        return false;
    }
    terms->half_vector = terms->specular && !positional && scene->distant_viewer &&
                         scene->reflection == REFLECTION_BLINN_PHONG;
    if ((object->shadowed >> number & 1) && (terms->diffuse || terms->specular))
        terms->shadow = 1 + effects_channel(scene->shadows, named) / SHADOW_CHANNELS;
    const bool same_over_triangle =
        object->flat && !positional && (!terms->specular || scene->distant_viewer);
    terms->at_vertex =
        scene->interpolation != INTERPOLATION_PHONG || (same_over_triangle && !terms->shadow);
    if (made->why)
        explain_light(made, number, terms);
    return true;
}

static void add_light(Effects *effects, int number, const LightTerms *terms, bool guarded)
{
    LightGroup *group = effects->groups, *end = group + effects->group_count;
    while (group < end && memcmp(&group->terms, terms, sizeof *terms) != 0)
        group++;
    if (group == end) {
        effects->group_count++;
        memcpy(&group->terms, terms, sizeof *terms);
    }
    group->guard_attenuation |= guarded;
    group->lights[group->count++] = (uint8_t)number;
}

/* Emission, global ambient and constant ambient light. */
static bool has_base(const Decision *made)
{
    const SideFacts *front = &made->object->front, *back = &made->object->back;
    return reflected(made, 7, front->emission, back->emission) ||
           reflected(made, made->scene->ambient, front->ambient, back->ambient);
}

static void decide_sides(Decision *made)
{
    const ObjectFacts *object = made->object;
    Effects *effects = &made->effects;
    effects->cull = object->closed && !object->clockwise && object->beyond;
    say(made->why,
        effects->cull ? "culling of back faces: a closed object, seen from outside"
                      : "without culling: %s",
        !object->closed     ? "the object is open"
        : object->clockwise ? "front faces are clockwise"
                            : "the near plane may cut the object");
    effects->two_sided = object->two_sided && !effects->cull;
    say(made->why,
        effects->two_sided ? "two-sided: the back has its own material and the opposite normal"
                           : "without a back side: %s",
        object->two_sided ? "it is never seen" : "it is lit like the front");
    effects->lit_positions = made->scene->interpolation == INTERPOLATION_CONSTANT;
    effects->base = has_base(made);
    say(made->why, effects->base ? "base: emission or constant ambient light"
                                 : "without base: neither emission nor constant ambient light");
    effects->alpha = object->front.translucent || (effects->two_sided && object->back.translucent);
    say(made->why, effects->alpha ? "alpha: the surface is not opaque"
                                  : "without alpha: the surface is opaque");
}

static void decide_lights(Decision *made)
{
    const SceneFacts *scene = made->scene;
    Effects *effects = &made->effects;
    bool colored = effects->base;
    for (int i = 0; i < scene->light_count; i++) {
        LightTerms terms;
        if (!decide_terms(made, i, &terms))
            continue;
        add_light(effects, i, &terms, made->object->guarded >> i & 1);
        effects->normals |= terms.diffuse || terms.specular;
        colored |= terms.ambient || terms.diffuse;
        /* R.V and N.H both depend on V. */
        effects->local_viewer |= terms.specular && !scene->distant_viewer;
        effects->phong |= terms.specular && scene->reflection == REFLECTION_PHONG;
        made->at_vertices |= terms.at_vertex;
        made->at_fragments |= !terms.at_vertex;
    }
    effects->vertex_color = made->object->colors && colored;
    if (made->object->colors)
        say(made->why, effects->vertex_color
                           ? "vertex colours: the mesh has them, instead of ambient and diffuse "
                             "colour"
                           : "without vertex colours: no term depends on them");
    say(made->why,
        effects->local_viewer ? "local viewer: the direction to the eye varies over the surface"
                              : "without local viewer: %s",
        scene->distant_viewer ? "the viewer is at infinity" : "no term is specular");
}

static void decide_normals(Decision *made)
{
    const ObjectFacts *object = made->object;
    const EffectsTransform transform = (EffectsTransform)object->transform;
    Effects *effects = &made->effects;
    FILE *why = made->why;
    if (!effects->normals) {
        say(why, "without normals: no term depends on them");
        return;
    }
    effects->normal_matrix = transform >= EXTREME && !object->wrong_normals;
    if (effects->normal_matrix)
        say(why, "normal matrix: the model-view matrix %s",
            transform == EXTREME ? "scales evenly, but the square of that leaves a 16-bit float"
                                 : "scales unevenly or shears");
    else if (object->wrong_normals)
        say(why, "without normal matrix: the scene requests the wrong one, the model-view matrix");
    else
        say(why, "without normal matrix: the model-view matrix is orthogonal");
    const bool skip = made->scene->skip_renormalization;
    effects->normalize_fragment = made->at_fragments && !object->flat && !skip;
    /* If fragments normalize, equal lengths at the vertices do not matter. */
    const bool equal_lengths = transform < EXTREME;
    effects->normalize_vertex =
        transform != ORTHONORMAL && (object->flat || skip || made->at_vertices || !equal_lengths);
    say(why,
        effects->normalize_vertex
            ? "normals normalized at the vertices: the transform changes their length"
            : "normals not normalized at the vertices: %s",
        transform == ORTHONORMAL ? "the transform keeps their length"
                                 : "the fragments do it, and all lengths are equal");
    say(why,
        effects->normalize_fragment
            ? "normals normalized at the fragments: interpolation may shorten them"
            : "normals not normalized at the fragments: %s",
        !made->at_fragments ? "no light is computed there"
        : object->flat      ? "constant over a triangle"
                            : "the scene skips it");
}

static void decide_output(Decision *made, bool at_vertices)
{
    const SceneFacts *scene = made->scene;
    Effects *effects = &made->effects;
    FILE *why = made->why;
    const bool clamped = scene->clamp_vertex && scene->interpolation != INTERPOLATION_PHONG;
    effects->clamp_vertex = clamped && at_vertices;
    say(why,
        effects->clamp_vertex ? "clamping at the vertices: requested"
                              : "without clamping at the vertices: %s",
        !scene->clamp_vertex ? "not requested" : "colours are not interpolated");
    effects->show_clipped = scene->show_clipped && !clamped;
    say(why,
        effects->show_clipped ? "overexposed pixels highlighted: requested"
                              : "without highlighting overexposed pixels: %s",
        scene->show_clipped ? "colours are clamped at the vertices" : "not requested");
    effects->linear = scene->linear;
    say(why, effects->linear ? "sRGB encoding: requested" : "without sRGB encoding: not requested");
    /* llvmpipe without AVX makes integers of 255 times a color, and black of what exceeds them;
     * colors of the vertices that exceed 16 bits are infinite in mediump. */
    effects->limit = scene->limit;
    if (effects->limit)
        say(why, "colours limited: drivers may draw very large ones as black");
}

Effects effects_decide(const SceneFacts *scene, const ObjectFacts *object, FILE *why)
{
    Decision made;
    memset(&made, 0, sizeof made);
    made.scene = scene;
    made.object = object;
    made.why = why;
    decide_sides(&made);
    decide_lights(&made);
    decide_normals(&made);
    /* The base varies over the surface as the colors of its vertices do. */
    decide_output(&made, made.at_vertices || (made.effects.base && made.effects.vertex_color));
    return made.effects;
}

Effects effects_decide_full(const SceneFacts *scene, const ObjectFacts *object)
{
    Decision made;
    memset(&made, 0, sizeof made);
    made.scene = scene;
    made.object = object;
    Effects *full = &made.effects;
    full->vertex_color = object->colors;
    full->alpha = full->base = full->normals = true;
    full->local_viewer = full->two_sided = true;
    full->normal_matrix = full->normalize_vertex = true;
    full->normalize_fragment = !scene->skip_renormalization;
    full->phong = scene->reflection == REFLECTION_PHONG;
    full->lit_positions = scene->interpolation == INTERPOLATION_CONSTANT;
    decide_output(&made, true);
    for (int i = 0; i < scene->light_count; i++) {
        LightTerms terms;
        memset(&terms, 0, sizeof terms);
        terms.kind = LIGHT_SPOT;
        terms.any = terms.ambient = terms.diffuse = terms.specular = true;
        terms.attenuation = terms.exponent = true;
        terms.range = scene->lights[i].range;
        terms.signed_dots = scene->signed_dots && !scene->lights[i].shadows;
        terms.at_vertex = scene->interpolation != INTERPOLATION_PHONG;
        if (scene->lights[i].shadows)
            terms.shadow = 1 + effects_channel(scene->shadows, scene->numbers[i]) / SHADOW_CHANNELS;
        add_light(full, i, &terms, true);
    }
    return made.effects;
}
