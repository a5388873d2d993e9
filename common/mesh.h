/*
 * mesh: triangles with normals, in memory. No GL.
 *
 * Every shape is centred at the origin, unless said otherwise; its triangles are counter-clockwise
 * seen from outside and have an area, its normals are unit vectors that point outwards. A function
 * that makes a shape fails, with a message and a zeroed mesh, where an argument is out of its range
 * or memory runs out. A length is more than 0 and finite (as a float); so that triangles keep their
 * area and coordinates stay finite, it should also be within 1e-30 and 1e38.
 */
#ifndef MESH_H
#define MESH_H

#include "matrix.h"
#include "message.h"
#include "stop.h"

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

/* The solids of GLUT (The OpenGL Utility Toolkit, API version 3, section 11; cylinder and caps as
 * in freeglut 3). Round ones lie around the z axis, columns turn from +x towards +y, and each
 * column that closes a turn is the first, copied bit for bit. Slices and sides are 3 to
 * MESH_SPHERE_MOST, stacks, loops and divisions 1 to MESH_SPHERE_MOST. */

/* A cone from its base, a disc of the given radius at z = 0 that belongs to it, to its apex at
 * (0, 0, height): closed. The normals of the side are exact; an apex has none, so there is one for
 * each slice, that of the slice's middle. */
bool mesh_cone(Mesh *mesh, double radius, double height, int slices, int stacks, Message *message);

/* A cylinder from z = 0 to z = height, open or closed by discs. */
typedef enum MeshCaps {
    MESH_CAP_NONE = 0,
    MESH_CAP_BOTTOM = 1, /* at z = 0 */
    MESH_CAP_TOP = 2,    /* at z = height */
    MESH_CAP_BOTH = MESH_CAP_BOTTOM | MESH_CAP_TOP,
} MeshCaps;
bool mesh_cylinder(Mesh *mesh, double radius, double height, int slices, int stacks, MeshCaps caps,
                   Message *message);

/* A torus: a tube whose middle is the circle of radius `ring` in the plane z = 0, cut into `sides`
 * around the tube and `rings` along it (3 to MESH_SPHERE_MOST). ring / MESH_TORUS_THIN <= tube <
 * ring: a thinner tube has no shape left in floats. */
enum { MESH_TORUS_THIN = 1000 };
bool mesh_torus(Mesh *mesh, double tube, double ring, int sides, int rings, Message *message);

/* A disc in the plane z = 0, normal +z, as `loops` rings around its centre. */
bool mesh_disc(Mesh *mesh, double radius, int slices, int loops, Message *message);

/* The square [-1, 1] x [-1, 1] in the plane z = 0, normal +z, cut into divisions x divisions. */
bool mesh_quad(Mesh *mesh, int divisions, Message *message);

/* Regular solids in a sphere of the given radius, flat: each face has vertices of its own. The GLUT
 * manual's radii are sqrt(3) for the tetrahedron and the dodecahedron, 1 for the other two. Corners
 * lie along
 *   tetrahedron:  (1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)
 *   octahedron:   the coordinate axes
 *   dodecahedron: (+-1, +-1, +-1), (0, +-1/g, +-g), (+-1/g, +-g, 0), (+-g, 0, +-1/g)
 *   icosahedron:  (+-1, 0, +-g), (0, +-g, +-1), (+-g, +-1, 0)
 * where g is the golden ratio. */
bool mesh_tetrahedron(Mesh *mesh, double radius, Message *message);
bool mesh_octahedron(Mesh *mesh, double radius, Message *message);
bool mesh_dodecahedron(Mesh *mesh, double radius, Message *message);
bool mesh_icosahedron(Mesh *mesh, double radius, Message *message);

/* Newell's teapot (University of Utah, 1975) as GLUT has it, with a bottom: 32 bicubic Bezier
 * patches, each cut into divisions x divisions (2 to MESH_TEAPOT_MOST; GLUT's is 14). y is up, the
 * spout points to +x, the handle to -x, and the pot is its own mirror image in the plane z = 0. It
 * stands where GLUT puts it: from y = -0.75 size to y = 0.825 size, the axis of its body being the
 * y axis; 3.2 size long and 2 size wide. Normals are those of the patches.
 *
 * It is four grids, one after the other: body with rim and bottom (4 x 4 patches: rows down,
 * columns around), lid (2 x 4), handle and spout (2 x 2, open tubes that end inside the body). The
 * normals in the middle of the bottom and at the tip of the lid, where patches shrink to a point,
 * are the limit. The lid does not touch the rim: the pot is not closed. */
enum { MESH_TEAPOT_MOST = 512, MESH_TEAPOT_PATCHES = 32 };
bool mesh_teapot(Mesh *mesh, double size, int divisions, Message *message);

/* The same, which fails soon after another thread has made *stop true. */
bool mesh_teapot_until(Mesh *mesh, double size, int divisions, const atomic_bool *stop,
                       Message *message);

/* Any mesh whose indices are in range. */

/* The corners of the box around all vertices, used or not; zero where there are none. */
void mesh_bounds(const Mesh *mesh, Vec3 *low, Vec3 *high);

/* The unit normal of triangle number `triangle`, on the side from which it is counter-clockwise.
 * False, and a zero vector, where it has no area. */
bool mesh_face(const Mesh *mesh, size_t triangle, Vec3 *normal);

/* Whether every position and normal is finite, and every index that of a vertex: "mesh: vertex 7:
 * position (nan, 0, 1): must be finite". */
bool mesh_check(const Mesh *mesh, Message *message);

/* Gives every triangle three vertices of its own, with the triangle's normal, for flat shading;
 * leaves out triangles without area. On failure (mesh_check, memory) the mesh is as before. */
bool mesh_flatten(Mesh *mesh, Message *message);

/* How much a triangle's unit normal counts at one of its corners, where a and b are the edges that
 * meet there: */
typedef enum MeshWeight {
    /* the angle between a and b, so that it does not matter how a face is cut into triangles
     * (Thuermer and Wuethrich, Computing vertex normals from polygonal facets, JGT 3(1), 1998) */
    MESH_WEIGHT_ANGLE,
    /* the triangle's area, |a x b| / 2 (Gouraud's average, weighted; the cheapest) */
    MESH_WEIGHT_AREA,
    /* |a x b| / (|a|^2 |b|^2): exact where the vertices lie on a sphere
     * (Max, Weights for computing vertex normals from facet normals, JGT 4(2), 1999) */
    MESH_WEIGHT_MAX,
} MeshWeight;

/* Gives every vertex the weighted mean of the normals of the triangles that share it. Triangles
 * without area do not count. Where the others cancel, as on the edge of a sheet that is there
 * twice, the normal is the first triangle's; where there are none it is +z. Vertices that only lie
 * at the same place do not share: an edge between them stays sharp. On failure (memory) the mesh is
 * as before. */
bool mesh_compute_normals(Mesh *mesh, MeshWeight weight, Message *message);

/* For those that make shapes. */

/* Opens a mesh of so many zeroed vertices and indices. */
bool mesh_open(Mesh *mesh, size_t vertex_count, size_t index_count, Message *message);

/* Whether a length, or a number of parts, is in its range; "cone: radius 0: must be..." where not.
 */
bool mesh_check_length(const char *shape, const char *what, double length, Message *message);
bool mesh_check_count(const char *shape, const char *what, int count, int least, int most,
                      Message *message);

/* A grid of (rows + 1) x (columns + 1) vertices, row after row, seen from outside with its rows
 * downwards and its columns to the right; a row may be a pole, all of it in one place, whose
 * triangles without area are left out. At a pole, the triangle between columns i and i + 1 takes
 * vertex i + 1 of a first row, vertex i of a last row. */
typedef enum MeshPoles {
    MESH_POLE_NONE = 0,
    MESH_POLE_FIRST = 1,
    MESH_POLE_LAST = 2,
    MESH_POLE_BOTH = MESH_POLE_FIRST | MESH_POLE_LAST,
} MeshPoles;
size_t mesh_grid_size(int rows, int columns, MeshPoles poles); /* its indices */

/* Writes the indices of a grid that begins at vertex `first`; returns where they end. */
uint32_t *mesh_grid(uint32_t *indices, uint32_t first, int rows, int columns, MeshPoles poles);

/* Frees what a mesh holds and zeroes it. NULL or a zeroed mesh is fine. */
void mesh_close(Mesh *mesh);

#endif
