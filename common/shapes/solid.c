/*
 * A formula's mesh of any fineness. The fineness is one number, the parts of a full turn; what else
 * a shape's mesh needs follows from it, so that triangles stay about as high as they are wide: a
 * quarter as many stacks of a side, which is a quarter as long as the way around; half as many
 * parts around a tube.
 */
#include "shapes/solid.h"

#include "base/memory.h"
#include "core/mesh_make.h"

#include <stdlib.h>

static int at_least(int min, int count)
{
    return count > min ? count : min;
}

/* A cube whose faces are grids, in the order of mesh_cube. */
static bool box_mesh(double half_side, int divisions, Mesh *mesh, Message *message)
{
    const size_t side = (size_t)divisions + 1;
    Mesh cube;
    if (!mesh_cube(&cube, half_side, message))
        return false;
    if (!mesh_open(mesh, 6 * side * side, 6 * mesh_grid_size(divisions, divisions, MESH_POLE_NONE),
                   message)) {
        mesh_close(&cube);
        return false;
    }
    uint32_t *indices = mesh->indices;
    MeshVertex *vertex = mesh->vertices;
    for (size_t face = 0; face < 6; face++) {
        /* Rows lead from corner 0 to 1, columns from corner 0 to 3. */
        const MeshVertex *corner = cube.vertices + 4 * face;
        indices = mesh_grid(indices, (uint32_t)(vertex - mesh->vertices), divisions, divisions,
                            MESH_POLE_NONE);
        for (int row = 0; row <= divisions; row++)
            for (int column = 0; column <= divisions; column++, vertex++) {
                const double down = (double)row / divisions, right = (double)column / divisions;
                *vertex = corner[0];
                for (int k = 0; k < 3; k++) {
                    const double first = (double)corner[0].position[k];
                    vertex->position[k] =
                        (float)(first + down * ((double)corner[1].position[k] - first) +
                                right * ((double)corner[3].position[k] - first));
                }
            }
    }
    mesh_close(&cube);
    return true;
}

bool solid_mesh(const Solid *solid, int divisions, Mesh *mesh, Message *message)
{
    const double radius = solid->radius, height = solid->height;
    *mesh = (Mesh){.vertices = NULL};
    if (!mesh_check_count("solid", "divisions", divisions, SOLID_MIN_DIVISIONS, SOLID_MAX_DIVISIONS,
                          message))
        return false;
    const int quarter = at_least(1, divisions / 4);
    switch (solid->kind) {
    case SOLID_SPHERE:
        return mesh_sphere(mesh, radius, divisions, divisions, message);
    case SOLID_BOX:
        return box_mesh(radius, divisions, mesh, message);
    case SOLID_QUAD:
        return mesh_quad(mesh, divisions, message);
    case SOLID_DISC:
        return mesh_disc(mesh, radius, divisions, quarter, message);
    case SOLID_CYLINDER:
        return mesh_cylinder(mesh, (MeshCylinder){radius, height, divisions, quarter, solid->caps},
                             message);
    case SOLID_CONE:
        return mesh_cone(mesh, radius, height, divisions, quarter, message);
    case SOLID_TORUS:
        return mesh_torus(mesh, solid->tube, radius, at_least(3, divisions / 2), divisions,
                          message);
    case SOLID_TEAPOT:
        return mesh_teapot(mesh, radius, at_least(2, quarter), message);
    case SOLID_NONE:
        break;
    }
    return message_set(message, "solid: a shape without a formula has no other mesh");
}

bool solid_flat(const Solid *solid)
{
    return solid->kind == SOLID_BOX || solid->kind == SOLID_QUAD || solid->kind == SOLID_DISC;
}

static bool same_solid(const Solid *a, const Solid *b)
{
    return a->kind == b->kind && a->radius == b->radius && a->height == b->height &&
           a->tube == b->tube && a->caps == b->caps;
}

const Mesh *solid_meshes_find(SolidMeshes *meshes, const Solid *solid, int divisions,
                              Message *message)
{
    for (const SolidMesh *have = meshes->first; have; have = have->next)
        if (have->divisions == divisions && same_solid(&have->solid, solid))
            return &have->mesh;
    SolidMesh *made = memory_new(1, sizeof *made);
    if (!solid_mesh(solid, divisions, &made->mesh, message)) {
        free(made);
        return NULL;
    }
    made->solid = *solid;
    made->divisions = divisions;
    made->next = meshes->first;
    meshes->first = made;
    return &made->mesh;
}

void solid_meshes_close(SolidMeshes *meshes)
{
    while (meshes->first) {
        SolidMesh *made = meshes->first;
        meshes->first = made->next;
        mesh_close(&made->mesh);
        free(made);
    }
}
