/*
 * mesh_make: for modules that make meshes: memory, checks of arguments, grids. No GL.
 */
#ifndef MESH_MAKE_H
#define MESH_MAKE_H

#include "core/mesh.h"

/* Opens a mesh of zeroed vertices and indices. */
bool mesh_open(Mesh *mesh, size_t vertex_count, size_t index_count, Message *message);

/* Gives every vertex a color, black, if it has none yet. */
bool mesh_open_colors(Mesh *mesh, Message *message);

bool mesh_copy(Mesh *copy, const Mesh *mesh, Message *message);

/* 64 random bits, the same for the same position and, with `normals`, normal. */
uint64_t mesh_hash(const MeshVertex *vertex, bool normals);

/* For each vertex the number of the first one at its position and, with `normals`, with its normal.
 * False: not enough memory. */
bool mesh_weld(const Mesh *mesh, bool normals, uint32_t *first);

/* Whether a length or a count is in range; else "cone: radius 0: must be...". */
bool mesh_check_length(const char *shape, const char *what, double length, Message *message);
bool mesh_check_count(const char *shape, const char *what, int count, int min, int max,
                      Message *message);

/* A grid of (rows + 1) x (columns + 1) vertices, row by row, seen from outside with rows downwards
 * and columns to the right. The first and last row may be poles, with all vertices at one position;
 * their triangles without area are omitted. At a pole, the triangle between columns i and i + 1
 * uses vertex i + 1 of a first row, vertex i of a last row. */
typedef enum MeshPoles {
    MESH_POLE_NONE = 0,
    MESH_POLE_FIRST = 1,
    MESH_POLE_LAST = 2,
    MESH_POLE_BOTH = MESH_POLE_FIRST | MESH_POLE_LAST,
} MeshPoles;
size_t mesh_grid_size(int rows, int columns, MeshPoles poles); /* its indices */

/* Writes the indices of a grid that begins at vertex `first`; returns where they end. */
uint32_t *mesh_grid(uint32_t *indices, uint32_t first, int rows, int columns, MeshPoles poles);

#endif
