/*
 * model: triangles from a model file, as a mesh. No GL.
 *
 * OBJ, PLY, STL, OFF, glTF, 3DS, COLLADA and what else Assimp reads, in a module that is loaded at
 * the first need. Where the module or the library is missing, reading fails and names the package.
 *
 * Assimp is read with in a process of its own that is limited in time and memory: broken files can
 * make it loop or crash, and this way that is an error like any other.
 */
#ifndef MODEL_H
#define MODEL_H

#include "mesh.h"

/* What is larger is refused. Vertices are counted as the file's parts give them, before equal ones
 * are joined. */
enum {
    MODEL_BYTES_MOST = 1 << 30,
    MODEL_VERTICES_MOST = 10000000,
    MODEL_TRIANGLES_MOST = 20000000
};

/* Reads all meshes of a file into one, each where the file's nodes place it. Polygons are cut into
 * triangles; points, lines and triangles without area are left out; vertices of equal position and
 * normal are joined. Normals are made unit; where the file has none (or zero), they are computed by
 * mesh_compute_normals with the weight of the angle, smooth across all edges. Size and place are
 * the file's: see mesh_bounds.
 *
 * False, with one line of message and a zeroed mesh, where the file cannot be read, is no model, is
 * damaged (as far as its format lets that be seen), holds no triangle or a coordinate that is not
 * finite, or is too large. */
bool model_read(const char *path, Mesh *mesh, Message *message);

/* For --doctor: loads the module and says on standard output what it found. */
bool model_doctor(void);

#endif
