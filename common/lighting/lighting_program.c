/*
 * A program is found by the bytes of its key, in a table of those seen before; only for a new key
 * is its text written, and compiled if no other key has the same. Where its variables are is asked
 * once, after it is linked.
 */
#include "lighting/lighting_state.h"

#include "base/clock.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Compiled {
    LightingProgram program;
    LightingRecipe recipe;
    Shader shader;
    struct Compiled *next;
} Compiled;

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
                            .range = numbered(program, "u_Range", g),
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
    for (uint32_t left = key->maps; left; left &= left - 1) {
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
static const LightingProgram *compile(LightingPrograms *programs, LightingRecipe *recipe,
                                      const LightingKey *key, Message *message)
{
    ShaderText texts[3];
    for (Compiled *compiled = programs->compiled; compiled; compiled = compiled->next) {
        if (lighting_recipe_equal(&compiled->recipe, recipe)) {
            lighting_recipe_close(recipe);
            return &compiled->program;
        }
    }
    Compiled *compiled = memory_new(1, sizeof *compiled);
    const ShaderLoader loader = lighting_recipe_loader(recipe, &programs->loader, texts);
    const double start = clock_now();
    if (!shader_open(&compiled->shader, &loader, "lighting", message)) {
        lighting_recipe_close(recipe);
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
    LightingRecipe recipe;
    for (LightingVariant *variant = *place; variant; variant = variant->next)
        if (variant->hash == hash && memcmp(&variant->key, key, sizeof *key) == 0)
            return variant;
    programs->printed++;
    lighting_recipe_open(&recipe, key, lighting_is_mediump(&programs->loader));
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
        lighting_recipe_close(&compiled->recipe);
        free(compiled->program.groups);
        free(compiled->program.maps);
        free(compiled);
    }
    for (int i = 0; i < LIGHTING_SLOTS; i++)
        while (programs->variants[i]) {
            LightingVariant *variant = programs->variants[i];
            programs->variants[i] = variant->next;
            free(variant);
        }
}
