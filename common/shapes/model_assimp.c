/*
 * The plugin that reads model files with Assimp.
 */
#include "core/mesh_make.h"
#include "shapes/model_module.h"
#include "shapes/model_ply.h"

#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <stdio.h>
#include <string.h>

/* A traversal of the nodes: fills the mesh, or without one counts. */
typedef struct Walk {
    const struct aiScene *scene;
    Mesh *mesh;
    size_t vertex_count, index_count;
} Walk;

/* Assimp's matrices are for column vectors too, but stored row-major. */
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
    const Mat4 normal_matrix = mat4_normal(world_from_part); /* zero if singular: no normals */
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
    /* A reflection reverses the orientation of triangles. */
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

/* The rotation that turns an axis, 0 to 2, or its opposite, to y. */
static Mat4 upright(int axis, bool down)
{
    const Mat4 turned = axis == 0   ? mat4_rotate(90, (Vec3){0, 0, 1})
                        : axis == 2 ? mat4_rotate(-90, (Vec3){1, 0, 0})
                                    : mat4_identity();
    return down ? mat4_product(mat4_rotate(180, (Vec3){0, 0, 1}), turned) : turned;
}

static bool metadata_is(const struct aiScene *scene, const char *key, int *value)
{
    const struct aiMetadata *all = scene->mMetaData;
    for (unsigned i = 0; all && i < all->mNumProperties; i++) {
        if (strcmp(all->mKeys[i].data, key) == 0 && all->mValues[i].mType == AI_INT32) {
            *value = *(const int32_t *)all->mValues[i].mData;
            return true;
        }
    }
    return false;
}

static bool importer_is(const struct aiScene *scene, const char *name)
{
    const struct aiMetadata *all = scene->mMetaData;
    for (unsigned i = 0; all && i < all->mNumProperties; i++)
        if (strcmp(all->mKeys[i].data, AI_METADATA_SOURCE_FORMAT) == 0 &&
            all->mValues[i].mType == AI_AISTRING)
            return strstr(((const struct aiString *)all->mValues[i].mData)->data, name);
    return false;
}

/* Assimp itself turns z of 3DS files to y, and the axis that a COLLADA file names (unless
 * read_file forbids it). It reports an FBX file's axis, and leaves it as it is or, since 5.4, turns
 * the root by the file's three axes: by a singular matrix where the file names one only. */
static Mat4 stand_up(const struct aiScene *scene, ModelUp up)
{
    int axis = 1, sign = 1;
    const bool turned = importer_is(scene, "3DS");
    if (up != MODEL_UP_FILE)
        return mat4_product(upright((int)up - MODEL_UP_X, false),
                            turned ? mat4_rotate(90, (Vec3){1, 0, 0}) : mat4_identity());
    if (importer_is(scene, "STL") || importer_is(scene, "Blender"))
        return upright(2, false);
    if (metadata_is(scene, "UpAxis", &axis))
        metadata_is(scene, "UpAxisSign", &sign);
    return upright(axis, sign < 0);
}

static bool collect(const struct aiScene *scene, ModelUp up, Mesh *mesh, char *reason,
                    size_t reason_size)
{
    const Mat4 world_from_file = stand_up(scene, up);
    Walk count = {.scene = scene}, fill = {.scene = scene, .mesh = mesh};
    Message message = {0};
    if (importer_is(scene, "FBX"))
        aiIdentityMatrix4(&scene->mRootNode->mTransformation);
    visit(&count, scene->mRootNode, world_from_file);
    if (count.vertex_count > MODEL_VERTICES_MAX || count.index_count / 3 > MODEL_TRIANGLES_MAX) {
        snprintf(reason, reason_size, "%zu vertices and %zu triangles; at most %d and %d are read",
                 count.vertex_count, count.index_count / 3, MODEL_VERTICES_MAX,
                 MODEL_TRIANGLES_MAX);
        return false;
    }
    if (!mesh_open(mesh, count.vertex_count, count.index_count, &message)) {
        snprintf(reason, reason_size, "%s", message.text);
        return false;
    }
    visit(&fill, scene->mRootNode, world_from_file);
    return true;
}

static bool read_file(const char *path, ModelUp up, Mesh *mesh, char *reason, size_t reason_size)
{
    if (!model_ply_is_whole(path, reason, reason_size))
        return false;
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    /* By default Assimp makes meshes for files of bones alone. */
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION,
                               up != MODEL_UP_FILE);
    const struct aiScene *scene = aiImportFileExWithProperties(
        path, aiProcess_Triangulate | aiProcess_ValidateDataStructure, NULL, properties);
    aiReleasePropertyStore(properties);
    if (!scene) {
        snprintf(reason, reason_size, "%s", aiGetErrorString());
        return false;
    }
    const bool collected = collect(scene, up, mesh, reason, reason_size);
    aiReleaseImport(scene);
    return collected;
}

static const char *version(void)
{
    static char text[32];
    snprintf(text, sizeof text, "%u.%u.%u", aiGetVersionMajor(), aiGetVersionMinor(),
             aiGetVersionPatch());
    return text;
}

__attribute__((visibility("default"))) const ModelModule model_module = {version, read_file};
