/*
 * lighting_text: the text of a program, by effects. For lighting's own files. No GL.
 */
#ifndef LIGHTING_TEXT_H
#define LIGHTING_TEXT_H

#include "scene/effects.h"
#include "shadows/shadow_map.h"

/* What a program is found by, as bytes. */
typedef struct LightingKey {
    uint32_t shadows; /* the scene's lights that have them, a bit each: see effects_channel */
    uint32_t maps;    /* those of them whose map the program looks up; of the others masks */
    uint8_t looks[SHADOW_MAPS]; /* shadow_map_look of those */
    Effects effects;            /* the last: most of its groups are not used */
} LightingKey;

/* What determines a text: equal recipes give equal programs. Closed after a failure, too. */
enum { LIGHTING_DEFINES = 32 };
typedef struct LightingRecipe {
    const char *defines[LIGHTING_DEFINES];
    char *groups[2]; /* of lights, by ShaderStage */
} LightingRecipe;
bool lighting_recipe_open(LightingRecipe *recipe, const LightingKey *key, bool mediump,
                          Message *message);
void lighting_recipe_close(LightingRecipe *recipe);
bool lighting_recipe_equal(const LightingRecipe *a, const LightingRecipe *b);

/* A loader for a recipe, of the shader "lighting"; `texts` has room for three. */
ShaderLoader lighting_recipe_loader(const LightingRecipe *recipe, const ShaderLoader *base,
                                    ShaderText texts[3]);

/* A program's sources by ShaderStage, as the driver receives them. Both are zeroed on failure. */
bool lighting_program_sources(const ShaderLoader *base, const LightingKey *key,
                              ShaderSource sources[2], Message *message);

/* Whether fragments may be computed in 16 bits. */
bool lighting_is_mediump(const ShaderLoader *loader);

#endif
