/*
 * A file of a scene as one mesh. Vertices equal in position and normal are merged, so that computed
 * normals are smooth across triangles.
 */
#include "scene/model.h"

#include "base/memory.h"
#include "core/mesh_make.h"

#include <stdlib.h>
#include <string.h>

/* Appends an object's mesh, in the world. */
static void add_object(const Mesh *part, Mat4 world_from_part, Mesh *mesh)
{
    const Mat4 normal_matrix = mat4_normal(world_from_part); /* zero if singular: no normals */
    /* A reflection reverses the orientation of triangles. */
    const bool mirrored = mat4_determinant(world_from_part) < 0;
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (size_t i = 0; i < part->vertex_count; i++) {
        MeshVertex *vertex = &mesh->vertices[mesh->vertex_count++];
        vec3_to_float(
            mat4_transform_point(world_from_part, vec3_from_float(part->vertices[i].position)),
            vertex->position);
        vec3_to_float(vec3_unit(mat4_transform_direction(
                          normal_matrix, vec3_from_float(part->vertices[i].normal))),
                      vertex->normal);
    }
    for (size_t i = 0; i < part->index_count; i += 3) {
        uint32_t *corner = mesh->indices + mesh->index_count;
        corner[0] = first + part->indices[i];
        corner[1] = first + part->indices[i + (mirrored ? 2 : 1)];
        corner[2] = first + part->indices[i + (mirrored ? 1 : 2)];
        mesh->index_count += 3;
    }
}

/* All meshes of a file, where its nodes have them; of one that is where it is itself. */
static bool flatten(const char *path, SceneFile *file, Mesh *mesh, Message *message)
{
    const Mat4 identity = mat4_identity();
    size_t vertices = 0, indices = 0;
    Message why = {0};
    for (int i = 0; i < file->object_count; i++) {
        vertices += file->meshes[file->objects[i].mesh].vertex_count;
        indices += file->meshes[file->objects[i].mesh].index_count;
    }
    if (!scene_file_fits(vertices, indices, &why))
        return message_set(message, "%s: cannot read: %s", path, why.text);
    Mat4 *poses = memory_new((size_t)file->node_count + 1, sizeof *poses);
    scene_file_pose(file, 0, poses);
    const bool only = file->object_count == 1 && !file->meshes[file->objects[0].mesh].colors &&
                      memcmp(&poses[file->objects[0].node], &identity, sizeof identity) == 0;
    if (only) {
        *mesh = file->meshes[file->objects[0].mesh];
        file->meshes[file->objects[0].mesh] = (Mesh){.vertices = NULL};
    }
    const bool done = only || mesh_open(mesh, vertices, indices, message);
    if (done && !only)
        mesh->vertex_count = mesh->index_count = 0;
    for (int i = 0; i < file->object_count && done && !only; i++)
        add_object(&file->meshes[file->objects[i].mesh], poses[file->objects[i].node], mesh);
    free(poses);
    if (!done || only)
        return done;
    scene_file_tidy(mesh);
    return mesh_check(mesh, &why) || message_set(message, "%s: %s", path, why.text);
}

/* Keeps the vertices that triangles use, and of equal ones, if they are to be welded, the first. */
static bool join(Mesh *mesh, bool weld, Message *message)
{
    /* Of each vertex the first that equals it, and that one's place in the mesh plus 1. */
    uint32_t *first = calloc(2 * mesh->vertex_count + 1, sizeof *first), count = 0;
    uint32_t *places = first + mesh->vertex_count;
    const bool done = first && (!weld || mesh_weld(mesh, true, first));
    for (uint32_t i = 0; i < mesh->vertex_count && done && !weld; i++)
        first[i] = i;
    for (size_t i = 0; i < mesh->index_count && done; i++) {
        mesh->indices[i] = first[mesh->indices[i]];
        places[mesh->indices[i]] = 1;
    }
    for (size_t i = 0; i < mesh->vertex_count && done; i++)
        if (places[i]) {
            mesh->vertices[count++] = mesh->vertices[i];
            places[i] = count;
        }
    for (size_t i = 0; i < mesh->index_count && done; i++)
        mesh->indices[i] = places[mesh->indices[i]] - 1;
    mesh->vertex_count = done ? count : mesh->vertex_count;
    free(first);
    return done || message_set(message, "mesh: not enough memory for its vertices");
}

static bool lacks_normals(const Mesh *mesh)
{
    bool lacks = false;
    for (size_t i = 0; i < mesh->index_count && !lacks; i++) {
        const float *n = mesh->vertices[mesh->indices[i]].normal;
        lacks = n[0] == 0 && n[1] == 0 && n[2] == 0;
    }
    return lacks;
}

bool model_complete(Mesh *mesh, Message *message)
{
    return !lacks_normals(mesh) ||
           ((mesh->colors || mesh->lit_positions || join(mesh, true, message)) &&
            mesh_compute_normals(mesh, MESH_WEIGHT_ANGLE, true, message));
}

bool model_read(const char *path, ModelUp up, Mesh *mesh, Message *message)
{
    SceneFile file;
    *mesh = (Mesh){0};
    bool done = scene_file_read(path, up, &file, message) && flatten(path, &file, mesh, message);
    if (done && mesh->index_count == 0)
        done = message_set(message, "%s: holds no triangle with an area", path);
    const bool lacks = done && lacks_normals(mesh);
    done = done && join(mesh, lacks || mesh->vertex_count > mesh->index_count / 3, message) &&
           (!lacks || mesh_compute_normals(mesh, MESH_WEIGHT_ANGLE, true, message));
    scene_file_close(&file);
    if (!done)
        mesh_close(mesh);
    return done;
}
