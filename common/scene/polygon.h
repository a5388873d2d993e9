/*
 * polygon: cuts a polygon into triangles.
 */
#ifndef POLYGON_H
#define POLYGON_H

#include "core/matrix.h"

#include <stdint.h>

typedef struct TriangleList {
    uint32_t *corners; /* three each, to be freed */
    int count, room;
} TriangleList;

/* Cuts a polygon of these vertices, 3 or more, which may have notches, into count - 2 triangles in
 * its direction and appends them; `place` says where a vertex is. One that crosses itself or has no
 * area is cut into as many, somehow. Takes about count log(count). */
typedef Vec3 PolygonPlace(const void *of, uint32_t vertex);
void polygon_add(TriangleList *list, const uint32_t *vertices, int count, PolygonPlace *place,
                 const void *of);

#endif
