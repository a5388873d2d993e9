#include "support/topology.h"

#include "support/testing.h"

#include <float.h>

double topology_distance(Vec3 a, Vec3 b)
{
    return vec3_length(vec3_subtract(a, b));
}

Vec3 topology_position(const Mesh *mesh, size_t vertex)
{
    return vec3_from_float(mesh->vertices[vertex].position);
}

Vec3 topology_normal(const Mesh *mesh, size_t vertex)
{
    return vec3_from_float(mesh->vertices[vertex].normal);
}

Vec3 topology_corner(const Mesh *mesh, size_t index)
{
    return vec3_from_float(mesh->vertices[mesh->indices[index]].position);
}

Vec3 topology_face(const Mesh *mesh, size_t triangle)
{
    const Vec3 a = topology_corner(mesh, 3 * triangle);
    return vec3_cross(vec3_subtract(topology_corner(mesh, 3 * triangle + 1), a),
                      vec3_subtract(topology_corner(mesh, 3 * triangle + 2), a));
}

double topology_area(const Mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->index_count / 3; i++)
        sum += vec3_length(topology_face(mesh, i)) / 2;
    return sum;
}

double topology_volume(const Mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->index_count / 3; i++)
        sum += vec3_dot(topology_corner(mesh, 3 * i), topology_face(mesh, i)) / 6;
    return sum;
}

static const Mesh *sorted_mesh;

static int compare_positions(const void *a, const void *b)
{
    return memcmp(sorted_mesh->vertices[*(const uint32_t *)a].position,
                  sorted_mesh->vertices[*(const uint32_t *)b].position,
                  sizeof sorted_mesh->vertices->position);
}

uint32_t *topology_representatives(const Mesh *mesh)
{
    uint32_t *order = calloc(mesh->vertex_count, sizeof *order);
    uint32_t *found = calloc(mesh->vertex_count, sizeof *found);
    assert_true(order && found);
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        order[i] = i;
    sorted_mesh = mesh;
    qsort(order, mesh->vertex_count, sizeof *order, compare_positions);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        found[order[i]] = i > 0 && compare_positions(&order[i - 1], &order[i]) == 0
                              ? found[order[i - 1]]
                              : order[i];
    free(order);
    return found;
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

size_t topology_open_edges(const Mesh *mesh)
{
    uint32_t *vertex = topology_representatives(mesh);
    uint64_t *edges = calloc(mesh->index_count, sizeof *edges);
    size_t count = 0;
    assert_non_null(edges);
    for (size_t i = 0; i < mesh->index_count; i++) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        edges[i] = (uint64_t)vertex[mesh->indices[i]] << 32 | vertex[mesh->indices[next]];
    }
    qsort(edges, mesh->index_count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < mesh->index_count; i++) {
        const uint64_t back = edges[i] << 32 | edges[i] >> 32;
        assert_true(i == 0 || edges[i] != edges[i - 1]);
        count += !bsearch(&back, edges, mesh->index_count, sizeof back, compare_edges);
    }
    free(edges);
    free(vertex);
    return count;
}

void topology_check_indices(const Mesh *mesh)
{
    assert_int_equal(mesh->index_count % 3, 0);
    for (size_t i = 0; i < mesh->index_count; i++)
        assert_true(mesh->indices[i] < mesh->vertex_count);
}

void topology_check_sound(const Mesh *mesh)
{
    topology_check_indices(mesh);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        /* Three components, each with an error of at most a quarter of FLT_EPSILON: sqrt(3) / 4. */
        const double length = vec3_length(vec3_from_float(mesh->vertices[i].normal));
        assert_true(fabs(length - 1) <= 0.44 * FLT_EPSILON);
        assert_true(isfinite(vec3_length(vec3_from_float(mesh->vertices[i].position))));
    }
}

void topology_check_outward(const Mesh *mesh, size_t boundary)
{
    topology_check_sound(mesh);
    for (size_t i = 0; i < mesh->index_count; i++) {
        const Vec3 face = topology_face(mesh, i / 3);
        assert_true(vec3_length(face) > 0);
        assert_true(vec3_dot(face, topology_normal(mesh, mesh->indices[i])) > 0);
    }
    assert_int_equal(topology_open_edges(mesh), boundary);
}

void topology_check_seam(const MeshVertex *vertices, size_t rows, size_t columns)
{
    for (size_t j = 0; j < rows; j++)
        assert_memory_equal(&vertices[j * (columns + 1)], &vertices[j * (columns + 1) + columns],
                            sizeof *vertices);
}

void topology_check_zeroed(const Mesh *mesh)
{
    assert_null(mesh->vertices);
    assert_null(mesh->indices);
    assert_int_equal(mesh->vertex_count, 0);
    assert_int_equal(mesh->index_count, 0);
}
