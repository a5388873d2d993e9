/*
 * solid: the shapes that have a formula, and meshes of them as fine as one likes. No GL.
 *
 * An object says beside its mesh which solid that stands for, so that the exact picture can be
 * computed and the mesh be made finer or coarser.
 */
#ifndef SOLID_H
#define SOLID_H

#include "mesh.h"

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

/* Where a solid lies is where its mesh lies: see mesh.h. Lengths are those of mesh.h's functions,
 * more than 0 and finite. */
typedef struct Solid {
    SolidKind kind;
    double radius; /* sphere, disc, cylinder, cone; torus: of its ring. Box: half a side. Teapot:
                      its size */
    double height; /* cylinder, cone */
    double tube;   /* torus: the radius of its tube */
    MeshCaps caps; /* cylinder */
} Solid;

/* The fineness of a mesh: into how many parts a full turn is cut, or a side of a box or quad. */
enum { SOLID_LEAST_DIVISIONS = 3, SOLID_MOST_DIVISIONS = 1024 };

/* A mesh of `solid`, which has a kind other than SOLID_NONE:
 *   sphere: `divisions` slices and as many stacks; cylinder, cone, disc: slices, and a quarter as
 *   many stacks or loops; torus: rings, and half as many sides; box and quad: each side cut into so
 *   many parts; teapot: a quarter for each of its patches, of which four make a turn.
 * Fails as the functions of mesh.h do, and where `divisions` is out of its range. */
bool solid_mesh(const Solid *solid, int divisions, Mesh *mesh, Message *message);

/* Meshes that have been made, one for each solid and number of divisions. Zeroed: none. */
typedef struct SolidMesh {
    Solid solid;
    int divisions;
    Mesh mesh;
    struct SolidMesh *next;
} SolidMesh;
typedef struct SolidMeshes {
    SolidMesh *first;
} SolidMeshes;

/* The mesh, made if it is not there; it lasts until solid_meshes_close. NULL where solid_mesh
 * fails. */
const Mesh *solid_meshes_find(SolidMeshes *meshes, const Solid *solid, int divisions,
                              Message *message);
void solid_meshes_close(SolidMeshes *meshes);

/* Whether every triangle of such a mesh has one normal: a box, a quad, a disc. */
bool solid_flat(const Solid *solid);

#endif
