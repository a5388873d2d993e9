/*
 * The text of a program is lighting.vert and lighting.frag, with the defines that the effects ask
 * for, and a function for each group of lights: group.glsl once more, with names of its own. What
 * shadows need is written here, too: which map or which channel of a mask says that a light is kept
 * off.
 */
#include "lighting/lighting_state.h"

#include "base/output_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool lighting_is_mediump(const ShaderLoader *loader)
{
    return loader->precision && strcmp(loader->precision, "mediump") == 0;
}

int lighting_channel(const LightingKey *key, int light)
{
    return effects_channel(key->shadows, key->numbers[light]);
}

/* The uniforms of group.glsl, renamed per group. */
static const char *const GROUP_UNIFORMS[] = {
    "u_Position",    "u_Direction",     "u_FrontAmbient", "u_BackAmbient", "u_FrontDiffuse",
    "u_BackDiffuse", "u_FrontSpecular", "u_BackSpecular", "u_Half",        "u_Attenuation",
    "u_Spot",        "u_Exponent",      "u_Range",
};
enum { GROUP_UNIFORM_COUNT = sizeof GROUP_UNIFORMS / sizeof GROUP_UNIFORMS[0] };

/* The defines of group.glsl. 16-bit floats need the guard of the attenuation for any light. */
enum { MAX_GROUP_DEFINES = 14 };
static int group_defines(const LightGroup *group, bool mediump,
                         const char *defines[MAX_GROUP_DEFINES])
{
    const LightTerms *terms = &group->terms;
    const struct {
        bool there;
        const char *name;
    } all[] = {
        {terms->any, "ANY"},
        {terms->kind == LIGHT_DIRECTIONAL, "DIRECTIONAL"},
        {terms->kind == LIGHT_SPOT, "SPOT"},
        {terms->ambient, "AMBIENT"},
        {terms->diffuse, "DIFFUSE"},
        {terms->signed_dots, "SIGNED_DOTS"},
        {terms->specular, "SPECULAR"},
        {terms->half_vector, "HALF_VECTOR"},
        {terms->attenuation, "ATTENUATION"},
        {terms->exponent, "EXPONENT"},
        {terms->range, "RANGE"},
        {terms->attenuation && (group->guard_attenuation || mediump), "GUARD_ATTENUATION"},
        {terms->shadow && !terms->at_vertex, "SHADOW"},
        {terms->shadow && !terms->at_vertex && group->count > 1, "CHANNELS"},
    };
    int count = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].there)
            defines[count++] = all[i].name;
    return count;
}

static int masks_of(const LightingKey *key)
{
    const Effects *effects = &key->effects;
    int count = 0;
    for (int g = 0; g < effects->group_count; g++)
        count = effects->groups[g].terms.shadow > count ? effects->groups[g].terms.shadow : count;
    return count;
}

/* What each light's code for its map has under a name of its own. */
static const char *const MAP_NAMES[] = {"u_MapScale", "u_MapMove",  "u_MapSize",   "u_MapBias",
                                        "u_Map",      "v_MapPlace", "v_MapNormal", "map_depth",
                                        "is_behind",  "find_place", "find_shadow"};
enum { MAP_NAME_COUNT = sizeof MAP_NAMES / sizeof MAP_NAMES[0] };

/* What a program looks up: maps, a bit for each light; and masks, a bit each. */
typedef struct Shadows {
    uint32_t maps, masks;
} Shadows;

static Shadows shadows_of(const LightingKey *key)
{
    Shadows shadows = {0, 0};
    for (int g = 0; g < key->effects.group_count; g++) {
        const LightGroup *group = &key->effects.groups[g];
        for (int i = 0; group->terms.shadow && i < group->count; i++) {
            const int light = key->numbers[group->lights[i]];
            if (key->maps >> light & 1)
                shadows.maps |= (uint32_t)1 << light;
            else
                shadows.masks |= (uint32_t)1
                                 << effects_channel(key->shadows, light) / SHADOW_CHANNELS;
        }
    }
    return shadows;
}

static void write_map(int light, int look, FILE *file)
{
    const char *defines[LOOK_DEFINES];
    const int count = shadow_map_defines(look, defines);
    for (int i = 0; i < MAP_NAME_COUNT; i++)
        fprintf(file, "#define %s %s%d\n", MAP_NAMES[i], MAP_NAMES[i], light);
    for (int i = 0; i < count; i++)
        fprintf(file, "#define %s\n", defines[i]);
    fprintf(file, "#include \"lighting/shadow_map.glsl\"\n");
    for (int i = 0; i < count; i++)
        fprintf(file, "#undef %s\n", defines[i]);
    for (int i = 0; i < MAP_NAME_COUNT; i++)
        fprintf(file, "#undef %s\n", MAP_NAMES[i]);
}

/* Where the fragments are on the maps, with the normals that are drawn: a triangle's, if flat. */
static void write_map_places(uint32_t maps, FILE *file)
{
    for (int l = 0; l < SHADOW_MAPS; l++)
        if (maps >> l & 1)
            fprintf(file,
                    "uniform mat4 u_LightFromObject%d;\nuniform mat4 u_LightNormal%d;\n"
                    "varying vec3 v_MapPlace%d;\nvarying vec3 v_MapNormal%d;\n",
                    l, l, l, l);
    fprintf(file, "void place_on_maps() {\n");
    for (int l = 0; l < SHADOW_MAPS; l++)
        if (maps >> l & 1)
            fprintf(file,
                    "    v_MapPlace%d = (u_LightFromObject%d * a_Position).xyz;\n"
                    "    v_MapNormal%d = (u_LightNormal%d * vec4(a_Normal, 0.0)).xyz;\n",
                    l, l, l, l);
    fprintf(file, "}\n");
}

/* Once for all groups: the share of each light that is in shadow, of four lights in a vector.
 * Depths and places need highp, which the loader replaces in mediump. There gl_FragCoord has 11
 * bits, too few for the size of a framebuffer: the place comes from the vertex shader. */
static void write_shadows(const LightingKey *key, bool mediump, FILE *file)
{
    const Shadows shadows = shadows_of(key);
    const int count = masks_of(key);
    if (!count)
        return;
    fprintf(file, "#define LOOK_UP_SHADOWS\n");
    for (int m = 0; m < count; m++)
        fprintf(file, "vec4 shadow_mask%d = vec4(0.0);\n", m);
    fprintf(file, mediump ? "#undef highp\nprecision highp float;\n" : "");
    for (int l = 0; l < EFFECTS_MAX_LIGHTS; l++)
        if (shadows.maps >> l & 1)
            write_map(l, key->looks[l], file);
    for (int m = 0; m < count; m++)
        if (shadows.masks >> m & 1)
            fprintf(file, "uniform sampler2D u_Mask%d;\n", m);
    if (shadows.masks)
        fprintf(file,
                "uniform vec4 u_MaskPlace;\n%s"
                "vec2 mask_place() { return %s * u_MaskPlace.xy + u_MaskPlace.zw; }\n",
                mediump ? "varying vec3 v_MaskPlace;\n" : "",
                mediump ? "(v_MaskPlace.xy / v_MaskPlace.z)" : "gl_FragCoord.xy");
    fprintf(file, "void look_up_shadows() {\n");
    for (int m = 0; m < count; m++)
        if (shadows.masks >> m & 1)
            fprintf(file, "    shadow_mask%d = texture2D(u_Mask%d, mask_place());\n", m, m);
    for (int l = 0; l < EFFECTS_MAX_LIGHTS; l++)
        if (shadows.maps >> l & 1)
            fprintf(file, "    shadow_mask%d.%c = find_shadow%d();\n",
                    effects_channel(key->shadows, l) / SHADOW_CHANNELS,
                    "rgba"[effects_channel(key->shadows, l) % SHADOW_CHANNELS], l);
    fprintf(file, "}\n%s", mediump ? "precision mediump float;\n#define highp mediump\n" : "");
}

/* Of light that is computed at the vertices the part that a shadow keeps off is interpolated for
 * each light alone. In the vertex shader: where; in the fragment shader: their sum. */
static void write_vertex_shadows(const LightingKey *key, bool at_vertex, FILE *file)
{
    const Effects *effects = &key->effects;
    int count = 0;
    for (int g = 0; g < effects->group_count; g++)
        if (effects->groups[g].terms.at_vertex && effects->groups[g].terms.shadow)
            count += effects->groups[g].count;
    if (!count)
        return;
    fprintf(file, "varying vec3 v_FrontDirect[%d];\n", count);
    if (effects->two_sided)
        fprintf(file, "varying vec3 v_BackDirect[%d];\n", count);
    if (at_vertex)
        return;
    fprintf(file, "#define SHADOWED_LIGHT vec3(0.0)");
    for (int g = 0, first = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        for (int i = 0; group->terms.at_vertex && group->terms.shadow && i < group->count; i++) {
            const int channel = lighting_channel(key, group->lights[i]) % SHADOW_CHANNELS;
            fprintf(file, " + (1.0 - shadow_mask%d.%c) * SIDE(v_FrontDirect[%d], v_BackDirect[%d])",
                    group->terms.shadow - 1, "rgba"[channel], first, first);
            first++;
        }
    }
    fprintf(file, "\n");
}

/* What of a light of the group is in shadow: one channel, if the group has but one light. */
static void write_shadowed(const LightingKey *key, const LightGroup *group, int g, FILE *file)
{
    const int mask = group->terms.shadow - 1;
    if (group->count > 1)
        fprintf(file,
                "#define u_Channel u_Channel%d\n"
                "#define SHADOWED dot(shadow_mask%d, u_Channel[i])\n",
                g, mask);
    else
        fprintf(file, "#define SHADOWED shadow_mask%d.%c\n", mask,
                "rgba"[lighting_channel(key, group->lights[0]) % SHADOW_CHANNELS]);
}

/* A function for a group; `shadowed`: how many lights of those before it have shadows. */
static void write_group(const LightingKey *key, int g, bool mediump, int shadowed, FILE *file)
{
    const LightGroup *group = &key->effects.groups[g];
    const bool at_vertex = group->terms.at_vertex;
    const char *defines[MAX_GROUP_DEFINES];
    const int count = group_defines(group, mediump, defines);
    fprintf(file, "#define GROUP group%d\n#define COUNT %d\n", g, group->count);
    for (int i = 0; i < count; i++)
        fprintf(file, "#define %s\n", defines[i]);
    for (int i = 0; i < GROUP_UNIFORM_COUNT; i++)
        fprintf(file, "#define %s %s%d\n", GROUP_UNIFORMS[i], GROUP_UNIFORMS[i], g);
    if (group->terms.shadow && at_vertex)
        fprintf(file, "#define VERTEX_SHADOW %d\n", shadowed);
    else if (group->terms.shadow)
        write_shadowed(key, group, g, file);
    fprintf(file, "#include \"lighting/group.glsl\"\n#undef GROUP\n#undef COUNT\n");
    for (int i = 0; i < count; i++)
        fprintf(file, "#undef %s\n", defines[i]);
    for (int i = 0; i < GROUP_UNIFORM_COUNT; i++)
        fprintf(file, "#undef %s\n", GROUP_UNIFORMS[i]);
    if (group->terms.shadow)
        fprintf(file, at_vertex ? "#undef VERTEX_SHADOW\n" : "#undef u_Channel\n#undef SHADOWED\n");
}

/* The text of "lighting/vertex_groups.glsl" or "lighting/fragment_groups.glsl": a function per
 * group, and add_lights, which calls them. */
static char *groups_text(const LightingKey *key, bool mediump, bool at_vertex)
{
    const Effects *effects = &key->effects;
    OutputText text;
    int shadowed = 0; /* lights, so far */
    const Shadows shadows = shadows_of(key);
    output_text_open(&text);
    FILE *file = text.file;
    if (!at_vertex)
        write_shadows(key, mediump, file);
    else if (shadows.maps)
        write_map_places(shadows.maps, file);
    write_vertex_shadows(key, at_vertex, file);
    for (int g = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        if (group->terms.at_vertex != at_vertex)
            continue;
        write_group(key, g, mediump, shadowed, file);
        shadowed += group->terms.shadow ? group->count : 0;
    }
    fprintf(file, "void add_lights(vec3 normal, vec3 position, vec3 viewer, bool front, inout vec3 "
                  "color) {\n");
    for (int g = 0; g < effects->group_count; g++)
        if (effects->groups[g].terms.at_vertex == at_vertex)
            fprintf(file, "    group%d(normal, position, viewer, front, color);\n", g);
    fprintf(file, "}\n");
    return output_text_close(&text);
}

/* What is computed where, by ShaderStage, and anywhere. */
typedef struct Stages {
    bool lights[2], position[2], normals[2], colored[2];
    bool specular, full, vertex_shadows;
} Stages;

static Stages stages_of(const Effects *effects)
{
    /* What is clamped at the vertices is computed there, the base too. */
    Stages stages = {.lights = {[SHADER_VERTEX] = effects->clamp_vertex}};
    for (int g = 0; g < effects->group_count; g++) {
        const LightTerms *terms = &effects->groups[g].terms;
        const int stage = terms->at_vertex ? SHADER_VERTEX : SHADER_FRAGMENT;
        stages.lights[stage] = true;
        stages.position[stage] |=
            terms->kind != LIGHT_DIRECTIONAL || (terms->specular && effects->local_viewer);
        stages.normals[stage] |= terms->diffuse || terms->specular;
        stages.colored[stage] |= effects->vertex_color && (terms->ambient || terms->diffuse);
        stages.specular |= terms->specular;
        stages.full |= terms->any;
        stages.vertex_shadows |= terms->shadow && terms->at_vertex;
    }
    stages.colored[stages.lights[SHADER_VERTEX] ? SHADER_VERTEX : SHADER_FRAGMENT] |=
        effects->vertex_color && effects->base;
    return stages;
}

static void find_defines(const Effects *effects, Shadows shadows, bool mediump,
                         const char *defines[LIGHTING_DEFINES])
{
    const Stages stages = stages_of(effects);
    const bool *lights = stages.lights, *position = stages.position, *normals = stages.normals;
    const struct {
        bool there;
        const char *define;
    } all[] = {
        {stages.full, "FULL"},
        {mediump, "MEDIUMP"},
        {effects->base, "BASE"},
        {effects->alpha, "ALPHA"},
        {effects->vertex_color, "VERTEX_COLOR"},
        {stages.colored[SHADER_FRAGMENT], "FRAGMENT_COLOR"},
        {effects->lit_positions && lights[SHADER_VERTEX], "LIT_POSITION"},
        {effects->two_sided, "TWO_SIDED"},
        {lights[SHADER_VERTEX], "VERTEX_LIGHTS"},
        {lights[SHADER_FRAGMENT], "FRAGMENT_LIGHTS"},
        {stages.vertex_shadows, "VERTEX_SHADOWS"},
        {shadows.maps != 0, "SHADOW_MAPS"},
        {mediump && shadows.masks, "MASK_PLACE"},
        {position[SHADER_VERTEX] || position[SHADER_FRAGMENT], "POSITION"},
        {position[SHADER_FRAGMENT], "FRAGMENT_POSITION"},
        {normals[SHADER_VERTEX] || normals[SHADER_FRAGMENT], "NORMALS"},
        {normals[SHADER_FRAGMENT], "FRAGMENT_NORMALS"},
        {effects->normal_matrix, "NORMAL_MATRIX"},
        {effects->normalize_vertex, "NORMALIZE_VERTEX"},
        {effects->normalize_fragment, "NORMALIZE_FRAGMENT"},
        {effects->local_viewer, "LOCAL_VIEWER"},
        {stages.specular, "SHININESS"},
        {stages.specular && effects->phong, "PHONG"},
        {effects->clamp_vertex, "CLAMP_VERTEX"},
        {effects->linear, "LINEAR"},
        {effects->show_clipped, "SHOW_CLIPPED"},
        {effects->limit, "LIMIT"},
    };
    for (size_t i = 0, count = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].there)
            defines[count++] = all[i].define;
}

void lighting_recipe_open(LightingRecipe *recipe, const LightingKey *key, bool mediump)
{
    *recipe = (LightingRecipe){{NULL}, {NULL}};
    find_defines(&key->effects, shadows_of(key), mediump, recipe->defines);
    recipe->groups[SHADER_VERTEX] = groups_text(key, mediump, true);
    recipe->groups[SHADER_FRAGMENT] = groups_text(key, mediump, false);
}

void lighting_recipe_close(LightingRecipe *recipe)
{
    free(recipe->groups[SHADER_VERTEX]);
    free(recipe->groups[SHADER_FRAGMENT]);
    *recipe = (LightingRecipe){{NULL}, {NULL}};
}

/* The defines are string literals of this file, so pointers are compared. */
bool lighting_recipe_equal(const LightingRecipe *a, const LightingRecipe *b)
{
    return memcmp(a->defines, b->defines, sizeof a->defines) == 0 &&
           strcmp(a->groups[0], b->groups[0]) == 0 && strcmp(a->groups[1], b->groups[1]) == 0;
}

ShaderLoader lighting_recipe_loader(const LightingRecipe *recipe, const ShaderLoader *base,
                                    ShaderText texts[3])
{
    ShaderLoader loader = *base;
    texts[0] = (ShaderText){"lighting/vertex_groups.glsl", recipe->groups[SHADER_VERTEX]};
    texts[1] = (ShaderText){"lighting/fragment_groups.glsl", recipe->groups[SHADER_FRAGMENT]};
    texts[2] = (ShaderText){NULL, NULL};
    loader.texts = texts;
    loader.defines = recipe->defines;
    return loader;
}

bool lighting_program_sources(const ShaderLoader *base, const LightingKey *key,
                              ShaderSource sources[2], Message *message)
{
    LightingRecipe recipe;
    ShaderText texts[3];
    lighting_recipe_open(&recipe, key, lighting_is_mediump(base));
    const ShaderLoader loader = lighting_recipe_loader(&recipe, base, texts);
    sources[SHADER_VERTEX] = sources[SHADER_FRAGMENT] = (ShaderSource){0};
    const bool done = shader_source_open(&sources[SHADER_VERTEX], &loader, "lighting.vert",
                                         SHADER_VERTEX, message) &&
                      shader_source_open(&sources[SHADER_FRAGMENT], &loader, "lighting.frag",
                                         SHADER_FRAGMENT, message);
    if (!done)
        shader_source_close(&sources[SHADER_VERTEX]);
    lighting_recipe_close(&recipe);
    return done;
}
