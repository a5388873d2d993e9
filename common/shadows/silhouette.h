/*
 * silhouette: the volume that a mesh keeps from a light: caps on the mesh, sides that begin at its
 * silhouette and end at infinity, and caps there. No GL.
 *
 * Each triangle is taken as turned towards the light, and keeps from it what lies behind: a volume
 * bounded by the triangle, by sides from its edges, and at infinity. The sum of these volumes
 * counts the triangles between a point and the light, whatever the mesh is. Sides of neighbors
 * cancel; what remains at an edge is the number of triangles on the one side less that on the
 * other, so that open, doubled and branching edges, and T-junctions, need no care. (Bergeron, A
 * general version of Crow's shadow volumes, IEEE CG&A 6(9), 1986; Aldridge and Woods, Robust,
 * geometry-independent shadow volumes, GRAPHITE 2004)
 */
#ifndef SILHOUETTE_H
#define SILHOUETTE_H

#include "core/mesh.h"

/* The edges of a mesh; vertices at the same position count as one. */
typedef struct Silhouette {
    const Mesh *mesh;
    size_t triangle_count, edge_count;
    Vec3 *normals;       /* of each triangle, of any length; zero: it has no area and no edges */
    bool *turned;        /* of each triangle: its vertices' normals are on the other side */
    uint32_t *edges;     /* three for each triangle: twice the edge's number, plus 1 if reversed */
    uint32_t (*ends)[2]; /* of each edge, as vertices of the mesh */
    int *nets;           /* of each edge, while volumes are made */
    double *lows;  /* of each corner: its normal's least product with a corner of its triangle */
    Vec3 center;   /* of the mesh's box, rounded to float */
    double radius; /* no vertex is farther from there */
    bool closed;   /* as many triangles on the one side of each edge as on the other, and the
                      outside is where they are counter-clockwise */
} Silhouette;

/* False if memory is out. The mesh must outlive the silhouette. */
bool silhouette_open(Silhouette *silhouette, const Mesh *mesh, Message *message);
void silhouette_close(Silhouette *silhouette); /* NULL or zeroed is fine */

/* Which triangles a volume is made of. Of a closed mesh those that face a light outside of it are
 * enough, or those that do not: then its own surface is not within. */
typedef enum SilhouetteFacing {
    SILHOUETTE_ALL,
    SILHOUETTE_LIT,
    SILHOUETTE_UNLIT,
} SilhouetteFacing;

/* Triangles by three indices each; room is reused. Zeroed: empty. */
typedef struct ShadowVolume {
    /* The mesh's own triangles, as they are: those that the volume is made of are its caps. Apart
     * by whether they face the light, and whether they are turned: see shadow_volume_caps. */
    uint32_t *caps[4];
    /* Sides and caps at the end, counter-clockwise seen from outside the volume: twice a vertex of
     * the mesh, plus 1 if it is moved to the end, away from the light. */
    uint32_t *sides;
    size_t cap_counts[4], side_count; /* of indices */
    size_t capacity;                  /* of triangles and edges in all */
} ShadowVolume;

typedef enum ShadowEnd {
    SHADOW_END_OPEN,
    SHADOW_END_CAPS,
    SHADOW_END_POINT, /* all sides end in one */
} ShadowEnd;

typedef struct ShadowVolumeKind {
    Vec4 light; /* in object coordinates: its position with w = 1, or the direction towards it with
                   w = 0 */
    SilhouetteFacing facing;
    ShadowEnd end;
    bool dark; /* false: of the caps those are left out that face away from the light as all their
                  vertices' normals do, clearly: no light falls on them anyway */
} ShadowVolumeKind;

/* Triangles without an area are left out. */
bool shadow_volume_make(ShadowVolume *volume, const Silhouette *silhouette,
                        const ShadowVolumeKind *kind, Message *message);
static inline int shadow_volume_caps(bool lit, bool turned)
{
    return 2 * lit + turned;
}
void shadow_volume_close(ShadowVolume *volume); /* NULL or zeroed is fine */

#endif
