/*
 * shadow_mask: which pixels are in the shadow of which light, as textures that a program looks up:
 * one channel for each light, 1 in shadow, 0 in light.
 *
 * shadow_cast.h counts volumes in the stencil; shadow_map.h compares depths.
 */
#ifndef SHADOW_MASK_H
#define SHADOW_MASK_H

#include "core/mesh_buffer.h"
#include "core/shader.h"

enum { SHADOW_MASKS = 8, SHADOW_CHANNELS = 4 }; /* textures at most; lights in each */

/* A program that draws surfaces or volumes into a mask, and where its variables are; -1: nowhere.
 */
typedef struct MaskShader {
    Shader shader;
    GLint position, normal, clip_from_object, near;
    GLint center, light, end; /* of volumes */
} MaskShader;
MaskShader mask_shader(const Shader *shader);

typedef struct ShadowMask {
    MaskShader shader;
    GLuint framebuffer, depth, textures[SHADOW_MASKS], square;
    int width, height;
    /* While it is drawn: */
    GLint target, place[4]; /* what is drawn to afterwards, and its viewport */
    double near;
    const MaskShader *current;
} ShadowMask;

/* False if the shaders do not compile or the driver has no packed depth and stencil. */
bool shadow_mask_open(ShadowMask *mask, const ShaderLoader *loader, Message *message);
void shadow_mask_close(ShadowMask *mask); /* NULL or zeroed is fine */

/* In this order: begins a mask for the framebuffer and viewport that are bound, with `count`
 * textures; draws the surfaces; for each light counts what its casters keep from it, and writes
 * that; ends, and binds what was bound. `near` is the camera's. */
bool shadow_mask_begin(ShadowMask *mask, int count, double near, Message *message);

typedef struct ShadowSurface {
    const MeshBuffer *buffer;
    Mat4 clip_from_object;
    bool mirrored, clockwise; /* by the transform; front faces are clockwise in the mesh */
    bool cull;                /* its back faces are not drawn */
    bool behind_lines;        /* pushed back, as Object.behind_lines */
} ShadowSurface;

/* For what is drawn besides (shadows/shadow_cast.h): its transform, and the winding and the offset
 * that the surface is drawn with. */
void shadow_mask_transform(const ShadowMask *mask, Mat4 clip_from_object, double near);
void shadow_mask_state(const ShadowSurface *surface, bool clockwise);

/* What the stencil has counted since the last light goes to the channel of this one. */
enum { SHADOW_NONE = 128 }; /* the count of no volume: less than that is no shadow */
void shadow_mask_light(ShadowMask *mask, int channel);

/* Or: what another program draws over the surfaces, at exactly their depths, goes to a channel;
 * NULL: no longer. */
void shadow_mask_write(ShadowMask *mask, int channel, const MaskShader *shader);
void shadow_mask_draw(ShadowMask *mask, const ShadowSurface *surface);

bool shadow_mask_end(ShadowMask *mask, Message *message);

/* Binds the textures of the last mask to the units from 0 on; NULL: unbinds so many. */
void shadow_mask_bind(const ShadowMask *mask, int count);

#endif
