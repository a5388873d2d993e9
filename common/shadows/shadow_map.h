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
    struct ShadowMapKey {
        void *bytes; /* that differ if the map does */
        size_t size, capacity;
    } drawn; /* what it was drawn from */
} ShadowMap;

/* What programs that look a map up differ in: the bits of a look. */
enum {
    LOOK_SMOOTH = 1,       /* the lookup is */
    LOOK_ALONG_NORMAL = 2, /* its bias has that part */
    LOOK_PERSPECTIVE = 4,  /* the map is */
    LOOK_PACKED = 8,       /* its depths are in colours */
    LOOKS = 16
};

/* Where the uniforms of a program are that looks a map up. */
typedef struct ShadowMapLocations {
    GLint map, light_from_object, light_normal, scale, move, size, bias;
} ShadowMapLocations;

/* One that does so within a mask. */
typedef struct ShadowLook {
    MaskShader shader;
    ShadowMapLocations map;
} ShadowLook;

typedef struct ShadowMaps {
    Shader draw;
    GLint draw_position, draw_clip_from_object;
    ShadowLook looks[LOOKS]; /* opened when they are needed */
    ShaderLoader loader;
    GLuint framebuffer, depth; /* the latter for packed maps */
    int depth_size;
    bool packed;
    int bits; /* of a depth, as it is compared */
    ShadowMap lights[SHADOW_MAPS];
    struct ShadowMapKey key; /* of the map that is asked for */
    long long drawn;         /* maps so far; the faces of a cube are several */
} ShadowMaps;

bool shadow_maps_open(ShadowMaps *maps, const ShaderLoader *loader, Message *message);
void shadow_maps_forget(ShadowMaps *maps); /* draws all again: meshes have changed */
void shadow_maps_close(ShadowMaps *maps);  /* NULL or zeroed is fine */

typedef struct ShadowMapCaster {
    const MeshBuffer *buffer;
    Mat4 world_from_object;
} ShadowMapCaster;

/* Draws the map of a light, unless it was last drawn from the same. Not within a mask. */
typedef struct ShadowMapScene {
    int size, face_count, caster_count;
    const ShadowFrustum *frusta;
    const ShadowMapCaster *casters;
} ShadowMapScene;
bool shadow_map_draw(ShadowMaps *maps, int light, const ShadowMapScene *scene, Message *message);

/* For a program that includes lighting/shadow_map.glsl: its look, the defines for it, which are
 * written and counted, and where its uniforms are, whose names end in `suffix`. */
enum { LOOK_DEFINES = 4 };
int shadow_map_look(const ShadowMaps *maps, const ShadowFrustum *frustum,
                    const ShadowLookup *lookup);
int shadow_map_defines(int look, const char *defines[LOOK_DEFINES]);
ShadowMapLocations shadow_map_locations(GLuint program, const char *suffix);

/* Sets uniforms of the current program: what is the same for all objects, and an object's. The
 * texture is not bound. */
void shadow_map_set(const ShadowMap *map, int face, const ShadowLookup *lookup,
                    const ShadowMapLocations *locations);
void shadow_map_place(const ShadowMap *map, int face, Mat4 world_from_object,
                      const ShadowMapLocations *locations);

/* Within a mask, after the surfaces: marks in a light's channel what of a surface is in shadow. */
typedef struct ShadowMark {
    int light, channel;
    const ShadowSurface *surface;
    Mat4 world_from_object;
    ShadowLookup lookup;
} ShadowMark;
bool shadow_map_mark(ShadowMaps *maps, ShadowMask *mask, const ShadowMark *mark, Message *message);

#endif
