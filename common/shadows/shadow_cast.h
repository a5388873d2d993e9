/*
 * shadow_cast: what casters keep from a light, counted in the stencil of a mask.
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
 */
#ifndef SHADOW_CAST_H
#define SHADOW_CAST_H

#include "shadows/shadow_mask.h"
#include "shadows/silhouette.h"

/* A mesh that casts shadows. */
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
    ShadowVolumeKind kind;
    GLuint indices[SHADOW_VOLUME_LISTS];
    GLsizei counts[SHADOW_VOLUME_LISTS];
} UploadedVolume;

/* The volumes of a scene. Zeroed: none. */
typedef struct ShadowVolumes {
    ShadowVolume volume;      /* while one is made */
    UploadedVolume *uploaded; /* in the order of the last frame, which the next mostly has, too */
    size_t uploaded_count, uploaded_capacity, next;
    long long drawn; /* so far, for tests and --explain's reader */
    long long made;  /* of those drawn: others were as in the last frame */
} ShadowVolumes;

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

/* Begins a mask's volumes; counts those of a caster; ends, and drops what was not used again, all
 * if `failed`. */
void shadow_cast_begin(ShadowVolumes *volumes);
bool shadow_cast(ShadowVolumes *volumes, ShadowMask *mask, const ShadowThrow *thrown,
                 Message *message);
void shadow_cast_end(ShadowVolumes *volumes, bool failed);

/* Makes all volumes again: casters are closed. */
void shadow_volumes_forget(ShadowVolumes *volumes);
void shadow_volumes_close(ShadowVolumes *volumes);

#endif
