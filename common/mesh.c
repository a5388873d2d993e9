#include "mesh.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

static bool mesh_allocate(Mesh *mesh, size_t vertex_count, size_t index_count, Message *message)
{
    *mesh = (Mesh){0};
    mesh->vertices = calloc(vertex_count, sizeof *mesh->vertices);
    mesh->indices = calloc(index_count, sizeof *mesh->indices);
    if (!mesh->vertices || !mesh->indices) {
        mesh_close(mesh);
        return message_set(message, "mesh: not enough memory for %zu vertices and %zu indices",
                           vertex_count, index_count);
    }
    mesh->vertex_count = vertex_count;
    mesh->index_count = index_count;
    return true;
}

void mesh_close(Mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (Mesh){0};
}

bool mesh_cube(Mesh *mesh, double half_side, Message *message)
{
    /* The corners of each face by their signs, counter-clockwise from outside. */
    static const signed char corners[6][4][3] = {
        {{1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}},     /* front */
        {{1, 1, 1}, {1, -1, 1}, {1, -1, -1}, {1, 1, -1}},     /* right */
        {{1, 1, 1}, {1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}},     /* up */
        {{-1, 1, 1}, {-1, 1, -1}, {-1, -1, -1}, {-1, -1, 1}}, /* left */
        {{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}}, /* down */
        {{1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}}, /* back */
    };
    static const signed char normals[6][3] = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                              {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    static const unsigned char split[6] = {0, 1, 2, 0, 2, 3};

    *mesh = (Mesh){0};
    const float half = (float)half_side;
    if (!(half > 0) || isinf(half))
        return message_set(message, "cube: half side %g: must be more than 0 and finite",
                           half_side);
    if (!mesh_allocate(mesh, 24, 36, message))
        return false;
    for (unsigned face = 0; face < 6; face++) {
        for (unsigned corner = 0; corner < 4; corner++) {
            MeshVertex *vertex = &mesh->vertices[4 * face + corner];
            for (int axis = 0; axis < 3; axis++) {
                vertex->position[axis] = half * (float)corners[face][corner][axis];
                vertex->normal[axis] = (float)normals[face][axis];
            }
        }
        for (unsigned i = 0; i < 6; i++)
            mesh->indices[6 * face + i] = 4 * face + split[i];
    }
    return true;
}

static void sphere_vertex(MeshVertex *vertex, double radius, double sin_a, double cos_a,
                          double sin_b, double cos_b)
{
    const double normal[3] = {sin_a * sin_b, cos_b, cos_a * sin_b};
    for (int axis = 0; axis < 3; axis++) {
        /* + 0.0 turns -0 into 0, so that equal vertices are equal bit for bit. */
        vertex->position[axis] = (float)(radius * normal[axis] + 0.0);
        vertex->normal[axis] = (float)(normal[axis] + 0.0);
    }
}

/* Vertex (i, j) stands at j * (slices + 1) + i. Each quad gives the triangles (p1, p2, p1 + 1) and
 * (p1 + 1, p2, p2 + 1), where p2 is the vertex below p1. */
static size_t sphere_indices(uint32_t *indices, int slices, int stacks, bool with_poles)
{
    size_t count = 0;
    const uint32_t row = (uint32_t)slices + 1;
    for (uint32_t j = 0; j < (uint32_t)stacks; j++) {
        for (uint32_t i = 0; i < (uint32_t)slices; i++) {
            const uint32_t p1 = j * row + i, p2 = p1 + row;
            if (with_poles || j > 0) {
                indices[count++] = p1;
                indices[count++] = p2;
                indices[count++] = p1 + 1;
            }
            if (with_poles || j + 1 < (uint32_t)stacks) {
                indices[count++] = p1 + 1;
                indices[count++] = p2;
                indices[count++] = p2 + 1;
            }
        }
    }
    return count;
}

bool mesh_sphere(Mesh *mesh, double radius, int slices, int stacks, Message *message)
{
    *mesh = (Mesh){0};
    if (!((float)radius > 0) || isinf((float)radius))
        return message_set(message, "sphere: radius %g: must be more than 0 and finite", radius);
    if (slices < 3 || slices > MESH_SPHERE_MOST)
        return message_set(message, "sphere: %d slices: must be 3 to %d", slices, MESH_SPHERE_MOST);
    if (stacks < 2 || stacks > MESH_SPHERE_MOST)
        return message_set(message, "sphere: %d stacks: must be 2 to %d", stacks, MESH_SPHERE_MOST);

    const size_t row = (size_t)slices + 1;
    if (!mesh_allocate(mesh, row * ((size_t)stacks + 1), 6 * (size_t)slices * ((size_t)stacks - 1),
                       message))
        return false;
    for (int j = 0; j <= stacks; j++) {
        const bool pole = j == 0 || j == stacks;
        const double b = PI * j / stacks;
        const double sin_b = pole ? 0 : sin(b), cos_b = pole ? (j == 0 ? 1 : -1) : cos(b);
        for (int i = 0; i < slices; i++) {
            const double a = 2 * PI * i / slices;
            sphere_vertex(&mesh->vertices[(size_t)j * row + (size_t)i], radius, sin(a), cos(a),
                          sin_b, cos_b);
        }
        mesh->vertices[(size_t)j * row + (size_t)slices] = mesh->vertices[(size_t)j * row];
    }
    sphere_indices(mesh->indices, slices, stacks, false);
    return true;
}

bool mesh_sphere_lecture(Mesh *mesh, int divisions, Message *message)
{
    *mesh = (Mesh){0};
    if (divisions < 3 || divisions > MESH_SPHERE_MOST)
        return message_set(message, "sphere: %d divisions: must be 3 to %d", divisions,
                           MESH_SPHERE_MOST);
    const size_t row = (size_t)divisions + 1;
    if (!mesh_allocate(mesh, row * row, 6 * (size_t)divisions * (size_t)divisions, message))
        return false;
    for (int j = 0; j <= divisions; j++) {
        const double b = PI * j / divisions;
        for (int i = 0; i <= divisions; i++) {
            const double a = 2 * PI * i / divisions;
            sphere_vertex(&mesh->vertices[(size_t)j * row + (size_t)i], 1, sin(a), cos(a), sin(b),
                          cos(b));
        }
    }
    sphere_indices(mesh->indices, divisions, divisions, true);
    return true;
}
