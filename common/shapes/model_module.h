/*
 * model_module: the plugin that links Assimp (model_assimp.c), as model.c calls it.
 */
#ifndef MODEL_MODULE_H
#define MODEL_MODULE_H

#include "base/plugin.h"
#include "core/mesh.h"

/* Limits. Vertices count before equal ones are merged. */
enum { MODEL_BYTES_MAX = 1 << 30, MODEL_VERTICES_MAX = 10000000, MODEL_TRIANGLES_MAX = 20000000 };

/* The axis of the file that points up. MODEL_UP_FILE: the one that the file names (FBX, COLLADA),
 * or its format's custom: z for STL, 3DS and Blender, y for all others. */
typedef enum ModelUp { MODEL_UP_FILE, MODEL_UP_X, MODEL_UP_Y, MODEL_UP_Z } ModelUp;

/* The variable `model_module`. */
typedef struct ModelModule {
    PluginVersion *version;
    /* Reads all triangles of a file, transformed by its nodes and upright, unchecked: numbers may
     * be infinite or NaN; missing normals are zero. Opens `mesh` by mesh_open. On failure sets the
     * reason, without a subject. */
    bool (*read)(const char *path, ModelUp up, Mesh *mesh, char *reason, size_t reason_size);
} ModelModule;

#endif
