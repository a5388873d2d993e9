#include "mesh.h"

#include <math.h>
#include <stdlib.h>

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

void mesh_close(Mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (Mesh){0};
}

bool mesh_check_length(const char *shape, const char *what, double length, Message *message)
{
    if ((float)length > 0 && !isinf((float)length))
        return true;
    return message_set(message, "%s: %s %g: must be more than 0 and finite", shape, what, length);
}

bool mesh_check_count(const char *shape, const char *what, int count, int least, int most,
                      Message *message)
{
    if (count >= least && count <= most)
        return true;
    return message_set(message, "%s: %d %s: must be %d to %d", shape, count, what, least, most);
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
    for (uint32_t j = 0; j < (uint32_t)rows; j++) {
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
        /* + 0.0 turns -0 into 0, so that equal vertices are equal bit for bit. */
        vertex->position[axis] = (float)(radius * normal[axis] + 0.0);
        vertex->normal[axis] = (float)(normal[axis] + 0.0);
    }
}

bool mesh_sphere(Mesh *mesh, double radius, int slices, int stacks, Message *message)
{
    *mesh = (Mesh){0};
    if (!mesh_check_length("sphere", "radius", radius, message) ||
        !mesh_check_count("sphere", "slices", slices, 3, MESH_SPHERE_MOST, message) ||
        !mesh_check_count("sphere", "stacks", stacks, 2, MESH_SPHERE_MOST, message))
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
    if (!mesh_check_count("sphere", "divisions", divisions, 3, MESH_SPHERE_MOST, message) ||
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

/* Any mesh. */

static Vec3 position_of(const Mesh *mesh, uint32_t vertex)
{
    const float *position = mesh->vertices[vertex].position;
    return (Vec3){position[0], position[1], position[2]};
}

void mesh_bounds(const Mesh *mesh, Vec3 *low, Vec3 *high)
{
    *low = *high = (Vec3){0, 0, 0};
    if (mesh->vertex_count > 0)
        *low = *high = position_of(mesh, 0);
    for (size_t i = 1; i < mesh->vertex_count; i++) {
        const Vec3 p = position_of(mesh, (uint32_t)i);
        *low = (Vec3){fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z)};
        *high = (Vec3){fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z)};
    }
}

bool mesh_face(const Mesh *mesh, size_t triangle, Vec3 *normal)
{
    const uint32_t *corner = &mesh->indices[3 * triangle];
    const Vec3 a = position_of(mesh, corner[0]), b = position_of(mesh, corner[1]);
    const Vec3 c = position_of(mesh, corner[2]);
    return vec3_normalize(vec3_cross(vec3_subtract(b, a), vec3_subtract(c, a)), normal);
}

/* 0 times what is finite is 0, times anything else no number. */
static bool finite_vector(const float v[3])
{
    return 0 * v[0] + 0 * v[1] + 0 * v[2] == 0;
}

bool mesh_check(const Mesh *mesh, Message *message)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const MeshVertex *vertex = &mesh->vertices[i];
        const bool placed = finite_vector(vertex->position);
        const float *v = placed ? vertex->normal : vertex->position;
        if (!placed || !finite_vector(vertex->normal))
            return message_set(message, "mesh: vertex %zu: %s (%g, %g, %g): must be finite", i,
                               placed ? "normal" : "position", (double)v[0], (double)v[1],
                               (double)v[2]);
    }
    for (size_t i = 0; i < mesh->index_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return message_set(message, "mesh: triangle %zu: vertex %lu: there are %zu", i / 3,
                               (unsigned long)mesh->indices[i], mesh->vertex_count);
    return true;
}

bool mesh_flatten(Mesh *mesh, Message *message)
{
    Mesh flat;
    if (!mesh_open(&flat, mesh->index_count, mesh->index_count, message))
        return false;
    if (!mesh_check(mesh, message)) {
        mesh_close(&flat);
        return false;
    }
    uint32_t count = 0;
    for (size_t triangle = 0; triangle < mesh->index_count / 3; triangle++) {
        Vec3 normal;
        if (!mesh_face(mesh, triangle, &normal))
            continue;
        for (int i = 0; i < 3; i++, count++) {
            flat.vertices[count] = mesh->vertices[mesh->indices[3 * triangle + (size_t)i]];
            vec3_to_float(normal, flat.vertices[count].normal);
            flat.indices[count] = count;
        }
    }
    flat.vertex_count = flat.index_count = count;
    mesh_close(mesh);
    *mesh = flat;
    return true;
}

static double corner_weight(Vec3 a, Vec3 b, MeshWeight weight)
{
    const double sine = vec3_length(vec3_cross(a, b)); /* these two times |a| |b| */
    const double cosine = vec3_dot(a, b);
    switch (weight) {
    case MESH_WEIGHT_AREA:
        return sine / 2;
    case MESH_WEIGHT_MAX:
        return sine / (vec3_dot(a, a) * vec3_dot(b, b));
    case MESH_WEIGHT_ANGLE:
        break;
    }
    return atan2(sine, cosine);
}

bool mesh_compute_normals(Mesh *mesh, MeshWeight weight, Message *message)
{
    /* A sum as small as this part of its terms is their rounding. */
    static const double CANCELLED = 1e-12;
    typedef struct Sum {
        Vec3 normals;
        double weights;
    } Sum;
    Sum *sums = calloc(mesh->vertex_count + 1, sizeof *sums);
    if (!sums)
        return message_set(message, "mesh: not enough memory for the normals of %zu vertices",
                           mesh->vertex_count);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        vec3_to_float((Vec3){0, 0, 1}, mesh->vertices[i].normal);
    for (size_t triangle = 0; triangle < mesh->index_count / 3; triangle++) {
        const uint32_t *corner = &mesh->indices[3 * triangle];
        Vec3 normal;
        if (!mesh_face(mesh, triangle, &normal))
            continue;
        for (int i = 0; i < 3; i++) {
            const uint32_t vertex = corner[i];
            const Vec3 here = position_of(mesh, vertex);
            const double share =
                corner_weight(vec3_subtract(position_of(mesh, corner[(i + 1) % 3]), here),
                              vec3_subtract(position_of(mesh, corner[(i + 2) % 3]), here), weight);
            if (sums[vertex].weights == 0)
                vec3_to_float(normal, mesh->vertices[vertex].normal);
            sums[vertex].normals = vec3_add(sums[vertex].normals, vec3_scale(normal, share));
            sums[vertex].weights += share;
        }
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 normal;
        if (vec3_length(sums[i].normals) > CANCELLED * sums[i].weights &&
            vec3_normalize(sums[i].normals, &normal))
            vec3_to_float(normal, mesh->vertices[i].normal);
    }
    free(sums);
    return true;
}
