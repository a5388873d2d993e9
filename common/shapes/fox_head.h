/*
 * fox_head: the head of a fox, a small model of our own, and Catmull-Clark subdivision. No GL.
 */
#ifndef FOX_HEAD_H
#define FOX_HEAD_H

#include "core/mesh.h"

/* The head looks to +z, y is up. It lies in the unit sphere, is closed, and mirror symmetric in x
 * bit for bit. */
typedef enum HeadStyle {
    HEAD_FACETED,    /* the control cage, one normal for each quadrilateral */
    HEAD_SMOOTH,     /* the same cage, normals averaged at its vertices */
    HEAD_SUBDIVIDED, /* subdivided twice, normals averaged at its vertices */
} HeadStyle;
bool mesh_head(Mesh *mesh, HeadStyle style, Message *message);

/* Quadrilaterals, counter-clockwise seen from outside, that form a closed surface; or the half of
 * one at x >= 0, whose boundary lies in the plane x = 0, the other half being its mirror image. No
 * point of a closed surface lies in that plane. */
typedef struct Cage {
    Vec3 *points;
    uint32_t (*quads)[4];
    size_t point_count, quad_count;
} Cage;

/* One step of Catmull-Clark subdivision (Catmull and Clark, Recursively generated B-spline surfaces
 * on arbitrary topological meshes, Computer-Aided Design 10(6), 1978). The points are those of the
 * cage, moved, in their order, then the quadrilaterals' and the edges'; quadrilateral q becomes 4 q
 * to 4 q + 3, which begin at its corners. */
void cage_subdivide(Cage *cage);

/* NULL or zeroed is fine. */
void cage_close(Cage *cage);

#endif
