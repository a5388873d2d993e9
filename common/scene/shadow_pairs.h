/*
 * shadow_pairs: which light's shadows may fall on which object of a scene, from boxes. No GL.
 */
#ifndef SHADOW_PAIRS_H
#define SHADOW_PAIRS_H

#include "scene/scene.h"
#include "shadows/shadow_culling.h"

/* Of `count` objects. The caller fills boxes and places. */
typedef struct ShadowPairs {
    int count, capacity;
    MeshBox *boxes;              /* of the meshes */
    PlacedBox *placed;           /* the same in the world */
    uint32_t *receives, *throws; /* a bit for each light */
    uint32_t all;                /* the lights that something receives */
    int *reached;                /* one light's: the objects in its cone and range */
} ShadowPairs;

/* Makes room. Contents are kept. */
bool shadow_pairs_open(ShadowPairs *pairs, int count, Message *message);
void shadow_pairs_close(ShadowPairs *pairs); /* zeroed is fine */

/* Finds `receives`, `throws` and `all`. The time is linear in objects and lights where most objects
 * that a light reaches cast shadows and lie in some; of those that do neither, the distances of all
 * pairs are looked at. */
void shadow_pairs_find(ShadowPairs *pairs, const Scene *scene);

/* Whether a spot's cone misses a sphere. The light is in the world. */
bool cone_misses(const Light *light, Sphere sphere);

/* How near a light comes to a sphere at least, and whether that is beyond its range. */
double nearest_to(const Light *light, Sphere sphere);
bool beyond_range(const Light *light, Sphere sphere);

#endif
