/*
 * solid: shapes that have a formula, and meshes of them of any fineness. No GL.
 *
 * An object names the solid that its mesh approximates, for the exact picture and for finer or
 * coarser meshes.
 */
#ifndef SOLID_H
#define SOLID_H

#include "core/mesh.h"
#include "shapes/mesh_solids.h"

typedef enum SolidKind {
    SOLID_NONE, /* no formula: the triangles are the shape */
    SOLID_SPHERE,
    SOLID_BOX,
    SOLID_QUAD,
    SOLID_DISC,
    SOLID_CYLINDER,
    SOLID_CONE,
    SOLID_TORUS,
    SOLID_TEAPOT,
} SolidKind;

/* Placed as its mesh: see mesh.h and mesh_solids.h. Lengths are more than 0 and finite. */
typedef struct Solid {
    SolidKind kind;
    double radius; /* sphere, disc, cylinder, cone; torus: of its ring. Box: half a side. Teapot:
                      its size */
    double height; /* cylinder, cone */
    double tube;   /* torus: the radius of its tube */
    MeshCaps caps; /* cylinder */
} Solid;

/* Divisions: the parts of a full turn, or of a side of a box or quad. */
enum { SOLID_MIN_DIVISIONS = 3, SOLID_MAX_DIVISIONS = 1024 };

/* A mesh of `solid`, not SOLID_NONE, from `divisions`: as many slices and stacks of a sphere;
 * slices of a cylinder, cone or disc, with a quarter as many stacks or loops; rings of a torus,
 * with half as many sides; parts of each side of a box or quad; a quarter as many for each patch of
 * the teapot, four of which make a turn. Fails as mesh_sphere does, and if `divisions` is out of
 * range.
 */
bool solid_mesh(const Solid *solid, int divisions, Mesh *mesh, Message *message);

/* A cache of meshes by solid and divisions. Zeroed: empty. */
typedef struct SolidMesh {
    Solid solid;
    int divisions;
    Mesh mesh;
    struct SolidMesh *next;
} SolidMesh;
typedef struct SolidMeshes {
    SolidMesh *first;
} SolidMeshes;

/* The cached mesh, made on first use and valid until solid_meshes_close; NULL if solid_mesh fails.
 */
const Mesh *solid_meshes_find(SolidMeshes *meshes, const Solid *solid, int divisions,
                              Message *message);
void solid_meshes_close(SolidMeshes *meshes);

/* Whether all normals of a triangle are equal: a box, a quad, a disc. */
bool solid_flat(const Solid *solid);

#endif
