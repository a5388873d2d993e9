/*
 * model_module: the interface of the plugin that links Assimp (model_assimp.c) to model.c.
 */
#ifndef MODEL_MODULE_H
#define MODEL_MODULE_H

#include "shapes/model.h"

typedef struct ModelModule {
    const char *version;
    /* Reads all triangles of a file, transformed by its nodes and upright, unchecked: numbers may
     * be infinite or NaN; missing normals are zero. Opens `mesh` by mesh_open. On failure sets the
     * reason, without a subject. */
    bool (*read)(const char *path, ModelUp up, Mesh *mesh, char *reason, size_t reason_size);
} ModelModule;

#define MODEL_MODULE_SYMBOL "model_module"
typedef const ModelModule *(*ModelModuleEntry)(void);

#endif
