/* Lists of what was made of meshes, each made when it is first asked for. */
#include "lighting/lighting_state.h"

#include "base/memory.h"
#include "core/mesh_make.h"

#include <stdlib.h>

/* In buffers, or as what casts a shadow. */
typedef struct MeshMade {
    const Mesh *mesh;
    Interpolation remade;
    MeshBuffer buffer;
    ShadowCaster shadow;
    struct MeshMade *next;
} MeshMade;

/* A copy as this interpolation needs it. */
static bool remade_copy(const Mesh *mesh, Interpolation kind, Mesh *made, Message *message)
{
    if (!mesh_copy(made, mesh, message))
        return false;
    if (kind == INTERPOLATION_FLAT ? mesh_flatten(made, message) : mesh_provoke(made, message))
        return true;
    mesh_close(made);
    return false;
}

const MeshBuffer *lighting_mesh_buffer(LightingMeshes *meshes, const Mesh *mesh,
                                       Interpolation remade, Message *message)
{
    for (const MeshMade *known = meshes->buffers; known; known = known->next)
        if (known->mesh == mesh && known->remade == remade)
            return &known->buffer;
    const bool own = remade != INTERPOLATION_PHONG;
    MeshMade *made = memory_new(1, sizeof *made);
    Mesh copy = {0};
    const bool done = (!own || remade_copy(mesh, remade, &copy, message)) &&
                      mesh_buffer_open(&made->buffer, own ? &copy : mesh, message);
    mesh_close(&copy);
    if (!done) {
        free(made);
        return NULL;
    }
    made->mesh = mesh;
    made->remade = remade;
    made->next = meshes->buffers;
    meshes->buffers = made;
    return &made->buffer;
}

const ShadowCaster *lighting_mesh_caster(LightingMeshes *meshes, const Mesh *mesh, Message *message)
{
    for (const MeshMade *known = meshes->casters; known; known = known->next)
        if (known->mesh == mesh)
            return &known->shadow;
    MeshMade *made = memory_new(1, sizeof *made);
    if (!shadow_caster_open(&made->shadow, mesh, message)) {
        free(made);
        return NULL;
    }
    made->mesh = mesh;
    made->next = meshes->casters;
    meshes->casters = made;
    return &made->shadow;
}

static void forget(MeshMade **link, const Mesh *mesh)
{
    while (*link) {
        MeshMade *known = *link;
        if (mesh && known->mesh != mesh) {
            link = &known->next;
            continue;
        }
        *link = known->next;
        mesh_buffer_close(&known->buffer);
        shadow_caster_close(&known->shadow);
        free(known);
    }
}

void lighting_meshes_forget(LightingMeshes *meshes, const Mesh *mesh)
{
    forget(&meshes->buffers, mesh);
    forget(&meshes->casters, mesh);
}
