/*
 * lighting_parts: what the files of lighting share, for them alone.
 */
#ifndef LIGHTING_PARTS_H
#define LIGHTING_PARTS_H

#include "core/mesh_buffer.h"
#include "lighting/lighting.h"
#include "shadows/shadow_map.h"

typedef struct Buffered {
    const Mesh *mesh;
    Interpolation remade; /* INTERPOLATION_PHONG: the mesh itself */
    MeshBox box;          /* of `mesh` */
    MeshBuffer buffer;
    struct Buffered *next;
} Buffered;

struct Lighting {
    ShaderLoader loader;
    struct Variant *variants; /* the programs */
    Buffered *buffers;
    struct Caster *casters; /* what throws shadows */
    ShadowSettings shadows;
    ShadowMask mask;        /* opened when a scene first needs it */
    ShadowMaps maps;        /* likewise */
    int looks[SHADOW_MAPS]; /* shadow_map_look, of those lights: */
    uint32_t map_lights;    /* a bit for each whose map the programs that light objects look up; the
                               shadows of others are in masks */
    LightingCounts counts;
    LightingTransforms transforms;
    LightingNormalMatrix *normal_matrix; /* NULL: mat4_normal */
    bool depth_pass;                     /* even where the eye is in a volume */
};

/* Which light's shadows may fall on what, a bit for each light: empty without shadows. */
typedef struct ShadowPlan {
    int count;                   /* of objects */
    uint32_t *receives, *throws; /* of each object */
    MeshBox *boxes;
    PlacedBox *placed; /* the same in the world */
    uint32_t all;      /* the lights that something receives */
} ShadowPlan;

/* What the shadows of a frame are drawn from. */
typedef struct ShadowFrame {
    const Scene *scene;
    const ShadowPlan *plan;
    Mat4 eye_from_world, clip_from_eye;
    bool full, in_parts; /* the latter: lights of an object may be others than the scene's */
} ShadowFrame;

/* lighting.c */

/* A mesh in buffers, remade as this interpolation needs it; NULL on failure. */
const Buffered *lighting_buffer(Lighting *lighting, const Mesh *mesh, Interpolation remade,
                                Message *message);

/* lighting_program.c */

/* Whether fragments may be computed in 16 bits. */
bool lighting_is_mediump(const Lighting *lighting);

/* The program for these effects, compiled if necessary; 0 on failure. */
GLuint lighting_find_program(Lighting *lighting, const Scene *scene, const Effects *effects,
                             Message *message);

void lighting_close_programs(Lighting *lighting);

/* lighting_shadows.c */

bool shadow_plan_open(ShadowPlan *plan, Lighting *lighting, const Scene *scene, Message *message);
void shadow_plan_close(ShadowPlan *plan);

/* Maps, and `masks` masks. */
bool lighting_draw_shadows(Lighting *lighting, const ShadowFrame *frame, int *masks,
                           Message *message);

/* Masks and maps to texture units; `bind` false: no longer. */
void lighting_bind_shadows(const Lighting *lighting, int masks, bool bind);

/* The uniforms with which a program looks them up. */
void lighting_set_shadows(GLuint program, const Lighting *lighting, int masks,
                          const Object *object);

ShadowLookup lighting_lookup(const Lighting *lighting);

/* What was made of a mesh, or of all: NULL. */
void lighting_forget_shadows(Lighting *lighting, const Mesh *mesh);

#endif
