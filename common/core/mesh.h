/*
 * mesh: triangles with normals, in memory. No GL.
 *
 * Shapes are centred at the origin unless noted otherwise; triangles are counter-clockwise seen
 * from outside and have an area; normals are unit vectors that point outwards. A function that
 * makes a shape fails, with a message and a zeroed mesh, if an argument is out of range or memory
 * runs out. Lengths are positive and finite (as floats); within 1e-30 and 1e38 triangles keep their
 * area and coordinates stay finite.
 */
#ifndef MESH_H
#define MESH_H

#include "base/message.h"
#include "core/matrix.h"

#include <stddef.h>
#include <stdint.h>

/* Interleaved for a vertex buffer: 24 bytes, position first. */
typedef struct MeshVertex {
    float position[3];
    float normal[3];
} MeshVertex;

typedef struct Mesh {
    MeshVertex *vertices;
    uint32_t *indices; /* three per triangle */
    size_t vertex_count;
    size_t index_count;
    /* One per vertex, or NULL: */
    float (*colors)[3];        /* what the vertex reflects, 0 to 1 */
    float (*lit_positions)[3]; /* where its light is computed, if not at its position */
} Mesh;

/* A cube from -half_side to +half_side: 24 vertices, because each corner has three normals, one per
 * adjacent face. Faces in the order front (+z), right (+x), up (+y), left, down, back; each is
 * split along the diagonal from its first corner to its third. */
bool mesh_cube(Mesh *mesh, double half_side, Message *message);

/* A sphere around the y axis. Vertex (i, j) lies at the angle 2 pi i / slices from +z towards +x,
 * and pi j / stacks from the north pole +y; there are (slices + 1)(stacks + 1), with seam and poles
 * duplicated bit for bit. 3 <= slices, 2 <= stacks, both at most MESH_SPHERE_MAX. */
enum { MESH_SPHERE_MAX = 8192 };
bool mesh_sphere(Mesh *mesh, double radius, int slices, int stacks, Message *message);

/* The original lecture's sphere, number for number: as above with radius 1 and as many stacks as
 * slices, but with rounded sines at poles and seam, and two triangles for every quad: those at the
 * poles have no area and draw nothing. */
bool mesh_sphere_lecture(Mesh *mesh, int divisions, Message *message);

/* Any mesh whose indices are in range. */

/* The bounding box of all vertices, used or not; zero without vertices. */
typedef struct MeshBox {
    Vec3 low, high;
} MeshBox;
MeshBox mesh_bounds(const Mesh *mesh);

/* The unit normal of triangle number `triangle`, on the side from which it is counter-clockwise.
 * False, and a zero vector, if it has no area. NULL: only whether it has. */
bool mesh_face(const Mesh *mesh, size_t triangle, Vec3 *normal);

/* Whether positions and normals are finite, colors 0 to 1 and indices in range: "mesh: vertex 7:
 * position (nan, 0, 1): must be finite". */
bool mesh_check(const Mesh *mesh, Message *message);

/* For flat shading: gives each triangle three vertices of its own with its normal; drops triangles
 * without area. On failure (mesh_check, memory) the mesh is unchanged. */
bool mesh_flatten(Mesh *mesh, Message *message);

/* For one color per triangle (GL_FLAT): gives each triangle three vertices of its own that are lit
 * like its last one, OpenGL's provoking vertex. On failure the mesh is unchanged. */
bool mesh_provoke(Mesh *mesh, Message *message);

/* The weight of a triangle's unit normal at a corner with the edges a and b: */
typedef enum MeshWeight {
    /* the angle between a and b: independent of how a face is triangulated
     * (Thuermer and Wuethrich, Computing vertex normals from polygonal facets, JGT 3(1), 1998) */
    MESH_WEIGHT_ANGLE,
    /* the triangle's area, |a x b| / 2 (Gouraud's average, weighted; the cheapest) */
    MESH_WEIGHT_AREA,
    /* |a x b| / (|a|^2 |b|^2): exact if the vertices lie on a sphere (Max, Weights for computing
     * vertex normals from facet normals, JGT 4(2), 1999) */
    MESH_WEIGHT_MAX,
} MeshWeight;

/* Gives each vertex (`missing`: without a normal) the weighted mean of the normals of its triangles
 * with an area. If they cancel, as on the edge of a doubled sheet, the normal is the first
 * triangle's; without any it is +z. Vertices at the same position stay separate: an edge between
 * them stays sharp. On failure (memory) the mesh is unchanged. */
bool mesh_compute_normals(Mesh *mesh, MeshWeight weight, bool missing, Message *message);

/* NULL or zeroed is fine. */
void mesh_close(Mesh *mesh);

#endif
