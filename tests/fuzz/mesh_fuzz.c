/*
 * mesh_fuzz: no triangles, and no parameters of a shape, may do harm.
 *
 * The first byte says which. Triangles: their vertices' numbers, as the floats that the bytes are,
 * and indices. A solid: its kind, divisions and lengths.
 */
#include "core/mesh_make.h"
#include "fuzz/fuzz.h"
#include "shapes/mesh_solids.h"
#include "shapes/solid.h"

#include <limits.h>
#include <math.h>
#include <string.h>

static bool is_unit(const float v[3])
{
    const double square =
        (double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] + (double)v[2] * (double)v[2];
    return fabs(square - 1) < 1e-5;
}

static bool indices_in_range(const Mesh *mesh)
{
    for (size_t i = 0; i < mesh->index_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return false;
    return mesh->index_count % 3 == 0;
}

static bool all_finite(const Mesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(mesh->vertices[i].position[k]))
                return false;
    return true;
}

static bool zeroed(const Mesh *mesh)
{
    return !mesh->vertices && !mesh->indices && mesh->vertex_count == 0 && mesh->index_count == 0;
}

static bool between(double low, float value, double high)
{
    return low <= (double)value && (double)value <= high;
}

static size_t check_faces(const Mesh *mesh)
{
    size_t with_area = 0;
    for (size_t i = 0; i < mesh->index_count / 3; i++) {
        Vec3 normal;
        const bool area = mesh_face(mesh, i, &normal);
        const double square = vec3_dot(normal, normal);
        require(area ? fabs(square - 1) < 1e-12 : square == 0);
        with_area += area;
    }
    return with_area;
}

static void check_any(const Mesh *mesh)
{
    const bool finite = all_finite(mesh);
    const size_t with_area = check_faces(mesh);
    Mesh other;
    const MeshBox box = mesh_bounds(mesh);
    for (size_t i = 0; i < mesh->vertex_count && finite; i++) {
        const float *p = mesh->vertices[i].position;
        require(between(box.low.x, p[0], box.high.x) && between(box.low.y, p[1], box.high.y) &&
                between(box.low.z, p[2], box.high.z));
    }
    Message message = {0};
    require(mesh_copy(&other, mesh, NULL));
    require(mesh_check(mesh, &message) == finite);
    require(mesh_flatten(&other, NULL) == finite);
    if (finite) {
        require(other.index_count == 3 * with_area && other.vertex_count == other.index_count);
        require(indices_in_range(&other) && check_faces(&other) == with_area);
        for (size_t i = 0; i < other.vertex_count; i++)
            require(is_unit(other.vertices[i].normal));
    } else { /* refused, and as it was */
        require(message.text[0] && other.index_count == mesh->index_count &&
                memcmp(other.vertices, mesh->vertices,
                       mesh->vertex_count * sizeof *mesh->vertices) == 0);
    }
    mesh_close(&other);
    require(mesh_copy(&other, mesh, NULL) && mesh_provoke(&other, NULL) == finite);
    require(!finite || (other.vertex_count == mesh->index_count && other.lit_positions &&
                        indices_in_range(&other)));
    mesh_close(&other);
    for (int weight = MESH_WEIGHT_ANGLE; weight <= MESH_WEIGHT_MAX; weight++) {
        require(mesh_copy(&other, mesh, NULL));
        require(mesh_compute_normals(&other, (MeshWeight)weight, false, NULL));
        for (size_t i = 0; i < other.vertex_count; i++)
            require(is_unit(other.vertices[i].normal) &&
                    memcmp(other.vertices[i].position, mesh->vertices[i].position,
                           sizeof other.vertices[i].position) == 0);
        require(memcmp(other.indices, mesh->indices, mesh->index_count * sizeof *mesh->indices) ==
                0);
        mesh_close(&other);
    }
    mesh_close(&other);
    require(zeroed(&other));
}

/* Twelve bytes for each vertex, and what is left in threes of indices. */
static void try_triangles(const uint8_t *data, size_t size)
{
    enum { MAX = 64 };
    if (size < 1)
        return;
    size_t vertices = 1 + data[0] % 24u;
    data++, size--;
    if (vertices > size / 12)
        vertices = size / 12;
    size_t triangles = (size - 12 * vertices) / 3;
    triangles = triangles < MAX ? triangles : MAX;
    if (vertices == 0)
        return;
    Mesh mesh;
    require(mesh_open(&mesh, vertices, 3 * triangles, NULL));
    for (size_t i = 0; i < vertices; i++)
        memcpy(mesh.vertices[i].position, data + 12 * i, 12);
    for (size_t i = 0; i < 3 * triangles; i++)
        mesh.indices[i] = data[12 * vertices + i] % (uint32_t)vertices;
    check_any(&mesh);
    mesh_close(&mesh);
}

static double taken_double(const uint8_t *data)
{
    double value;
    memcpy(&value, data, sizeof value);
    return value;
}

/* Where triangles have to have an area, by mesh.h; lengths that differ more have no shape left in
 * floats. */
static bool plain(const Solid *solid)
{
    const double lengths[] = {solid->radius, solid->height, solid->tube};
    const int count = solid->kind == SOLID_TORUS ? 3 : 2;
    double min = INFINITY, max = 0;
    for (int i = 0; i < count; i++) {
        if (i == 1 && solid->kind != SOLID_CYLINDER && solid->kind != SOLID_CONE)
            continue;
        min = fmin(min, lengths[i]);
        max = fmax(max, lengths[i]);
    }
    return min >= 1e-30 && max <= 1e38 && max <= 1e3 * min;
}

static void try_solid(const uint8_t *data, size_t size)
{
    uint8_t bytes[28] = {0};
    memcpy(bytes, data, size < sizeof bytes ? size : sizeof bytes);
    const Solid solid = {.kind = (SolidKind)(bytes[0] % 10), /* one too many */
                         .radius = taken_double(bytes + 4),
                         .height = taken_double(bytes + 12),
                         .tube = taken_double(bytes + 20),
                         .caps = (MeshCaps)(bytes[1] % 4)};
    /* Few triangles, but numbers out of range on both sides. */
    static const int odd[] = {-1, INT_MIN, INT_MAX, SOLID_MAX_DIVISIONS + 1};
    const int divisions = bytes[2] < 252 ? bytes[2] % 12 : odd[bytes[2] - 252];
    Mesh mesh;
    Message message = {0};
    if (!solid_mesh(&solid, divisions, &mesh, &message)) {
        require(message.text[0] && zeroed(&mesh));
        return;
    }
    require(!message.text[0] && divisions >= SOLID_MIN_DIVISIONS &&
            divisions <= SOLID_MAX_DIVISIONS && indices_in_range(&mesh));
    for (size_t i = 0; i < mesh.vertex_count; i++)
        require(is_unit(mesh.vertices[i].normal));
    if (plain(&solid)) {
        require(all_finite(&mesh) && 3 * check_faces(&mesh) == mesh.index_count);
        for (size_t i = 0; i < mesh.index_count; i++) {
            const float *n = mesh.vertices[mesh.indices[i]].normal;
            Vec3 face;
            mesh_face(&mesh, i / 3, &face);
            require(solid.kind == SOLID_TEAPOT ||
                    vec3_dot(face, (Vec3){(double)n[0], (double)n[1], (double)n[2]}) > 0);
        }
    }
    check_any(&mesh);
    mesh_close(&mesh);
}

FUZZ(data, size)
{
    if (size > 0 && data[0] % 2)
        try_solid(data + 1, size - 1);
    else if (size > 0)
        try_triangles(data + 1, size - 1);
    return 0;
}
