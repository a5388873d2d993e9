/*
 * mesh_buffer: a mesh in buffer objects of the current context.
 */
#ifndef MESH_BUFFER_H
#define MESH_BUFFER_H

#include "core/gl.h"
#include "core/mesh.h"

typedef struct MeshBuffer {
    GLuint vertices, indices;     /* buffer objects */
    GLuint colors, lit_positions; /* as in the mesh; 0: none */
    GLsizei index_count;
    GLenum index_type; /* GL_UNSIGNED_SHORT, or GL_UNSIGNED_INT for over 65536 vertices */
} MeshBuffer;

/* Uploads a mesh, which may be closed afterwards; normals are normalized, zero ones stay. False if
 * mesh_check fails, if the driver cannot index so many vertices (65536 without
 * GL_OES_element_index_uint) or memory runs out. */
bool mesh_buffer_open(MeshBuffer *buffer, const Mesh *mesh, Message *message);

/* Binds the buffers and the attributes of position and normal (-1: none) alone. Draw with
 * glDrawElements(GL_TRIANGLES, buffer->index_count, buffer->index_type, NULL). */
void mesh_buffer_bind(const MeshBuffer *buffer, GLint position, GLint normal);

/* Binds the attributes that a mesh may have besides; -1, or none in the mesh, skips one. */
void mesh_buffer_bind_more(const MeshBuffer *buffer, GLint color, GLint lit_position);

/* NULL or zeroed is fine. */
void mesh_buffer_close(MeshBuffer *buffer);

#endif
