/*
 * lighting_meshes: what was made of meshes, by their address. For lighting's own files.
 */
#ifndef LIGHTING_MESHES_H
#define LIGHTING_MESHES_H

#include "core/mesh_buffer.h"
#include "scene/scene.h"
#include "shadows/shadow_cast.h"

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

#endif
