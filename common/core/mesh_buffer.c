/* Positions and normals interleaved in one buffer, indices of 16 bits where they suffice. */
#include "core/mesh_buffer.h"
#include "core/matrix_vectors.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SHORT_VERTICES = 65536 };

/* 16-bit indices: half the memory, and supported by all drivers. */
static bool upload_short_indices(const Mesh *mesh, Message *message)
{
    GLushort *narrow = malloc(mesh->index_count * sizeof *narrow);
    if (!narrow)
        return message_set(message, "mesh: not enough memory for %zu indices", mesh->index_count);
    for (size_t i = 0; i < mesh->index_count; i++)
        narrow[i] = (GLushort)mesh->indices[i];
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(mesh->index_count * sizeof *narrow), narrow,
                 GL_STATIC_DRAW);
    free(narrow);
    return true;
}

/* Except for rounding. */
static bool is_unit(const float v[3])
{
    const float square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return square > 1 - 4e-6F && square < 1 + 4e-6F;
}

/* A shader cannot normalize lengths whose square leaves the range of a float. */
static void normalize(float v[3])
{
    Vec3 unit;
    if (!is_unit(v) && vec3_normalize(vec3_from_float(v), &unit))
        vec3_to_float(unit, v);
}

static bool upload_vertices(const Mesh *mesh, Message *message)
{
    const size_t size = mesh->vertex_count * sizeof *mesh->vertices;
    MeshVertex *copy = NULL;
    size_t first = 0;
    while (first < mesh->vertex_count && is_unit(mesh->vertices[first].normal))
        first++;
    if (first < mesh->vertex_count) {
        copy = malloc(size);
        if (!copy)
            return message_set(message, "mesh: not enough memory for %zu vertices",
                               mesh->vertex_count);
        memcpy(copy, mesh->vertices, size);
        for (size_t i = first; i < mesh->vertex_count; i++)
            normalize(copy[i].normal);
    }
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, copy ? copy : mesh->vertices, GL_STATIC_DRAW);
    free(copy);
    return true;
}

/* One vector per vertex, if there are any. */
static GLuint upload_vectors(const Mesh *mesh, float (*vectors)[3])
{
    GLuint buffer = 0;
    if (!vectors)
        return 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(mesh->vertex_count * sizeof *vectors), vectors,
                 GL_STATIC_DRAW);
    return buffer;
}

bool mesh_buffer_open(MeshBuffer *buffer, const Mesh *mesh, Message *message)
{
    *buffer = (MeshBuffer){.index_type = GL_UNSIGNED_SHORT};
    if (!mesh_check(mesh, message))
        return false;
    if (mesh->index_count > INT_MAX)
        return message_set(message, "mesh: %zu indices: OpenGL draws at most %d in one call",
                           mesh->index_count, INT_MAX);
    if (mesh->vertex_count > MAX_SHORT_VERTICES) {
        if (gl_version() < 30 && !gl_has("GL_OES_element_index_uint"))
            return message_set(message,
                               "mesh: %zu vertices: this driver indexes at most %d (it lacks "
                               "GL_OES_element_index_uint); use fewer divisions",
                               mesh->vertex_count, MAX_SHORT_VERTICES);
        buffer->index_type = GL_UNSIGNED_INT;
    }
    buffer->index_count = (GLsizei)mesh->index_count;
    glGenBuffers(1, &buffer->vertices);
    glGenBuffers(1, &buffer->indices);
    glBindBuffer(GL_ARRAY_BUFFER, buffer->vertices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer->indices);
    if (!upload_vertices(mesh, message)) {
        mesh_buffer_close(buffer);
        return false;
    }
    if (buffer->index_type == GL_UNSIGNED_INT) {
        glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                     (GLsizeiptr)(mesh->index_count * sizeof *mesh->indices), mesh->indices,
                     GL_STATIC_DRAW);
    } else if (!upload_short_indices(mesh, message)) {
        mesh_buffer_close(buffer);
        return false;
    }
    buffer->colors = upload_vectors(mesh, mesh->colors);
    buffer->lit_positions = upload_vectors(mesh, mesh->lit_positions);
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
        mesh_buffer_close(buffer);
        return message_set(message, "mesh: %zu vertices, %zu indices: %s from the driver",
                           mesh->vertex_count, mesh->index_count, gl_error_name(error));
    }
    return true;
}

static void point_attribute(GLint location, size_t stride, size_t offset)
{
    if (location < 0)
        return;
    glEnableVertexAttribArray((GLuint)location);
    glVertexAttribPointer((GLuint)location, 3, GL_FLOAT, GL_FALSE, (GLsizei)stride,
                          (const void *)offset);
}

void mesh_buffer_bind(const MeshBuffer *buffer, GLint position, GLint normal)
{
    /* One left enabled by another program may point to a buffer that is gone, and WebGL then draws
     * nothing. OpenGL ES 2 has at least 8. */
    enum { ATTRIBUTES = 8 };
    for (GLint i = 0; i < ATTRIBUTES; i++)
        if (i != position && i != normal)
            glDisableVertexAttribArray((GLuint)i);
    glBindBuffer(GL_ARRAY_BUFFER, buffer->vertices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer->indices);
    point_attribute(position, sizeof(MeshVertex), offsetof(MeshVertex, position));
    point_attribute(normal, sizeof(MeshVertex), offsetof(MeshVertex, normal));
}

static void bind_vectors(GLuint vectors, GLint location)
{
    if (!vectors || location < 0)
        return;
    glBindBuffer(GL_ARRAY_BUFFER, vectors);
    point_attribute(location, sizeof(float[3]), 0);
}

void mesh_buffer_bind_more(const MeshBuffer *buffer, GLint color, GLint lit_position)
{
    bind_vectors(buffer->colors, color);
    bind_vectors(buffer->lit_positions, lit_position);
}

void mesh_buffer_close(MeshBuffer *buffer)
{
    if (!buffer)
        return;
    if (buffer->vertices)
        glDeleteBuffers(1, &buffer->vertices);
    if (buffer->indices)
        glDeleteBuffers(1, &buffer->indices);
    if (buffer->colors)
        glDeleteBuffers(1, &buffer->colors);
    if (buffer->lit_positions)
        glDeleteBuffers(1, &buffer->lit_positions);
    *buffer = (MeshBuffer){0};
}
