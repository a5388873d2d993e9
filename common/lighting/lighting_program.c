/*
 * A program is a text: lighting.vert and lighting.frag with the defines that the effects ask for,
 * and a function for each group of lights. Which one an object needs is found by the bytes of its
 * key, in a table of those seen before; only for a new key is the text written, and compiled if no
 * other key has the same. Where its variables are is asked once, after it is linked.
 */
#include "lighting/lighting_program.h"

#include "base/clock.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEFINES = 32 };

/* What determines a program: equal recipes give equal programs. */
typedef struct Recipe {
    const char *defines[MAX_DEFINES];
    char *groups[2]; /* of lights, by ShaderStage */
} Recipe;

typedef struct Compiled {
    LightingProgram program;
    Recipe recipe;
    Shader shader;
    struct Compiled *next;
} Compiled;

/* The uniforms of group.glsl, renamed per group. */
static const char *const GROUP_UNIFORMS[] = {
    "u_Position",     "u_Direction",   "u_FrontAmbient",  "u_BackAmbient",
    "u_FrontDiffuse", "u_BackDiffuse", "u_FrontSpecular", "u_BackSpecular",
    "u_Half",         "u_Attenuation", "u_Spot",          "u_Exponent",
};
enum { GROUP_UNIFORM_COUNT = sizeof GROUP_UNIFORMS / sizeof GROUP_UNIFORMS[0] };

/* The defines of group.glsl. 16-bit floats need the guard of the attenuation for any light. */
enum { MAX_GROUP_DEFINES = 12 };
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
        {terms->specular, "SPECULAR"},
        {terms->half_vector, "HALF_VECTOR"},
        {terms->attenuation, "ATTENUATION"},
        {terms->exponent, "EXPONENT"},
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
            const int light = group->lights[i];
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
            const int channel = effects_channel(key->shadows, group->lights[i]) % SHADOW_CHANNELS;
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
                "rgba"[effects_channel(key->shadows, group->lights[0]) % SHADOW_CHANNELS]);
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
    char *text = NULL;
    size_t size = 0;
    int shadowed = 0; /* lights, so far */
    const Shadows shadows = shadows_of(key);
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
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
    fclose(file);
    return text;
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
                         const char *defines[MAX_DEFINES])
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

static bool recipe_open(Recipe *recipe, const LightingKey *key, bool mediump, Message *message)
{
    *recipe = (Recipe){{NULL}, {NULL}};
    find_defines(&key->effects, shadows_of(key), mediump, recipe->defines);
    recipe->groups[SHADER_VERTEX] = groups_text(key, mediump, true);
    recipe->groups[SHADER_FRAGMENT] = groups_text(key, mediump, false);
    if (recipe->groups[SHADER_VERTEX] && recipe->groups[SHADER_FRAGMENT])
        return true;
    return message_set(message, "lighting: not enough memory");
}

static void recipe_close(Recipe *recipe)
{
    free(recipe->groups[SHADER_VERTEX]);
    free(recipe->groups[SHADER_FRAGMENT]);
    *recipe = (Recipe){{NULL}, {NULL}};
}

/* The defines are string literals of this file, so pointers are compared. */
static bool recipe_equal(const Recipe *a, const Recipe *b)
{
    return memcmp(a->defines, b->defines, sizeof a->defines) == 0 &&
           strcmp(a->groups[0], b->groups[0]) == 0 && strcmp(a->groups[1], b->groups[1]) == 0;
}

/* A loader for this recipe; `texts` has room for three. */
static ShaderLoader recipe_loader(const Recipe *recipe, const ShaderLoader *base,
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

bool lighting_is_mediump(const ShaderLoader *loader)
{
    return loader->precision && strcmp(loader->precision, "mediump") == 0;
}

/* Where its variables are */

static GLint numbered(GLuint program, const char *name, int number)
{
    char full_name[32];
    snprintf(full_name, sizeof full_name, "%s%d", name, number);
    return glGetUniformLocation(program, full_name);
}

static SideLocations side_locations(GLuint program, const char *side)
{
    char name[48];
    SideLocations found;
    const struct {
        const char *format;
        GLint *location;
    } all[] = {{"u_%sBase", &found.base},
               {"u_%sTint", &found.tint},
               {"u_%sAlpha", &found.alpha},
               {"u_%sShininess", &found.shininess[SHADER_FRAGMENT]},
               {"u_Vertex%sShininess", &found.shininess[SHADER_VERTEX]},
               {"u_%sNormal", &found.normal[SHADER_FRAGMENT]},
               {"u_Vertex%sNormal", &found.normal[SHADER_VERTEX]}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        snprintf(name, sizeof name, all[i].format, side);
        *all[i].location = glGetUniformLocation(program, name);
    }
    return found;
}

static GroupLocations group_locations(GLuint program, int g)
{
    static const char *const colors[2][3] = {
        {"u_FrontAmbient", "u_FrontDiffuse", "u_FrontSpecular"},
        {"u_BackAmbient", "u_BackDiffuse", "u_BackSpecular"}};
    GroupLocations found = {.position = numbered(program, "u_Position", g),
                            .direction = numbered(program, "u_Direction", g),
                            .half = numbered(program, "u_Half", g),
                            .attenuation = numbered(program, "u_Attenuation", g),
                            .spot = numbered(program, "u_Spot", g),
                            .exponent = numbered(program, "u_Exponent", g),
                            .channel = numbered(program, "u_Channel", g)};
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < 3; k++)
            found.colors[side][k] = numbered(program, colors[side][k], g);
    return found;
}

static void find_locations(LightingProgram *made, const LightingKey *key)
{
    const GLuint program = made->program;
    made->position = glGetAttribLocation(program, "a_Position");
    made->normal = glGetAttribLocation(program, "a_Normal");
    made->color = glGetAttribLocation(program, "a_Color");
    made->lit_position = glGetAttribLocation(program, "a_LitPosition");
    made->clip_from_object = glGetUniformLocation(program, "u_ClipFromObject");
    made->eye_from_object = glGetUniformLocation(program, "u_EyeFromObject");
    made->normal_matrix = glGetUniformLocation(program, "u_NormalMatrix");
    made->local_viewer[SHADER_FRAGMENT] = glGetUniformLocation(program, "u_LocalViewer");
    made->local_viewer[SHADER_VERTEX] = glGetUniformLocation(program, "u_VertexLocalViewer");
    made->mask_place = glGetUniformLocation(program, "u_MaskPlace");
    made->sides[0] = side_locations(program, "Front");
    made->sides[1] = side_locations(program, "Back");
    for (int i = 0; i < SHADOW_MASKS; i++)
        made->masks[i] = numbered(program, "u_Mask", i);
    made->group_count = key->effects.group_count;
    made->groups = memory_new((size_t)made->group_count + 1, sizeof *made->groups);
    for (int g = 0; g < made->group_count; g++)
        made->groups[g] = group_locations(program, g);
    for (uint32_t left = shadows_of(key).maps; left; left &= left - 1) {
        char suffix[8];
        const int light = __builtin_ctz(left);
        snprintf(suffix, sizeof suffix, "%d", light);
        made->maps = memory_grow(made->maps, (size_t)made->map_count + 1, sizeof *made->maps);
        made->maps[made->map_count++] =
            (MapLocations){light, shadow_map_locations(program, suffix)};
    }
}

/* The table */

/* FNV-1a, eight bytes at a time, of what is used: the other groups are zero. */
static uint64_t hash_of(const LightingKey *key)
{
    const size_t used = offsetof(LightingKey, effects.groups) +
                        (size_t)key->effects.group_count * sizeof(LightGroup);
    uint64_t hash = 0xcbf29ce484222325, word;
    for (size_t i = 0; i < used; i += sizeof word) {
        word = 0;
        memcpy(&word, (const char *)key + i, used - i < sizeof word ? used - i : sizeof word);
        hash = (hash ^ word) * 0x100000001b3;
        hash ^= hash >> 29;
    }
    return hash;
}

/* The program of a recipe, which becomes its own; NULL on failure. */
static const LightingProgram *compile(LightingPrograms *programs, Recipe *recipe,
                                      const LightingKey *key, Message *message)
{
    ShaderText texts[3];
    for (Compiled *compiled = programs->compiled; compiled; compiled = compiled->next) {
        if (recipe_equal(&compiled->recipe, recipe)) {
            recipe_close(recipe);
            return &compiled->program;
        }
    }
    Compiled *compiled = memory_new(1, sizeof *compiled);
    const ShaderLoader loader = recipe_loader(recipe, &programs->loader, texts);
    const double start = clock_now();
    if (!shader_open(&compiled->shader, &loader, "lighting", message)) {
        recipe_close(recipe);
        free(compiled);
        return NULL;
    }
    programs->count++;
    programs->compile_seconds += clock_now() - start;
    compiled->recipe = *recipe;
    compiled->program.program = compiled->shader.program;
    find_locations(&compiled->program, key);
    compiled->next = programs->compiled;
    programs->compiled = compiled;
    return &compiled->program;
}

const LightingVariant *lighting_program(LightingPrograms *programs, const LightingKey *key,
                                        Message *message)
{
    const uint64_t hash = hash_of(key);
    LightingVariant **place = &programs->variants[hash % LIGHTING_SLOTS];
    Recipe recipe;
    for (LightingVariant *variant = *place; variant; variant = variant->next)
        if (variant->hash == hash && memcmp(&variant->key, key, sizeof *key) == 0)
            return variant;
    programs->printed++;
    if (!recipe_open(&recipe, key, lighting_is_mediump(&programs->loader), message)) {
        recipe_close(&recipe);
        return NULL;
    }
    const LightingProgram *program = compile(programs, &recipe, key, message);
    if (!program)
        return NULL;
    LightingVariant *variant = memory_new(1, sizeof *variant);
    memcpy(&variant->key, key, sizeof *key);
    variant->hash = hash;
    variant->program = program;
    variant->next = *place;
    *place = variant;
    return variant;
}

void lighting_close_programs(LightingPrograms *programs)
{
    while (programs->compiled) {
        Compiled *compiled = programs->compiled;
        programs->compiled = compiled->next;
        shader_close(&compiled->shader);
        recipe_close(&compiled->recipe);
        free(compiled->program.groups);
        free(compiled->program.maps);
        free(compiled);
    }
    for (int i = 0; i < LIGHTING_SLOTS; i++) {
        while (programs->variants[i]) {
            LightingVariant *variant = programs->variants[i];
            programs->variants[i] = variant->next;
            free(variant);
        }
    }
}

bool lighting_program_sources(const ShaderLoader *base, const LightingKey *key,
                              ShaderSource sources[2], Message *message)
{
    Recipe recipe;
    ShaderText texts[3];
    bool done = recipe_open(&recipe, key, lighting_is_mediump(base), message);
    const ShaderLoader loader = recipe_loader(&recipe, base, texts);
    sources[SHADER_VERTEX] = sources[SHADER_FRAGMENT] = (ShaderSource){0};
    done = done &&
           shader_source_open(&sources[SHADER_VERTEX], &loader, "lighting.vert", SHADER_VERTEX,
                              message) &&
           shader_source_open(&sources[SHADER_FRAGMENT], &loader, "lighting.frag", SHADER_FRAGMENT,
                              message);
    if (!done)
        shader_source_close(&sources[SHADER_VERTEX]);
    recipe_close(&recipe);
    return done;
}
