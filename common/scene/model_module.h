/*
 * model_module: the plugin that reads files of scenes, as scene_file.c calls it.
 */
#ifndef MODEL_MODULE_H
#define MODEL_MODULE_H

#include "base/plugin.h"
#include "scene/scene_file.h"

/* The variable `model_module`. */
typedef struct ModelModule {
    PluginVersion *version;
    /* Reads a file, unchecked: numbers may be infinite or NaN; missing normals are zero. On failure
     * sets the reason, without a subject. */
    bool (*read)(const char *path, ModelUp up, SceneFile *file, Message *reason);
} ModelModule;

/* Our own readers, of glTF 2.0, OBJ and PLY. `*other`: it is of another format. */
bool own_read(const char *path, SceneFile *file, bool *other, Message *reason);

/* glTF 2.0. `*other`, and true: it is not of this format. */
bool gltf_read(const char *path, SceneFile *file, bool *other, Message *reason);

/* PLY, from its bytes and a zero byte after them; `folder` is the open one of the file. */
bool ply_read(const char *bytes, size_t size, int folder, SceneFile *file, Message *reason);

/* The mean colour of a texture that it names: scene/texture_mean.h. */
Vec3 own_mean(SceneFile *file, int folder, const char *path);

#endif
