/*
 * What model.c asks of Assimp. Built as a module, loaded at the first need.
 */
#include "model.h"
#include "model_module.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <stdio.h>
#include <stdlib.h>

/* A walk through the nodes: with a mesh to fill, or none, to count. */
typedef struct Walk {
    const struct aiScene *scene;
    Mesh *mesh;
    size_t vertex_count, index_count;
} Walk;

/* Assimp's matrices are for columns too, but stored row after row. */
static Mat4 matrix(const struct aiMatrix4x4 *a)
{
    return (Mat4){{a->a1, a->b1, a->c1, a->d1, a->a2, a->b2, a->c2, a->d2, a->a3, a->b3, a->c3,
                   a->d3, a->a4, a->b4, a->c4, a->d4}};
}

static Vec3 vector(const struct aiVector3D *a)
{
    return (Vec3){a->x, a->y, a->z};
}

static void add_vertices(Walk *walk, const struct aiMesh *part, Mat4 world_from_part)
{
    Mat4 normal_matrix;
    mat4_normal(world_from_part, &normal_matrix); /* zero where there is none: no normals */
    MeshVertex *vertex = walk->mesh->vertices + walk->vertex_count;
    for (unsigned i = 0; i < part->mNumVertices; i++, vertex++) {
        vec3_to_float(mat4_transform_point(world_from_part, vector(&part->mVertices[i])),
                      vertex->position);
        if (part->mNormals)
            vec3_to_float(mat4_transform_direction(normal_matrix, vector(&part->mNormals[i])),
                          vertex->normal);
    }
}

static void add_part(Walk *walk, const struct aiMesh *part, Mat4 world_from_part)
{
    const uint32_t first = (uint32_t)walk->vertex_count;
    /* What turns a part inside out turns its triangles the other way round. */
    const bool mirrored = mat4_determinant(world_from_part) < 0;
    if (walk->mesh)
        add_vertices(walk, part, world_from_part);
    for (unsigned i = 0; i < part->mNumFaces; i++) {
        const struct aiFace *face = &part->mFaces[i];
        if (face->mNumIndices != 3)
            continue; /* a point or a line */
        if (walk->mesh) {
            uint32_t *corner = walk->mesh->indices + walk->index_count;
            corner[0] = first + face->mIndices[0];
            corner[1] = first + face->mIndices[mirrored ? 2 : 1];
            corner[2] = first + face->mIndices[mirrored ? 1 : 2];
        }
        walk->index_count += 3;
    }
    walk->vertex_count += part->mNumVertices;
}

static void visit(Walk *walk, const struct aiNode *node, Mat4 world_from_parent)
{
    const Mat4 world_from_node = mat4_product(world_from_parent, matrix(&node->mTransformation));
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        add_part(walk, walk->scene->mMeshes[node->mMeshes[i]], world_from_node);
    for (unsigned i = 0; i < node->mNumChildren; i++)
        visit(walk, node->mChildren[i], world_from_node);
}

static bool collect(const struct aiScene *scene, Mesh *mesh, char *reason, size_t reason_size)
{
    Walk count = {.scene = scene}, fill = {.scene = scene, .mesh = mesh};
    Message message = {0};
    visit(&count, scene->mRootNode, mat4_identity());
    if (count.vertex_count > MODEL_VERTICES_MOST || count.index_count / 3 > MODEL_TRIANGLES_MOST) {
        snprintf(reason, reason_size, "%zu vertices and %zu triangles; at most %d and %d are read",
                 count.vertex_count, count.index_count / 3, MODEL_VERTICES_MOST,
                 MODEL_TRIANGLES_MOST);
        return false;
    }
    if (!mesh_open(mesh, count.vertex_count, count.index_count, &message)) {
        snprintf(reason, reason_size, "%s", message.text);
        return false;
    }
    visit(&fill, scene->mRootNode, mat4_identity());
    return true;
}

static bool read(const char *path, Mesh *mesh, char *reason, size_t reason_size)
{
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    /* A file of bones alone has no triangles; do not make some up. */
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    const struct aiScene *scene = aiImportFileExWithProperties(
        path, aiProcess_Triangulate | aiProcess_ValidateDataStructure, NULL, properties);
    aiReleasePropertyStore(properties);
    if (!scene) {
        snprintf(reason, reason_size, "%s", aiGetErrorString());
        return false;
    }
    const bool collected = collect(scene, mesh, reason, reason_size);
    aiReleaseImport(scene);
    return collected;
}

__attribute__((visibility("default"))) const ModelModule *model_module(void);

const ModelModule *model_module(void)
{
    static char version[32];
    static const ModelModule module = {version, read};
    snprintf(version, sizeof version, "%u.%u.%u", aiGetVersionMajor(), aiGetVersionMinor(),
             aiGetVersionPatch());
    return &module;
}
