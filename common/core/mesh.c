/*
 * What holds for any mesh: its box, the normals of its triangles, whether it can be drawn, and the
 * normals of its vertices, as the mean of those of the triangles around, by weights that mesh.h
 * names with their sources. One pass adds up, a second divides: linear in triangles and vertices.
 */
#include "core/mesh.h"
#include "core/matrix_vectors.h"

#include <math.h>
#include <stdlib.h>

void mesh_close(Mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->vertices);
    free(mesh->indices);
    free(mesh->colors);
    free(mesh->lit_positions);
    *mesh = (Mesh){0};
}

MeshBox mesh_bounds(const Mesh *mesh)
{
    MeshBox box = {.low = {0, 0, 0}};
    if (mesh->vertex_count > 0)
        box.low = box.high = vec3_from_float(mesh->vertices[0].position);
    for (size_t i = 1; i < mesh->vertex_count; i++) {
        const Vec3 p = vec3_from_float(mesh->vertices[i].position);
        box.low.x = p.x < box.low.x ? p.x : box.low.x;
        box.low.y = p.y < box.low.y ? p.y : box.low.y;
        box.low.z = p.z < box.low.z ? p.z : box.low.z;
        box.high.x = p.x > box.high.x ? p.x : box.high.x;
        box.high.y = p.y > box.high.y ? p.y : box.high.y;
        box.high.z = p.z > box.high.z ? p.z : box.high.z;
    }
    return box;
}

static inline Vec3 edge(const Mesh *mesh, uint32_t from, uint32_t to)
{
    const float *a = mesh->vertices[from].position, *b = mesh->vertices[to].position;
    return (Vec3){(double)b[0] - (double)a[0], (double)b[1] - (double)a[1],
                  (double)b[2] - (double)a[2]};
}

/* Of twice the triangle's area. */
static Vec3 across(const Mesh *mesh, size_t triangle)
{
    const uint32_t *corner = &mesh->indices[3 * triangle];
    return vec3_cross(edge(mesh, corner[0], corner[1]), edge(mesh, corner[0], corner[2]));
}

bool mesh_face(const Mesh *mesh, size_t triangle, Vec3 *normal)
{
    const Vec3 area = across(mesh, triangle);
    const double square = vec3_dot(area, area); /* of floats: neither 0 nor infinite by rounding */
    return normal ? vec3_normalize(area, normal) : square > 0 && square < HUGE_VAL;
}

/* 0 times a finite number is 0, times any other NaN. */
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
    for (size_t i = 0; i < mesh->vertex_count && mesh->colors; i++) {
        const float *c = mesh->colors[i];
        for (int k = 0; k < 3; k++)
            if (!(c[k] >= 0 && c[k] <= 1))
                return message_set(message, "mesh: vertex %zu: color (%g, %g, %g): must be 0 to 1",
                                   i, (double)c[0], (double)c[1], (double)c[2]);
    }
    for (size_t i = 0; i < mesh->index_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return message_set(message, "mesh: triangle %zu: vertex %lu: there are %zu", i / 3,
                               (unsigned long)mesh->indices[i], mesh->vertex_count);
    return true;
}

/* `sine` and the cosine both times |a| |b|: twice the area, the same at all corners. */
static double corner_weight(double sine, Vec3 a, Vec3 b, MeshWeight weight)
{
    switch (weight) {
    case MESH_WEIGHT_AREA:
        return sine / 2;
    case MESH_WEIGHT_MAX:
        return sine / (vec3_dot(a, a) * vec3_dot(b, b));
    case MESH_WEIGHT_ANGLE:
        break;
    }
    return atan2(sine, vec3_dot(a, b));
}

bool mesh_compute_normals(Mesh *mesh, MeshWeight weight, bool missing, Message *message)
{
    /* A sum below this fraction of its terms is rounding. */
    static const double CANCELLED = 1e-12;
    typedef struct Sum {
        Vec3 normals;
        double weights;
        bool kept; /* it has a normal */
    } Sum;
    Sum *sums = calloc(mesh->vertex_count + 1, sizeof *sums);
    if (!sums)
        return message_set(message, "mesh: not enough memory for the normals of %zu vertices",
                           mesh->vertex_count);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *n = mesh->vertices[i].normal;
        sums[i].kept = missing && (n[0] != 0 || n[1] != 0 || n[2] != 0);
        if (!sums[i].kept)
            vec3_to_float((Vec3){0, 0, 1}, n);
    }
    for (size_t triangle = 0; triangle < mesh->index_count / 3; triangle++) {
        const uint32_t *corner = &mesh->indices[3 * triangle];
        const Vec3 ab = edge(mesh, corner[0], corner[1]), bc = edge(mesh, corner[1], corner[2]),
                   ac = edge(mesh, corner[0], corner[2]), area = vec3_cross(ab, ac);
        const Vec3 sides[3][2] = {{ab, ac}, {bc, vec3_scale(ab, -1)}, {ac, bc}};
        const double sine = vec3_length(area);
        Vec3 normal;
        if (!vec3_normalize(area, &normal))
            continue;
        for (int i = 0; i < 3; i++) {
            const uint32_t vertex = corner[i];
            Sum *sum = &sums[vertex];
            if (sum->kept)
                continue;
            const double share = corner_weight(sine, sides[i][0], sides[i][1], weight);
            if (sum->weights == 0)
                vec3_to_float(normal, mesh->vertices[vertex].normal);
            sum->normals = vec3_add(sum->normals, vec3_scale(normal, share));
            sum->weights += share;
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
