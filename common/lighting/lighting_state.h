/*
 * lighting_state: what the files of lighting share, for them alone.
 */
#ifndef LIGHTING_STATE_H
#define LIGHTING_STATE_H

#include "core/mesh_buffer.h"
#include "lighting/lighting.h"
#include "scene/effects.h"
#include "scene/scene.h"
#include "shadows/shadow_cast.h"
#include "shadows/shadow_map.h"

/* The text of a program, by effects. No GL. */

/* What a program is found by, as bytes. */
typedef struct LightingKey {
    uint32_t shadows; /* the scene's lights that have them, a bit each: see effects_channel */
    uint8_t numbers[EFFECTS_MAX_LIGHTS]; /* of the object's lights that have them, in the scene */
    uint32_t maps; /* those of them whose map the program looks up; of the others masks */
    uint8_t looks[SHADOW_MAPS]; /* shadow_map_look of those */
    Effects effects;            /* the last: most of its groups are not used */
} LightingKey;

/* The channel of one of the object's lights that have shadows. */
int lighting_channel(const LightingKey *key, int light);

/* What determines a text: equal recipes give equal programs. */
enum { LIGHTING_DEFINES = 32 };
typedef struct LightingRecipe {
    const char *defines[LIGHTING_DEFINES];
    char *groups[2]; /* of lights, by ShaderStage */
} LightingRecipe;
void lighting_recipe_open(LightingRecipe *recipe, const LightingKey *key, bool mediump);
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

/* The programs that draw objects, by effects. */

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

/* What was made of meshes, by their address. */

/* Zeroed: nothing. */
typedef struct LightingMeshes {
    struct MeshMade *buffers, *casters;
} LightingMeshes;

/* A mesh in buffers, remade as this interpolation needs it (INTERPOLATION_PHONG: as it is), or what
 * casts its shadow; NULL on failure. */
const MeshBuffer *lighting_mesh_buffer(LightingMeshes *meshes, const Mesh *mesh,
                                       Interpolation remade, Message *message);
const ShadowCaster *lighting_mesh_caster(LightingMeshes *meshes, const Mesh *mesh,
                                         Message *message);

/* What was made of a mesh, or of all: NULL. */
void lighting_meshes_forget(LightingMeshes *meshes, const Mesh *mesh);

/* Planes at which shadow volumes end. No GL. */

/* Planes before which all lies that receives a light's shadows. Their directions are those of the
 * sides of the largest boxes: a floor's, walls'. */
enum { END_BOXES = 10 };
typedef struct ShadowEnds {
    int count;
    Vec3 ways[6 * END_BOXES];
    double least[6 * END_BOXES]; /* of the receivers along the way, less a little */
} ShadowEnds;

void shadow_ends_find(ShadowEnds *ends, const LightingPlan *plan, int light);

/* Of these planes the one that ends a caster's volume the soonest; (0, 0, 0, 1), infinity, if there
 * is none. */
Vec4 shadow_ends_choose(const ShadowEnds *ends, const PlacedBox *caster, const Light *light);

/* Whether a part of the box may lie beyond the end. */
bool shadow_end_before(const Vec4 *end, const PlacedBox *box);

struct Lighting {
    LightingPrograms programs;
    LightingMeshes meshes;
    ShadowSettings shadows;
    ShadowMask mask; /* opened when a scene first needs it */
    ShadowMaps maps; /* likewise */
    ShadowVolumes volumes;
    LightingTransforms transforms;
    LightingNormalMatrix *normal_matrix; /* NULL: mat4_normal */
    bool depth_pass;                     /* even where the eye is in a volume */
    int renewal; /* counts what makes plans out of date: settings, and meshes that are forgotten */
    LightingPlan *shown; /* lighting_show's, by view */
    int shown_count;
};

#endif
