/*
 * mesh_solids: meshes of GLUT's solids, a disc, a square and the teapot, under the conventions of
 * mesh.h. No GL.
 */
#ifndef MESH_SOLIDS_H
#define MESH_SOLIDS_H

#include "base/stop.h"
#include "core/mesh.h"

/* As in GLUT (The OpenGL Utility Toolkit, API version 3, section 11; cylinder and caps as in
 * freeglut 3). Surfaces of revolution have the z axis; columns turn from +x towards +y, and the
 * last column is a bitwise copy of the first. Slices and sides are 3 to MESH_SPHERE_MAX, stacks,
 * loops and divisions 1 to MESH_SPHERE_MAX. */

/* A closed cone: the base is a disc at z = 0, the apex (0, 0, height). The apex has a vertex for
 * each slice, with the normal of the slice's middle. With MESH_CONE_HALVING for `stacks` the rings
 * are the textbook's, at 0, 1/2, 3/4, 7/8 and 15/16 of the height, every second one turned by half
 * a slice. */
enum { MESH_CONE_HALVING = -5 };
bool mesh_cone(Mesh *mesh, double radius, double height, int slices, int stacks, Message *message);

/* A cylinder from z = 0 to z = height, open or capped with discs. */
typedef enum MeshCaps {
    MESH_CAP_NONE = 0,
    MESH_CAP_BOTTOM = 1, /* at z = 0 */
    MESH_CAP_TOP = 2,    /* at z = height */
    MESH_CAP_BOTH = MESH_CAP_BOTTOM | MESH_CAP_TOP,
} MeshCaps;
typedef struct MeshCylinder {
    double radius, height;
    int slices, stacks;
    MeshCaps caps;
} MeshCylinder;
bool mesh_cylinder(Mesh *mesh, MeshCylinder cylinder, Message *message);

/* A torus of the tube radius `tube`, whose centre line is the circle of radius `ring` in the plane
 * z = 0; `sides` around the tube, `rings` along it (3 to MESH_SPHERE_MAX). ring / MESH_TORUS_THIN
 * <= tube < ring: floats cannot represent a thinner tube. */
enum { MESH_TORUS_THIN = 1000 };
bool mesh_torus(Mesh *mesh, double tube, double ring, int sides, int rings, Message *message);

/* A disc in the plane z = 0, normal +z, of `loops` concentric rings. */
bool mesh_disc(Mesh *mesh, double radius, int slices, int loops, Message *message);

/* The square [-1, 1] x [-1, 1] in the plane z = 0, normal +z, cut into divisions x divisions. */
bool mesh_quad(Mesh *mesh, int divisions, Message *message);

/* Regular solids inscribed in a sphere, each face with its own vertices. GLUT's radii are sqrt(3)
 * for the tetrahedron and the dodecahedron, 1 for the other two. Directions of the corners, with
 * the golden ratio g:
 *   tetrahedron:  (1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)
 *   octahedron:   the coordinate axes
 *   dodecahedron: (+-1, +-1, +-1), (0, +-1/g, +-g), (+-1/g, +-g, 0), (+-g, 0, +-1/g)
 *   icosahedron:  (+-1, 0, +-g), (0, +-g, +-1), (+-g, +-1, 0) */
typedef enum MeshRegular {
    MESH_TETRAHEDRON,
    MESH_OCTAHEDRON,
    MESH_DODECAHEDRON,
    MESH_ICOSAHEDRON,
} MeshRegular;
bool mesh_regular(Mesh *mesh, MeshRegular kind, double radius, Message *message);

/* Newell's teapot (University of Utah, 1975) as in GLUT, with a bottom: 32 bicubic Bezier patches,
 * each cut into divisions x divisions (2 to MESH_TEAPOT_MAX; GLUT: 14). y is up, the spout points
 * to +x, the handle to -x; the pot is symmetric in the plane z = 0. Its axis is the y axis; it
 * extends from y = -0.75 size to y = 0.825 size, is 3.2 size long and 2 size wide. Normals are
 * exact.
 *
 * Four grids in sequence: body with rim and bottom (4 x 4 patches: rows down, columns around), lid
 * (2 x 4), handle and spout (2 x 2, open tubes that end inside the body). Where patches degenerate
 * to a point, at the centre of the bottom and the tip of the lid, the normal is the limit. The lid
 * does not touch the rim, so the mesh is not closed. */
enum { MESH_TEAPOT_MAX = 512, MESH_TEAPOT_PATCHES = 32 };
bool mesh_teapot(Mesh *mesh, double size, int divisions, Message *message);

/* The mesh of the textbook's demos: cut into 4 x 4, with the normals of its triangles
 * (MESH_WEIGHT_ANGLE), averaged where they meet, and one control point inside the rim at -0.874
 * instead of -0.784, a slip of their data. */
bool mesh_teapot_textbook(Mesh *mesh, double size, Message *message);

/* mesh_teapot; fails soon after another thread sets *stop. */
bool mesh_teapot_until(Mesh *mesh, double size, int divisions, const atomic_bool *stop,
                       Message *message);

#endif
