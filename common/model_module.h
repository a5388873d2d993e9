/*
 * model_module: what model.c asks of the module that links Assimp (model_assimp.c), and how the two
 * agree on it. Only these two files include it.
 */
#ifndef MODEL_MODULE_H
#define MODEL_MODULE_H

#include "mesh.h"

typedef struct ModelModule {
    const char *version;
    /* All triangles of a file, each part where its nodes place it, as the file has them: numbers
     * may be infinite or NaN, missing normals are zero. `mesh` is opened by mesh_open. False, with
     * the reason (without a subject), where it cannot be read. */
    bool (*read)(const char *path, Mesh *mesh, char *reason, size_t reason_size);
} ModelModule;

#define MODEL_MODULE_SYMBOL "model_module"
typedef const ModelModule *(*ModelModuleEntry)(void);

#endif
