/*
 * The plugin that reads files of scenes with Assimp; glTF 2.0 goes to gltf.c, OBJ to
 * model_obj.c, PLY to model_ply.c.
 */
#include "base/memory.h"
#include "core/mesh_make.h"
#include "scene/assimp_files.h"
#include "scene/model_module.h"
#include "scene/texture_mean.h"

#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is read into what. */
typedef struct Walk {
    const struct aiScene *scene;
    SceneFile *file;
    const Folder *folder; /* of the file */
    Object *materials;    /* of an object with this material */
    double scale;         /* of the file's lengths in the world */
    Message *reason;
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

static void set_name(char name[FILE_NAME], const char *text)
{
    snprintf(name, FILE_NAME, "%.47s", text);
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
        return mat4_product(scene_file_upright((int)up - MODEL_UP_X, false),
                            turned ? mat4_rotate(90, (Vec3){1, 0, 0}) : mat4_identity());
    if (importer_is(scene, "STL") || importer_is(scene, "Blender"))
        return scene_file_upright(2, false);
    if (metadata_is(scene, "UpAxis", &axis))
        metadata_is(scene, "UpAxisSign", &sign);
    return scene_file_upright(axis, sign < 0);
}

/* Meshes */

static bool fill_mesh(const struct aiMesh *part, Vec3 diffuse, Mesh *mesh, Message *reason)
{
    const struct aiColor4D *colors = part->mColors[0];
    if (!mesh_open(mesh, part->mNumVertices, 3 * (size_t)part->mNumFaces, reason) ||
        (colors && !mesh_open_colors(mesh, reason)))
        return false;
    for (unsigned i = 0; i < part->mNumVertices; i++) {
        vec3_to_float(vector(&part->mVertices[i]), mesh->vertices[i].position);
        if (part->mNormals)
            vec3_to_float(vector(&part->mNormals[i]), mesh->vertices[i].normal);
        if (colors)
            vec3_to_float(color_within_one((Vec3){colors[i].r * diffuse.x, colors[i].g * diffuse.y,
                                                  colors[i].b * diffuse.z}),
                          mesh->colors[i]);
    }
    mesh->index_count = 0;
    for (unsigned i = 0; i < part->mNumFaces; i++) {
        const struct aiFace *face = &part->mFaces[i];
        for (unsigned k = 0; face->mNumIndices == 3 && k < 3; k++) /* no point and no line */
            mesh->indices[mesh->index_count++] = face->mIndices[k];
    }
    return true;
}

static bool color_of(const struct aiMaterial *material, const char *key, Vec3 *color)
{
    struct aiColor4D found;
    if (aiGetMaterialColor(material, key, 0, 0, &found) != aiReturn_SUCCESS)
        return false;
    *color = color_within_one((Vec3){found.r, found.g, found.b});
    return true;
}

static double number_of(const struct aiMaterial *material, const char *key, double usual)
{
    float found;
    return aiGetMaterialFloatArray(material, key, 0, 0, &found, NULL) == aiReturn_SUCCESS &&
                   isfinite(found)
               ? (double)found
               : usual;
}

static void note_material(SceneFile *file, const struct aiMaterial *material, double alpha)
{
    bool base = false, textures = false;
    for (int kind = 1; kind <= AI_TEXTURE_TYPE_MAX; kind++)
        *(kind == aiTextureType_DIFFUSE || kind == aiTextureType_BASE_COLOR ? &base : &textures) |=
            aiGetMaterialTextureCount(material, (enum aiTextureType)kind) > 0;
    scene_file_note(file, base, NOTE_MEAN);
    scene_file_note(file, textures, NOTE_TEXTURES);
    scene_file_note(file, alpha < 1, NOTE_TRANSPARENT);
}

/* Of the texture of a material's diffuse colour; white: it has none. */
static Vec3 texture_color(Walk *walk, const struct aiMaterial *material)
{
    struct aiString path;
    Message why = {0};
    size_t size = 0;
    if (aiGetMaterialTexture(material, aiTextureType_DIFFUSE, 0, &path, NULL, NULL, NULL, NULL,
                             NULL, NULL) != aiReturn_SUCCESS &&
        aiGetMaterialTexture(material, aiTextureType_BASE_COLOR, 0, &path, NULL, NULL, NULL, NULL,
                             NULL, NULL) != aiReturn_SUCCESS)
        return (Vec3){1, 1, 1};
    char *bytes = assimp_texture(walk->scene, walk->folder, path.data, &size, &why);
    return texture_mean(walk->file, path.data, bytes, size, &why);
}

/* An object's material; Assimp gives Phong's terms. */
static void set_material(Walk *walk, const struct aiMaterial *from, Object *object)
{
    Material *to = &object->front;
    Vec3 black = {0, 0, 0};
    int two_sided = 0;
    *to = (Material){.diffuse = {0.8, 0.8, 0.8}, .alpha = 1};
    if (!from)
        return;
    const Vec3 mean = texture_color(walk, from);
    color_of(from, "$clr.diffuse", &to->diffuse);
    if (!color_of(from, "$clr.ambient", &to->ambient) || color_is_black(to->ambient))
        to->ambient = to->diffuse;
    to->ambient = color_product(to->ambient, mean);
    to->diffuse = color_product(to->diffuse, mean);
    color_of(from, "$clr.emissive", &to->emission);
    to->shininess = fmin(fmax(number_of(from, "$mat.shininess", 0), 0), 128);
    if (color_of(from, "$clr.specular", &to->specular))
        to->specular =
            color_within_one(vec3_scale(to->specular, number_of(from, "$mat.shinpercent", 1)));
    if (to->shininess == 0) /* no exponent: no highlight */
        to->specular = black;
    to->alpha = fmin(fmax(number_of(from, "$mat.opacity", 1), 0), 1);
    aiGetMaterialIntegerArray(from, "$mat.twosided", 0, 0, &two_sided, NULL);
    object->two_sided = two_sided != 0;
    object->back = *to;
}

/* All materials, and after them that of meshes without one. */
static void make_materials(Walk *walk)
{
    const unsigned count = walk->scene->mNumMaterials;
    walk->materials = memory_new((size_t)count + 1, sizeof *walk->materials);
    for (unsigned i = 0; i <= count; i++)
        set_material(walk, i < count ? walk->scene->mMaterials[i] : NULL, &walk->materials[i]);
}

static unsigned material_number(const Walk *walk, const struct aiMesh *part)
{
    const unsigned count = walk->scene->mNumMaterials;
    return part->mMaterialIndex < count ? part->mMaterialIndex : count;
}

static const Object *material_of(const Walk *walk, const struct aiMesh *part)
{
    return &walk->materials[material_number(walk, part)];
}

/* Each mesh once, with triangles or without. */
static bool add_meshes(Walk *walk)
{
    size_t vertices = 0, indices = 0;
    for (unsigned i = 0; i < walk->scene->mNumMeshes; i++) {
        vertices += walk->scene->mMeshes[i]->mNumVertices;
        indices += 3 * (size_t)walk->scene->mMeshes[i]->mNumFaces;
    }
    if (!scene_file_fits(vertices, indices, walk->reason))
        return false;
    for (unsigned i = 0; i < walk->scene->mNumMeshes; i++) {
        const struct aiMesh *part = walk->scene->mMeshes[i];
        Mesh *mesh = scene_file_add(walk->file, FILE_MESHES, walk->reason);
        if (!mesh || !fill_mesh(part, material_of(walk, part)->front.diffuse, mesh, walk->reason))
            return false;
    }
    return true;
}

/* Lights, cameras, animations */

/* Light of an FBX file is at its full strength where its decay starts, at a distance s, and beyond
 * as s / d or its square; of which Assimp makes 2 d / s, or its square in half, and of light
 * without decay s. 1 + d / s and 1 + (d / s)^2 are right near by and far away. */
static void set_decay(Light *light)
{
    light->constant = 1;
    light->linear /= 2;
    light->quadratic /= 2;
}

static bool add_light(Walk *walk, const struct aiLight *from, int node)
{
    static const double DEGREES = 57.29577951308232;
    const Vec3 diffuse = {from->mColorDiffuse.r, from->mColorDiffuse.g, from->mColorDiffuse.b};
    if (from->mType == aiLightSource_AMBIENT) {
        const Vec3 ambient = {from->mColorAmbient.r, from->mColorAmbient.g, from->mColorAmbient.b};
        Vec3 *sum = &walk->file->scene.global_ambient;
        *sum = vec3_add(*sum, color_is_black(ambient) ? diffuse : ambient);
        return true;
    }
    FileLight *to = scene_file_add(walk->file, FILE_LIGHTS, walk->reason);
    if (!to)
        return false;
    set_name(to->name, from->mName.data);
    to->node = node;
    to->light = (Light){
        .kind = from->mType == aiLightSource_DIRECTIONAL ? LIGHT_DIRECTIONAL
                : from->mType == aiLightSource_SPOT      ? LIGHT_SPOT
                                                         : LIGHT_POINT,
        .position = vector(&from->mPosition),
        .direction = vector(&from->mDirection),
        .diffuse = diffuse,
        .specular = {from->mColorSpecular.r, from->mColorSpecular.g, from->mColorSpecular.b},
        .constant = from->mAttenuationConstant,
        .linear = from->mAttenuationLinear / walk->scale,
        .quadratic = from->mAttenuationQuadratic / (walk->scale * walk->scale)};
    if (importer_is(walk->scene, "FBX"))
        set_decay(&to->light);
    /* Or it is amplified near by. */
    walk->file->photometric |= fmax(fmax(diffuse.x, diffuse.y), diffuse.z) > 1 ||
                               (to->light.constant < 1 && light_fades(&to->light));
    scene_file_note(walk->file, from->mType == aiLightSource_AREA, NOTE_AREA);
    if (color_is_black(to->light.specular))
        to->light.specular = diffuse;
    if (to->light.kind == LIGHT_DIRECTIONAL)
        to->light.direction = vec3_scale(to->light.direction, -1);
    if (to->light.kind == LIGHT_SPOT) { /* whole angles */
        to->light.cutoff = fmin(from->mAngleOuterCone / 2 * DEGREES, 90);
        to->light.exponent =
            scene_file_spot_exponent(from->mAngleInnerCone / 2, from->mAngleOuterCone / 2);
    }
    return true;
}

static bool add_camera(Walk *walk, const struct aiCamera *from, int node)
{
    static const double DEGREES = 57.29577951308232;
    FileCamera *to = scene_file_add(walk->file, FILE_CAMERAS, walk->reason);
    if (!to)
        return false;
    const double aspect = from->mAspect > 0 ? from->mAspect : 1;
    const double fovy = 2 * DEGREES * atan(tan(from->mHorizontalFOV / 2) / aspect);
    set_name(to->name, from->mName.data); /* and its node's */
    to->node = node;
    to->camera = (Camera){.eye = vector(&from->mPosition),
                          .center = vec3_add(vector(&from->mPosition), vector(&from->mLookAt)),
                          .up = vector(&from->mUp),
                          .fovy = fovy > 1e-3 && fovy < 179 ? fovy : 45,
                          .near = from->mClipPlaneNear * walk->scale,
                          .far = from->mClipPlaneFar * walk->scale};
    return true;
}

/* A channel of so many keys, whose numbers are to be filled in; NULL: it has none, or no room. */
static float *add_channel(Walk *walk, int node, FilePath path, unsigned count)
{
    const FileChannel made = {
        .node = node, .path = (int)path, .step = FILE_LINEAR, .count = (int)count};
    return count == 0 ? NULL
                      : scene_file_add_channel(walk->file, made,
                                               (path == FILE_ROTATION ? 4 : 3) * (size_t)count,
                                               walk->reason);
}

static void add_vectors(Walk *walk, int node, FilePath path, const struct aiVectorKey *keys,
                        unsigned count, double rate)
{
    float *times = add_channel(walk, node, path, count);
    for (unsigned i = 0; times && i < count; i++) {
        times[i] = (float)(keys[i].mTime / rate);
        vec3_to_float(vector(&keys[i].mValue), times + count + 3 * i);
    }
}

/* What the first animation does with a node. */
static bool add_motion(Walk *walk, const struct aiNode *node, int number)
{
    const struct aiAnimation *all =
        walk->scene->mNumAnimations ? walk->scene->mAnimations[0] : NULL;
    for (unsigned i = 0; all && i < all->mNumChannels; i++) {
        const struct aiNodeAnim *moves = all->mChannels[i];
        const double rate = all->mTicksPerSecond > 0 ? all->mTicksPerSecond : 25;
        FileNode *to = &walk->file->nodes[number];
        struct aiVector3D scale, place;
        struct aiQuaternion turn;
        if (strcmp(moves->mNodeName.data, node->mName.data) != 0 || node == walk->scene->mRootNode)
            continue;
        aiDecomposeMatrix(&node->mTransformation, &scale, &turn, &place);
        to->translation = vector(&place);
        to->scale = vector(&scale);
        to->rotation = (Vec4){turn.x, turn.y, turn.z, turn.w};
        add_vectors(walk, number, FILE_TRANSLATION, moves->mPositionKeys, moves->mNumPositionKeys,
                    rate);
        add_vectors(walk, number, FILE_SCALE, moves->mScalingKeys, moves->mNumScalingKeys, rate);
        const unsigned count = moves->mNumRotationKeys;
        float *times = add_channel(walk, number, FILE_ROTATION, count);
        for (unsigned k = 0; times && k < count; k++) {
            const struct aiQuaternion *q = &moves->mRotationKeys[k].mValue;
            const float values[4] = {q->x, q->y, q->z, q->w};
            times[k] = (float)(moves->mRotationKeys[k].mTime / rate);
            memcpy(times + count + 4 * k, values, sizeof values);
        }
        break;
    }
    return !walk->reason->text[0];
}

/* Nodes */

static bool add_object(Walk *walk, const struct aiNode *node, int number, unsigned index)
{
    const struct aiMesh *part = walk->scene->mMeshes[index];
    const unsigned material = material_number(walk, part);
    if (walk->file->meshes[index].index_count == 0) {
        scene_file_note(walk->file, true, NOTE_LINES);
        return true;
    }
    FileObject *object = scene_file_add(walk->file, FILE_OBJECTS, walk->reason);
    if (!object)
        return false;
    object->node = number;
    object->mesh = (int)index;
    set_name(object->name, node->mName.data);
    object->object = walk->materials[material];
    if (material < walk->scene->mNumMaterials)
        note_material(walk->file, walk->scene->mMaterials[material], object->object.front.alpha);
    scene_file_note(walk->file, part->mNumBones, NOTE_SKIN);
    scene_file_note(walk->file, part->mNumAnimMeshes, NOTE_MORPH);
    return true;
}

/* The lights and the cameras that the node's name places. */
static bool add_named(Walk *walk, const struct aiNode *node, int number)
{
    for (unsigned i = 0; i < walk->scene->mNumLights; i++)
        if (strcmp(walk->scene->mLights[i]->mName.data, node->mName.data) == 0 &&
            !add_light(walk, walk->scene->mLights[i], number))
            return false;
    for (unsigned i = 0; i < walk->scene->mNumCameras; i++)
        if (strcmp(walk->scene->mCameras[i]->mName.data, node->mName.data) == 0 &&
            !add_camera(walk, walk->scene->mCameras[i], number))
            return false;
    return true;
}

static bool visit(Walk *walk, const struct aiNode *node, int parent, const Mat4 *world_from_file)
{
    FileNode *added = scene_file_add(walk->file, FILE_NODES, walk->reason);
    if (!added)
        return false;
    const int number = walk->file->node_count - 1;
    const Mat4 own = matrix(&node->mTransformation);
    added->parent = parent;
    added->parent_from_node = world_from_file ? mat4_product(*world_from_file, own) : own;
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (!add_object(walk, node, number, node->mMeshes[i]))
            return false;
    if (node->mName.length > 0 &&
        (!add_named(walk, node, number) || !add_motion(walk, node, number)))
        return false;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!visit(walk, node->mChildren[i], number, NULL))
            return false;
    return true;
}

static bool collect(const struct aiScene *scene, ModelUp up, const Folder *folder, SceneFile *file,
                    Message *reason)
{
    const Mat4 world_from_file = stand_up(scene, up);
    Walk walk = {.scene = scene, .file = file, .folder = folder, .reason = reason};
    if (importer_is(scene, "FBX"))
        aiIdentityMatrix4(&scene->mRootNode->mTransformation);
    walk.scale = cbrt(fabs(mat4_determinant(matrix(&scene->mRootNode->mTransformation))));
    walk.scale = walk.scale > 0 ? walk.scale : 1;
    for (unsigned i = 1; i < scene->mNumAnimations; i++)
        scene_file_note(file, true, NOTE_ANIMATION);
    make_materials(&walk);
    const bool done = add_meshes(&walk) && visit(&walk, scene->mRootNode, -1, &world_from_file);
    free(walk.materials);
    return done;
}

static bool assimp_read(const char *path, ModelUp up, SceneFile *file, Message *reason)
{
    const char *slash = strrchr(path, '/');
    Folder folder = {.path = path, .length = slash ? (size_t)(slash + 1 - path) : 0};
    struct aiFileIO io = assimp_files(&folder);
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    /* By default Assimp makes meshes for files of bones alone. */
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION,
                               up != MODEL_UP_FILE);
    const struct aiScene *scene = aiImportFileExWithProperties(
        path, aiProcess_Triangulate | aiProcess_ValidateDataStructure, &io, properties);
    aiReleasePropertyStore(properties);
    if (!scene && folder.refused[0])
        return message_set(reason, "it needs %s, which is outside its folder", folder.refused);
    if (!scene)
        return message_set(reason, "%s", aiGetErrorString());
    scene_file_note(file, folder.refused[0], NOTE_OUTSIDE);
    const bool collected = collect(scene, up, &folder, file, reason);
    aiReleaseImport(scene);
    return collected;
}

static bool read_file(const char *path, ModelUp up, SceneFile *file, Message *reason)
{
    bool other;
    const bool read = own_read(path, file, &other, reason);
    return other ? assimp_read(path, up, file, reason) : read;
}

static const char *version(void)
{
    static char text[32];
    snprintf(text, sizeof text, "%u.%u.%u", aiGetVersionMajor(), aiGetVersionMinor(),
             aiGetVersionPatch());
    return text;
}

__attribute__((visibility("default"))) const ModelModule model_module = {version, read_file};
