/*
 * mesh: triangles with normals, in memory. No GL.
 *
 * Every shape is centred at the origin; its triangles are counter-clockwise seen from outside, its
 * normals are unit vectors that point outwards.
 */
#ifndef MESH_H
#define MESH_H

#include "message.h"

#include <stddef.h>
#include <stdint.h>

/* Interleaved, as a vertex buffer wants it: 24 bytes, position first. */
typedef struct MeshVertex {
    float position[3];
    float normal[3];
} MeshVertex;

typedef struct Mesh {
    MeshVertex *vertices;
    uint32_t *indices; /* three for each triangle */
    size_t vertex_count;
    size_t index_count;
} Mesh;

/* A cube from -half_side to +half_side: 24 vertices, for each corner has three normals, one for
 * each face that meets there. Faces in the order front (+z), right (+x), up (+y), left, down, back;
 * each is split along the diagonal from its first corner to its third. half_side > 0 and finite. */
bool mesh_cube(Mesh *mesh, double half_side, Message *message);

/* A sphere of the given radius around the y axis. Vertex (i, j) lies at the angle 2 pi i / slices
 * from +z towards +x, and pi j / stacks from the north pole +y; there are (slices + 1)(stacks + 1),
 * the seam and the poles being copied bit for bit. 3 <= slices, 2 <= stacks, both at most
 * MESH_SPHERE_MOST; radius > 0 and finite. */
enum { MESH_SPHERE_MOST = 8192 };
bool mesh_sphere(Mesh *mesh, double radius, int slices, int stacks, Message *message);

/* The lecture's sphere, number for number: as above with radius 1 and as many stacks as slices, but
 * poles and seam as the sine gives them, and two triangles for every quad, so that those at the
 * poles have no area (they draw nothing). */
bool mesh_sphere_lecture(Mesh *mesh, int divisions, Message *message);

/* Frees what a mesh holds and zeroes it. NULL or a zeroed mesh is fine. */
void mesh_close(Mesh *mesh);

#endif
