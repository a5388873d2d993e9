/*
 * Meshes from formulas, and meshes from meshes. A grid of rows and columns of vertices covers every
 * shape that is swept: each of its quads becomes two triangles, except at a pole, where one of them
 * would have no area. For flat shading every triangle gets vertices of its own.
 */
#include "core/mesh_make.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

bool mesh_open(Mesh *mesh, size_t vertex_count, size_t index_count, Message *message)
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

/* Opens an array of one vector per vertex. */
static bool open_vectors(float (**vectors)[3], const Mesh *mesh, Message *message)
{
    if (!*vectors)
        *vectors = calloc(mesh->vertex_count + 1, sizeof **vectors);
    return *vectors ||
           message_set(message, "mesh: not enough memory for %zu vertices", mesh->vertex_count);
}

bool mesh_open_colors(Mesh *mesh, Message *message)
{
    return open_vectors(&mesh->colors, mesh, message);
}

bool mesh_copy(Mesh *copy, const Mesh *mesh, Message *message)
{
    const size_t size = mesh->vertex_count * sizeof *mesh->colors;
    if (!mesh_open(copy, mesh->vertex_count, mesh->index_count, message))
        return false;
    if ((mesh->colors && !open_vectors(&copy->colors, copy, message)) ||
        (mesh->lit_positions && !open_vectors(&copy->lit_positions, copy, message))) {
        mesh_close(copy);
        return false;
    }
    memcpy(copy->vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    memcpy(copy->indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    if (mesh->colors)
        memcpy(copy->colors, mesh->colors, size);
    if (mesh->lit_positions)
        memcpy(copy->lit_positions, mesh->lit_positions, size);
    return true;
}

/* As numbers: zero has two signs. */
static bool are_equal(const MeshVertex *a, const MeshVertex *b, bool normals)
{
    bool equal = true;
    for (int k = 0; k < 3; k++)
        equal &= a->position[k] == b->position[k] && (!normals || a->normal[k] == b->normal[k]);
    return equal;
}

uint64_t mesh_hash(const MeshVertex *vertex, bool normals)
{
    Random hash = {0};
    const int count = normals ? 6 : 3;
    for (int k = 0; k < count; k++) {
        const float value = (k < 3 ? vertex->position[k] : vertex->normal[k - 3]) + 0.0F;
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash.state ^= (uint64_t)bits << 32 * (k % 2);
        if (k % 2 == 1 || k == count - 1)
            hash.state = random_bits(&hash);
    }
    return hash.state;
}

/* A hash table with open addressing (Knuth, The art of computer programming, volume 3, section 6.4,
 * algorithm L). */
bool mesh_weld(const Mesh *mesh, bool normals, uint32_t *first)
{
    enum { AHEAD = 8 };
    size_t mask = 15;
    while (mask < 2 * mesh->vertex_count)
        mask = 2 * mask + 1;
    uint32_t *slots = calloc(mask + 1, sizeof *slots); /* a number plus 1; 0: free */
    for (size_t i = 0; i < mesh->vertex_count; i++)
        first[i] = (uint32_t)(mesh_hash(&mesh->vertices[i], normals) & mask);
    for (size_t i = 0; slots && i < mesh->vertex_count; i++) {
        const MeshVertex *vertex = &mesh->vertices[i];
        size_t slot = first[i];
        if (i + 2 * AHEAD < mesh->vertex_count) { /* what is looked up soon is on its way */
            const uint32_t near = slots[first[i + AHEAD]];
            __builtin_prefetch(&slots[first[i + 2 * AHEAD]]);
            __builtin_prefetch(&mesh->vertices[near ? near - 1 : 0]);
        }
        while (slots[slot] && !are_equal(vertex, &mesh->vertices[slots[slot] - 1], normals))
            slot = (slot + 1) & mask;
        if (!slots[slot])
            slots[slot] = (uint32_t)i + 1;
        first[i] = slots[slot] - 1;
    }
    const bool done = slots != NULL;
    free(slots);
    return done;
}

bool mesh_check_length(const char *shape, const char *what, double length, Message *message)
{
    return ((float)length > 0 && !isinf((float)length)) ||
           message_set(message, "%s: %s %g: must be more than 0 and finite", shape, what, length);
}

bool mesh_check_count(const char *shape, const char *what, int count, int min, int max,
                      Message *message)
{
    return (count >= min && count <= max) ||
           message_set(message, "%s: %d %s: must be %d to %d", shape, count, what, min, max);
}

size_t mesh_grid_size(int rows, int columns, MeshPoles poles)
{
    const size_t full = 6 * (size_t)rows * (size_t)columns, row = 3 * (size_t)columns;
    return full - (poles & MESH_POLE_FIRST ? row : 0) - (poles & MESH_POLE_LAST ? row : 0);
}

/* Each quad gives the triangles (p1, p2, p1 + 1) and (p1 + 1, p2, p2 + 1), where p2 is the vertex
 * below p1. */
uint32_t *mesh_grid(uint32_t *indices, uint32_t first, int rows, int columns, MeshPoles poles)
{
    const uint32_t row = (uint32_t)columns + 1;
    for (uint32_t j = 0; j < (uint32_t)rows; j++)
        for (uint32_t i = 0; i < (uint32_t)columns; i++) {
            const uint32_t p1 = first + j * row + i, p2 = p1 + row;
            if (!(poles & MESH_POLE_FIRST) || j > 0) {
                *indices++ = p1;
                *indices++ = p2;
                *indices++ = p1 + 1;
            }
            if (!(poles & MESH_POLE_LAST) || j + 1 < (uint32_t)rows) {
                *indices++ = p1 + 1;
                *indices++ = p2;
                *indices++ = p2 + 1;
            }
        }
    return indices;
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
    if (!mesh_check_length("cube", "half side", half_side, message) ||
        !mesh_open(mesh, 24, 36, message))
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
        /* + 0.0 turns -0 into 0: equal vertices are equal bit for bit. */
        vertex->position[axis] = (float)(radius * normal[axis] + 0.0);
        vertex->normal[axis] = (float)(normal[axis] + 0.0);
    }
}

bool mesh_sphere(Mesh *mesh, double radius, int slices, int stacks, Message *message)
{
    *mesh = (Mesh){0};
    if (!mesh_check_length("sphere", "radius", radius, message) ||
        !mesh_check_count("sphere", "slices", slices, 3, MESH_SPHERE_MAX, message) ||
        !mesh_check_count("sphere", "stacks", stacks, 2, MESH_SPHERE_MAX, message))
        return false;
    const size_t row = (size_t)slices + 1;
    if (!mesh_open(mesh, row * ((size_t)stacks + 1), mesh_grid_size(stacks, slices, MESH_POLE_BOTH),
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
    mesh_grid(mesh->indices, 0, stacks, slices, MESH_POLE_BOTH);
    return true;
}

bool mesh_sphere_lecture(Mesh *mesh, int divisions, Message *message)
{
    *mesh = (Mesh){0};
    const size_t row = (size_t)divisions + 1;
    if (!mesh_check_count("sphere", "divisions", divisions, 3, MESH_SPHERE_MAX, message) ||
        !mesh_open(mesh, row * row, mesh_grid_size(divisions, divisions, MESH_POLE_NONE), message))
        return false;
    for (int j = 0; j <= divisions; j++) {
        const double b = PI * j / divisions;
        for (int i = 0; i <= divisions; i++) {
            const double a = 2 * PI * i / divisions;
            sphere_vertex(&mesh->vertices[(size_t)j * row + (size_t)i], 1, sin(a), cos(a), sin(b),
                          cos(b));
        }
    }
    mesh_grid(mesh->indices, 0, divisions, divisions, MESH_POLE_NONE);
    return true;
}

/* Opens a mesh with three vertices for each triangle of `mesh`, which mesh_check accepts. Looks at
 * the triangles only if there is memory for them. */
static bool open_separate(Mesh *separate, const Mesh *mesh, Message *message)
{
    if (!mesh_open(separate, mesh->index_count, mesh->index_count, message))
        return false;
    if (mesh_check(mesh, message) && (!mesh->colors || mesh_open_colors(separate, message)))
        return true;
    mesh_close(separate);
    return false;
}

/* Copies vertex `from` of `mesh` to the end of `separate`. */
static MeshVertex *add_separate(Mesh *separate, uint32_t count, const Mesh *mesh, uint32_t from)
{
    separate->vertices[count] = mesh->vertices[from];
    if (mesh->colors)
        memcpy(separate->colors[count], mesh->colors[from], sizeof mesh->colors[from]);
    separate->indices[count] = count;
    return &separate->vertices[count];
}

bool mesh_flatten(Mesh *mesh, Message *message)
{
    Mesh flat;
    if (!open_separate(&flat, mesh, message))
        return false;
    uint32_t count = 0;
    for (size_t triangle = 0; triangle < mesh->index_count / 3; triangle++) {
        Vec3 normal;
        if (!mesh_face(mesh, triangle, &normal))
            continue;
        for (size_t i = 0; i < 3; i++, count++)
            vec3_to_float(
                normal, add_separate(&flat, count, mesh, mesh->indices[3 * triangle + i])->normal);
    }
    flat.vertex_count = flat.index_count = count;
    mesh_close(mesh);
    *mesh = flat;
    return true;
}

bool mesh_provoke(Mesh *mesh, Message *message)
{
    Mesh made;
    if (!open_separate(&made, mesh, message))
        return false;
    if (!open_vectors(&made.lit_positions, &made, message)) {
        mesh_close(&made);
        return false;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const uint32_t last = mesh->indices[i - i % 3 + 2];
        MeshVertex *vertex = add_separate(&made, i, mesh, last);
        memcpy(made.lit_positions[i], vertex->position, sizeof vertex->position);
        memcpy(vertex->position, mesh->vertices[mesh->indices[i]].position,
               sizeof vertex->position);
    }
    mesh_close(mesh);
    *mesh = made;
    return true;
}
