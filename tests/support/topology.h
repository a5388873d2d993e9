/*
 * topology: area, volume and edges of triangle meshes, in double precision.
 *
 * Products of two floats are exact in double; the sums here lose at most a few of its last bits.
 */
#ifndef TOPOLOGY_H
#define TOPOLOGY_H

#include "core/mesh.h"

double topology_distance(Vec3 a, Vec3 b);

Vec3 topology_position(const Mesh *mesh, size_t vertex);
Vec3 topology_normal(const Mesh *mesh, size_t vertex);

/* The position that an index leads to. */
Vec3 topology_corner(const Mesh *mesh, size_t index);

/* Normal to a triangle, counter-clockwise on its side; its length is twice the area. */
Vec3 topology_face(const Mesh *mesh, size_t triangle);

double topology_area(const Mesh *mesh);

/* Signed: sums the tetrahedra from the origin (divergence theorem). */
double topology_volume(const Mesh *mesh);

/* For each vertex a number that vertices with bitwise the same position share: the index of one of
 * them. To be freed. */
uint32_t *topology_representatives(const Mesh *mesh);

/* Edges that one triangle alone has; 0: the surface is closed. Fails the test if two triangles have
 * an edge in the same direction. Vertices with the same position count as one. */
size_t topology_open_edges(const Mesh *mesh);

/* Fails the test unless all indices are those of vertices, and of whole triangles. */
void topology_check_indices(const Mesh *mesh);

/* The same, and unless positions are finite and normals are unit vectors. */
void topology_check_sound(const Mesh *mesh);

/* The same, and unless its triangles have an area, are counter-clockwise on the side of their
 * corners' normals, and have `boundary` open edges. */
void topology_check_outward(const Mesh *mesh, size_t boundary);

/* Fails the test unless each of `rows` rows ends with its first vertex. */
void topology_check_seam(const MeshVertex *vertices, size_t rows, size_t columns);

/* Fails the test unless the mesh is zeroed. */
void topology_check_zeroed(const Mesh *mesh);

/* Fails the test unless the call opens no mesh, zeroes it, and leaves the message (a format):
 *   CHECK_REFUSED(mesh_cube(mesh, -1, message), "cube: half side %d: ...", -1); */
#define CHECK_REFUSED(call, ...)                                                                   \
    do {                                                                                           \
        Mesh *const mesh = &(Mesh){.vertices = NULL};                                              \
        Message *const message = &(Message){0};                                                    \
        char expected[256];                                                                        \
        memset(mesh, 0xa5, sizeof *mesh);                                                          \
        snprintf(expected, sizeof expected, __VA_ARGS__);                                          \
        assert_false(call);                                                                        \
        topology_check_zeroed(mesh);                                                               \
        assert_string_equal(message->text, expected);                                              \
    } while (0)

#endif
