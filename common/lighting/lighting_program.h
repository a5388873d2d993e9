/*
 * lighting_program: the programs that draw objects, by effects. For lighting's own files.
 */
#ifndef LIGHTING_PROGRAM_H
#define LIGHTING_PROGRAM_H

#include "lighting/lighting_text.h"

/* Where a program's variables are; -1: it has none of that name. By ShaderStage, where both have
 * one. */
typedef struct SideLocations {
    GLint base, tint, alpha, shininess[2], normal[2];
} SideLocations;

typedef struct GroupLocations {
    GLint position, direction, half, attenuation, spot, exponent, range, channel;
    GLint colors[2][3]; /* of the front and the back: ambient, diffuse, specular */
} GroupLocations;

typedef struct MapLocations {
    int light;
    ShadowMapLocations at;
} MapLocations;

typedef struct LightingProgram {
    GLuint program;
    GLint position, normal, color, lit_position; /* attributes */
    GLint clip_from_object, eye_from_object, normal_matrix, local_viewer[2];
    GLint masks[SHADOW_MASKS], mask_place;
    SideLocations sides[2];
    int group_count, map_count;
    GroupLocations *groups;
    MapLocations *maps;
} LightingProgram;

/* Different effects may have the same program, such as those of light 0 alone and of light 1. */
typedef struct LightingVariant {
    LightingKey key;
    uint64_t hash;
    const LightingProgram *program;
    struct LightingVariant *next;
} LightingVariant;

enum { LIGHTING_SLOTS = 256 };
typedef struct LightingPrograms {
    ShaderLoader loader;
    LightingVariant *variants[LIGHTING_SLOTS]; /* by hash */
    struct Compiled *compiled;
    int count; /* compiled so far */
    double compile_seconds;
    long long printed; /* texts, so far */
} LightingPrograms;

/* The program for a key, compiled if necessary; NULL on failure. Valid until they are closed. */
const LightingVariant *lighting_program(LightingPrograms *programs, const LightingKey *key,
                                        Message *message);
void lighting_close_programs(LightingPrograms *programs);

#endif
