/*
 * gltf: what the two files that read glTF 2.0 share, for them alone.
 */
#ifndef GLTF_H
#define GLTF_H

#include "base/message.h"
#include "scene/model_module.h"
#include "scene/scene_fields.h"

#include <jansson.h>
#include <stddef.h>

/* The JSON and the numbers of a glTF 2.0 file. */

typedef struct Gltf {
    json_t *root;
    char *file;      /* its bytes */
    const char *bin; /* the binary chunk of a .glb in it */
    size_t bin_size;
    char **buffers; /* read so far */
    size_t *sizes, total;
    int folder;      /* of the file */
    Message *reason; /* set: it failed */
} Gltf;

/* `*other`, and false: it is not glTF 2.0. */
bool gltf_open(Gltf *gltf, const char *path, bool *other, Message *reason);
void gltf_close(Gltf *gltf);

/* An item of one of the root's lists; NULL, with the reason: there is none. */
json_t *gltf_item(const Gltf *gltf, const char *list, json_int_t index);

/* The bytes of a texture's image, to be freed. NULL, with why: they cannot be read. */
char *gltf_texture(Gltf *gltf, json_int_t index, size_t *size, Message *why);

/* Members of an object, which may be NULL. A value of another type is as none. */
json_int_t gltf_whole(const json_t *object, const char *key, json_int_t usual);
double gltf_number(const json_t *object, const char *key, double usual);
/* Whether there are `count` numbers. */
bool gltf_numbers(const json_t *object, const char *key, int count, double *numbers);
json_t *gltf_extension(const json_t *object, const char *name);

/* All numbers of an accessor, to be freed; `count` elements of `size` numbers each. NULL, with the
 * reason: they cannot be read. */
double *gltf_accessor(Gltf *gltf, json_int_t index, size_t *count, int *size);

/* A file that is read: which node and mesh of the SceneFile are the file's. */
typedef struct Reading {
    Gltf gltf;
    SceneFile *file;
    int *nodes;   /* by the file's number; -1: not reached */
    int **meshes; /* by the file's number and primitive; -1: not read yet, -2: no triangles */
    Vec3 *means;  /* by the texture's number; below 0: not read yet */
    size_t vertices, indices;
} Reading;

bool gltf_failed(const Reading *reading);

Vec3 gltf_vector(const json_t *object, const char *key, Vec3 usual);

/* What our own files have besides; NULL: nothing. */
const json_t *gltf_own(const json_t *object);
void gltf_fields(const json_t *object, const Field *fields, void *to);

void gltf_name(char name[FILE_NAME], const json_t *object);

/* Adds the objects of a node's mesh, one for each primitive. */
bool gltf_add_objects(Reading *reading, const json_t *node, int number);

#endif
