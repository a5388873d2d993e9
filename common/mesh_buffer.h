/*
 * mesh_buffer: a mesh in buffer objects of the current context.
 */
#ifndef MESH_BUFFER_H
#define MESH_BUFFER_H

#include "gl.h"
#include "mesh.h"

typedef struct MeshBuffer {
    GLuint vertices, indices; /* buffer objects */
    GLsizei index_count;
    GLenum index_type; /* GL_UNSIGNED_SHORT, or GL_UNSIGNED_INT for over 65536 vertices */
} MeshBuffer;

/* Uploads a mesh, which may be closed afterwards, with normals of any length made unit; those of no
 * length stay as they are. False where mesh_check is, where the mesh has more vertices than the
 * driver can index (65536 without GL_OES_element_index_uint) or memory runs out. */
bool mesh_buffer_open(MeshBuffer *buffer, const Mesh *mesh, Message *message);

/* Binds the buffers and points the attributes of position and normal at them; an attribute of -1 is
 * left out. Draw with glDrawElements(GL_TRIANGLES, buffer->index_count, buffer->index_type, NULL).
 */
void mesh_buffer_bind(const MeshBuffer *buffer, GLint position, GLint normal);

/* NULL or a zeroed buffer is fine. */
void mesh_buffer_close(MeshBuffer *buffer);

#endif
