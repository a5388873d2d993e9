/*
 * shadow_map: pictures of the scene from a light, of depths, and where a surface lies behind them.
 * (Williams, Casting curved shadows on curved surfaces, SIGGRAPH 1978; Reeves, Salesin and Cook,
 * Rendering antialiased shadows with depth maps, SIGGRAPH 1987, for the filter)
 *
 * A depth texture where the driver has one, else packed into the 24 bits of red, green and blue.
 */
#ifndef SHADOW_MAP_H
#define SHADOW_MAP_H

#include "shadows/shadow_frustum.h"
#include "shadows/shadow_mask.h"

enum { SHADOW_MAPS = 32 }; /* lights at most */

/* How a map is looked up. The place is moved by so many texels before it is compared: */
typedef struct ShadowLookup {
    bool smooth;     /* the share of the four nearest texels, weighted by how near; else the
                        nearest */
    double constant; /* towards the light */
    double slope;    /* towards the light, times the tangent of the angle of its arrival */
    double normal;   /* along the normal, times the sine */
} ShadowLookup;

typedef struct ShadowMap {
    GLuint textures[SHADOW_FACES];
    int size, count;
    ShadowFrustum frusta[SHADOW_FACES];
    void *drawn; /* what it was drawn from */
    size_t drawn_size;
} ShadowMap;

/* What programs that look a map up differ in: the bits of a look. */
enum {
    LOOK_SMOOTH = 1,       /* the lookup is */
    LOOK_ALONG_NORMAL = 2, /* its bias has that part */
    LOOK_PERSPECTIVE = 4,  /* the map is */
    LOOK_PACKED = 8,       /* its depths are in colours */
    LOOKS = 16
};

typedef struct ShadowMaps {
    Shader draw, look[LOOKS]; /* the latter opened when they are needed */
    ShaderLoader loader;
    GLuint framebuffer, depth; /* the latter for packed maps */
    int depth_size;
    bool packed;
    int bits; /* of a depth, as it is compared */
    ShadowMap lights[SHADOW_MAPS];
    long long drawn; /* maps so far; the faces of a cube are several */
} ShadowMaps;

bool shadow_maps_open(ShadowMaps *maps, const ShaderLoader *loader, Message *message);
void shadow_maps_forget(ShadowMaps *maps); /* draws all again: meshes have changed */
void shadow_maps_close(ShadowMaps *maps);  /* NULL or zeroed is fine */

typedef struct ShadowMapCaster {
    const MeshBuffer *buffer;
    Mat4 world_from_object;
} ShadowMapCaster;

/* Draws the map of a light, unless it was last drawn from the same. Not within a mask. */
bool shadow_map_draw(ShadowMaps *maps, int light, int size, const ShadowFrustum *frusta, int count,
                     const ShadowMapCaster *casters, int caster_count, Message *message);

/* For a program that includes lighting/shadow_map.glsl: its look, the defines for it, which are
 * written and counted, and its uniforms, whose names end in `suffix`. The texture is not bound. */
enum { LOOK_DEFINES = 4 };
int shadow_map_look(const ShadowMaps *maps, const ShadowFrustum *frustum,
                    const ShadowLookup *lookup);
int shadow_map_defines(int look, const char *defines[LOOK_DEFINES]);
void shadow_map_uniforms(const ShadowMaps *maps, int light, int face, const ShadowLookup *lookup,
                         Mat4 world_from_object, GLuint program, const char *suffix);

/* Within a mask, after the surfaces: marks in a light's channel what of a surface is in shadow. */
bool shadow_map_mark(ShadowMaps *maps, ShadowMask *mask, int light, int channel,
                     const ShadowSurface *surface, Mat4 world_from_object,
                     const ShadowLookup *lookup, Message *message);

#endif
