/*
 * polygon: cuts a polygon into triangles.
 */
#ifndef POLYGON_H
#define POLYGON_H

#include "core/matrix.h"

/* Cuts a polygon of 3 corners or more, which may have notches, into count - 2 triangles: three
 * numbers of corners each, in the polygon's direction. One that crosses itself or has no area is
 * cut into as many, somehow. Takes about count log(count). */
void polygon_cut(const Vec3 *corners, int count, int *triangles);

#endif
