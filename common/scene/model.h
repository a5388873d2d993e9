/*
 * model: reads model files as meshes. No GL.
 *
 * glTF, OBJ, PLY, STL, OFF, 3DS, COLLADA and all other formats of Assimp, through a plugin; if that
 * is missing, reading fails with a message that names the package. Assimp runs in a child process
 * with limited time and memory, because damaged files can make it loop or crash.
 */
#ifndef MODEL_H
#define MODEL_H

#include "scene/scene_file.h"

/* Reads all meshes of a file into one, transformed by the file's nodes. Polygons are triangulated;
 * points, lines and degenerate triangles are left out; vertices of equal position and normal are
 * merged, unless each is used thrice on average and has a normal. Normals are normalized; missing
 * or zero ones are computed by mesh_compute_normals, weighted by angle, smooth across all edges (of
 * glTF: those of the triangles). It is turned so that y points up; size and place are the file's:
 * see mesh_bounds.
 *
 * Fails, with a message of one line and a zeroed mesh, if the file cannot be read, is not a model,
 * is damaged (as far as its format shows), too large, or has no triangle or a number that is not
 * finite. */
bool model_read(const char *path, ModelUp up, Mesh *mesh, Message *message);

/* Gives a mesh the normals that are missing: zero ones. Without colors, vertices of equal position
 * and normal are merged first. */
bool model_complete(Mesh *mesh, Message *message);

#endif
