/*
 * model_files: files of models, for tests.
 */
#ifndef MODEL_FILES_H
#define MODEL_FILES_H

#include "base/template.h"
#include "scene/model.h"
#include "support/testing.h"
#include "support/topology.h"

/* The bytes of a file to write. */
typedef struct Bytes {
    unsigned char data[4096];
    size_t size;
} Bytes;

Bytes text(const char *text);
void append(Bytes *bytes, const void *data, size_t size);

/* Of a file in models/; the same, filled with values, which are closed. */
Bytes file(const char *name);
Bytes filled(const char *name, TemplateValues *values);

/* One tetrahedron, corners at the origin and at 1 on each axis, placed by these nodes: with or
 * without normals, which are not normalized. */
Bytes gltf(const char *nodes, const char *attributes);
#define POSITION "\"POSITION\":0"
#define POSITION_AND_NORMAL "\"POSITION\":0,\"NORMAL\":1"

/* model_read of a file with these bytes. */
bool read_bytes(const char *name, const Bytes *bytes, Mesh *mesh, Message *message);

/* What holds for every mesh that was read. */
void assert_sound(const Mesh *mesh);

#endif
