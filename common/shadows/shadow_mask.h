/*
 * shadow_mask: which pixels are in the shadow of which light, as textures that a program looks up:
 * one channel for each light, 1 in shadow, 0 in light.
 *
 * By stencil volumes (Crow, Shadow algorithms for computer graphics, 1977), whose faces are counted
 * behind the surfaces, where they fail the depth test: right too if the eye is in shadow, and if
 * the near plane cuts a volume (Everitt and Kilgard, Practical and Robust Stenciled Shadow Volumes
 * for Hardware-Accelerated Rendering, 2002). If no segment from the near plane to the light meets
 * the caster's box, they are counted before the surfaces, which needs no caps, except at an end
 * that the eye lies beyond. A pixel is in shadow if between the surface at its center and the light
 * there is a triangle other than the surface's own, or if the light is on the other side of the
 * surface's own than its normal. Where a cap is the surface itself, both have bitwise the same
 * depth.
 *
 * Where everything that receives a light's shadows is flat, they may be drawn flattened onto it
 * (Blinn, Me and my (fake) shadow, IEEE CG&A 8(1), 1988); and shadow_map.h compares depths.
 */
#ifndef SHADOW_MASK_H
#define SHADOW_MASK_H

#include "core/mesh_buffer.h"
#include "core/shader.h"
#include "shadows/silhouette.h"

enum { SHADOW_MASKS = 8, SHADOW_CHANNELS = 4 }; /* textures at most; lights in each */

/* A mesh that throws shadows. */
typedef struct ShadowCaster {
    Silhouette silhouette;
    GLuint vertices; /* two for each of the mesh: as it is, and to be moved to infinity */
} ShadowCaster;

bool shadow_caster_open(ShadowCaster *caster, const Mesh *mesh, Message *message);
void shadow_caster_close(ShadowCaster *caster); /* NULL or zeroed is fine */

/* The volume of one caster and light, uploaded: its caps by shadow_volume_caps, then its sides. */
enum { SHADOW_VOLUME_SIDES = 4, SHADOW_VOLUME_LISTS = 5 };
typedef struct UploadedVolume {
    /* What it was made from, as shadow_volume_make. */
    const ShadowCaster *caster; /* NULL: none */
    Vec4 light;
    SilhouetteFacing facing;
    ShadowEnd end;
    bool dark;
    GLuint indices[SHADOW_VOLUME_LISTS];
    GLsizei counts[SHADOW_VOLUME_LISTS];
} UploadedVolume;

typedef struct ShadowMask {
    Shader shader, flatten; /* the latter opened when it is needed */
    ShaderLoader loader;
    GLuint framebuffer, depth, textures[SHADOW_MASKS], square;
    int width, height;
    ShadowVolume volume;      /* while one is made */
    UploadedVolume *uploaded; /* in the order of the last frame, which the next mostly has, too */
    size_t uploaded_count, uploaded_capacity, next;
    /* While it is drawn: */
    GLint target, place[4]; /* what is drawn to afterwards, and its viewport */
    double near;
    GLuint program;
    long long volumes, triangles; /* drawn so far, for tests and --explain's reader */
    long long made;               /* of the volumes: others were as in the last frame */
    long long flattened;          /* shadows drawn onto planes so far */
} ShadowMask;

/* False if the shaders do not compile or the driver has no packed depth and stencil. */
bool shadow_mask_open(ShadowMask *mask, const ShaderLoader *loader, Message *message);
void shadow_mask_forget(ShadowMask *mask); /* makes all volumes again: casters are closed */
void shadow_mask_close(ShadowMask *mask);  /* NULL or zeroed is fine */

/* In this order: begins a mask for the framebuffer and viewport that are bound, with `count`
 * textures; draws the surfaces; for each light its casters, then what is left of the mask; ends,
 * and binds what was bound. `near` is the camera's. */
bool shadow_mask_begin(ShadowMask *mask, int count, double near, Message *message);

typedef struct ShadowSurface {
    const MeshBuffer *buffer;
    Mat4 clip_from_object;
    bool mirrored, clockwise; /* by the transform; front faces are clockwise in the mesh */
    bool cull;                /* its back faces are not drawn */
    bool behind_lines;        /* pushed back, as Object.behind_lines */
} ShadowSurface;
void shadow_mask_surface(ShadowMask *mask, const ShadowSurface *surface);

/* What a caster keeps from a light. */
typedef struct ShadowThrow {
    ShadowSurface surface;
    const ShadowCaster *caster;
    Vec4 light_object; /* in object coordinates: its position, or w = 0: the direction towards it */
    /* A plane in object coordinates, before which everything lies that the shadow may fall on: the
     * dot product with (x, y, z, 1) is not negative. (0, 0, 0, 1): infinity. */
    Vec4 end;
    SilhouetteFacing facing;
    bool two_sided; /* the back has the opposite normal */
    bool behind;    /* count behind the surfaces (depth fail), because the eye may be in the volume;
                       else before them: no caps on the mesh */
    bool beyond;    /* the eye may be beyond the end, and look into the volume through it */
    bool own;       /* the caster's own surface looks up this light */
    bool odd;       /* light may fall where the mesh's normals say that none does */
} ShadowThrow;
bool shadow_mask_cast(ShadowMask *mask, const ShadowThrow *thrown, Message *message);
void shadow_mask_light(ShadowMask *mask, int channel);

/* Instead of casting: draws a surface that is flat, with a number of its own from 0 on, then what
 * throws shadows on it, flattened: onto the plane `end`, on whose positive side the light is. */
enum { SHADOW_FLATS = 126 };
void shadow_mask_flat(ShadowMask *mask, const ShadowSurface *surface, int number);
bool shadow_mask_flatten(ShadowMask *mask, const ShadowThrow *thrown, int number, Message *message);

/* Or: what another program draws over the surfaces, at exactly their depths, goes to a channel; -1:
 * no longer. */
void shadow_mask_write(ShadowMask *mask, int channel, const Shader *shader);
void shadow_mask_draw(ShadowMask *mask, const ShadowSurface *surface, GLint normal);
bool shadow_mask_end(ShadowMask *mask, Message *message);

/* Binds the textures of the last mask to the units from 0 on; NULL: unbinds so many. */
void shadow_mask_bind(const ShadowMask *mask, int count);

#endif
