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
        vec3_to_float(
            mat4_transform_direction(normal_matrix, vec3_from_float(part->vertices[i].normal)),
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

/* All meshes of a file, where its nodes have them. */
static bool flatten(const char *path, const SceneFile *file, Mesh *mesh, Message *message)
{
    size_t vertices = 0, indices = 0;
    Message why = {0};
    for (int i = 0; i < file->object_count; i++) {
        vertices += file->meshes[file->objects[i].mesh].vertex_count;
        indices += file->meshes[file->objects[i].mesh].index_count;
    }
    if (!scene_file_fits(vertices, indices, &why))
        return message_set(message, "%s: cannot read: %s", path, why.text);
    if (!mesh_open(mesh, vertices, indices, message))
        return false;
    mesh->vertex_count = mesh->index_count = 0;
    Mat4 *poses = memory_new((size_t)file->node_count + 1, sizeof *poses);
    scene_file_pose(file, 0, poses);
    for (int i = 0; i < file->object_count; i++)
        add_object(&file->meshes[file->objects[i].mesh], poses[file->objects[i].node], mesh);
    free(poses);
    return mesh_check(mesh, &why) || message_set(message, "%s: %s", path, why.text);
}

/* Keeps triangles with an area and the vertices they use, equal ones merged. */
static bool join(const char *path, const Mesh *parts, Mesh *mesh, Message *message)
{
    /* Of each vertex the first that equals it, and that one's place in the mesh plus 1. */
    uint32_t *first = calloc(2 * parts->vertex_count + 1, sizeof *first);
    uint32_t *places = first + parts->vertex_count;
    if (!first || !mesh_weld(parts, true, first)) {
        free(first);
        return message_set(message, "%s: not enough memory for its vertices", path);
    }
    if (!mesh_open(mesh, parts->vertex_count, parts->index_count, message)) {
        free(first);
        return false;
    }
    mesh->vertex_count = mesh->index_count = 0;
    for (size_t triangle = 0; triangle < parts->index_count / 3; triangle++) {
        Vec3 normal;
        if (!mesh_face(parts, triangle, &normal))
            continue;
        for (size_t i = 3 * triangle; i < 3 * triangle + 3; i++) {
            const uint32_t number = first[parts->indices[i]];
            if (!places[number]) {
                mesh->vertices[mesh->vertex_count++] = parts->vertices[number];
                places[number] = (uint32_t)mesh->vertex_count;
            }
            mesh->indices[mesh->index_count++] = places[number] - 1;
        }
    }
    free(first);
    if (mesh->index_count == 0)
        return message_set(message, "%s: holds no triangle with an area", path);
    return true;
}

static bool is_zero(const float normal[3])
{
    return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

/* Gives vertices without a normal that of a copy, all of whose normals are computed. */
static bool fill_normals(Mesh *mesh, Message *message)
{
    Mesh copy = *mesh;
    copy.vertices = malloc(mesh->vertex_count * sizeof *mesh->vertices);
    if (!copy.vertices)
        return message_set(message, "model: not enough memory for the normals of %zu vertices",
                           mesh->vertex_count);
    memcpy(copy.vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    const bool done = mesh_compute_normals(&copy, MESH_WEIGHT_ANGLE, message);
    for (size_t i = 0; done && i < mesh->vertex_count; i++)
        if (is_zero(mesh->vertices[i].normal))
            mesh->vertices[i] = copy.vertices[i];
    free(copy.vertices);
    return done;
}

static bool complete_normals(Mesh *mesh, Message *message)
{
    bool missing = false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *normal = mesh->vertices[i].normal;
        Vec3 unit;
        vec3_normalize((Vec3){normal[0], normal[1], normal[2]}, &unit);
        vec3_to_float(unit, normal);
        missing |= is_zero(normal);
    }
    return !missing || fill_normals(mesh, message);
}

bool model_complete(Mesh *mesh, Message *message)
{
    Mesh joined;
    bool missing = false;
    for (size_t i = 0; i < mesh->index_count && !missing; i++)
        missing = is_zero(mesh->vertices[mesh->indices[i]].normal);
    if (!missing || mesh->colors || mesh->lit_positions)
        return !missing || fill_normals(mesh, message);
    if (!join("mesh", mesh, &joined, message))
        return false;
    mesh_close(mesh);
    *mesh = joined;
    return fill_normals(mesh, message);
}

/* Whether there is nothing to join: a vertex is used three times on average, as in a file with
 * indices, and each at least once; triangles have an area. */
static bool is_joined(const Mesh *mesh)
{
    if (mesh->index_count == 0 || mesh->vertex_count > mesh->index_count / 3)
        return false;
    bool *used = memory_new(mesh->vertex_count + 1, sizeof *used);
    bool joined = true;
    for (size_t i = 0; i < mesh->index_count; i++)
        used[mesh->indices[i]] = true;
    for (size_t i = 0; i < mesh->vertex_count && joined; i++)
        joined = used[i];
    free(used);
    for (size_t i = 0; i < mesh->index_count / 3 && joined; i++) {
        Vec3 normal;
        joined = mesh_face(mesh, i, &normal);
    }
    return joined;
}

bool model_read(const char *path, ModelUp up, Mesh *mesh, Message *message)
{
    SceneFile file;
    Mesh parts = {.vertices = NULL};
    *mesh = (Mesh){0};
    bool done = scene_file_read(path, up, &file, message) && flatten(path, &file, &parts, message);
    if (done && is_joined(&parts)) {
        *mesh = parts;
        parts = (Mesh){.vertices = NULL};
    } else if (done) {
        done = join(path, &parts, mesh, message);
    }
    done = done && complete_normals(mesh, message);
    scene_file_close(&file);
    mesh_close(&parts);
    if (!done)
        mesh_close(mesh);
    return done;
}
