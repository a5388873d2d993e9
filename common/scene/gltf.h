/*
 * gltf: what the two files that read glTF 2.0 share, for them alone.
 */
#ifndef GLTF_H
#define GLTF_H

#include "scene/gltf_data.h"
#include "scene/model_module.h"
#include "scene/scene_fields.h"

/* A file that is read: which node and mesh of the SceneFile are the file's. */
typedef struct Reading {
    Gltf gltf;
    SceneFile *file;
    int *nodes;   /* by the file's number; -1: not reached */
    int **meshes; /* by the file's number and primitive; -1: not read yet, -2: no triangles */
    size_t vertices, indices;
} Reading;

bool gltf_failed(const Reading *reading);

/* Fails. */
bool gltf_too_many(const Reading *reading, const char *what);

Vec3 gltf_vector(const json_t *object, const char *key, Vec3 usual);

/* What our own files have besides; NULL: nothing. */
const json_t *gltf_own(const json_t *object);
void gltf_fields(const json_t *object, const Field *fields, void *to);

void gltf_name(char name[FILE_NAME], const json_t *object);

/* Adds the objects of a node's mesh, one for each primitive. */
bool gltf_add_objects(Reading *reading, const json_t *node, int number);

#endif
