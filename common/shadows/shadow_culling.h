/*
 * shadow_culling: whether an object may come between another and a light, from their boxes. No GL.
 */
#ifndef SHADOW_CULLING_H
#define SHADOW_CULLING_H

#include "core/mesh.h"

/* A mesh's box in the world: its center, and the ways from there to the middles of three sides. */
typedef struct PlacedBox {
    Vec3 center, half[3];
} PlacedBox;

PlacedBox placed_box(const MeshBox *box, Mat4 world_from_object);

/* How far it reaches from its center along a direction, in lengths of that. */
double placed_reach(const PlacedBox *box, Vec3 way);

/* At least the radius of a sphere around it. */
double placed_size(const PlacedBox *box);

/* Whether a segment from the receiver to the light may meet the occluder. `light`: its position
 * with w = 1, or the direction towards it with w = 0. False is certain, up to a millionth of the
 * boxes' sizes: a plane lies between the occluder and all those segments. */
bool may_come_between(const PlacedBox *occluder, const PlacedBox *receiver, Vec4 light);

#endif
