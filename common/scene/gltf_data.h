/*
 * gltf_data: the JSON and the numbers of a glTF 2.0 file.
 */
#ifndef GLTF_DATA_H
#define GLTF_DATA_H

#include "base/message.h"

#include <jansson.h>
#include <stddef.h>

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

/* Members of an object, which may be NULL. A value of another type is as none. */
json_int_t gltf_whole(const json_t *object, const char *key, json_int_t usual);
double gltf_number(const json_t *object, const char *key, double usual);
/* Whether there are `count` numbers. */
bool gltf_numbers(const json_t *object, const char *key, int count, double *numbers);
json_t *gltf_extension(const json_t *object, const char *name);

/* All numbers of an accessor, to be freed; `count` elements of `size` numbers each. NULL, with the
 * reason: they cannot be read. */
double *gltf_accessor(Gltf *gltf, json_int_t index, size_t *count, int *size);

#endif
