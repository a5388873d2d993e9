/*
 * orbit: a camera that moves around the point it looks at.
 */
#ifndef ORBIT_H
#define ORBIT_H

#include "core/matrix.h"

/* Zeroed, the camera does not move. */
typedef struct Orbit {
    double azimuth;   /* degrees to the camera's right, about its up direction */
    double elevation; /* degrees from there towards up, -90 to 90 */
    double distance;  /* factor of the distance from eye to center; 0: 1 */
    double roll;      /* degrees about the line of sight, then; the picture counter-clockwise */
} Orbit;

/* The factor: 1 if `distance` is 0. */
double orbit_distance(Orbit orbit);

/* Moves the eye, and `up` with it; bit-exact if the orbit moves nothing. If the camera looks along
 * `up`, only the distance changes, because right and up are undefined. */
void orbit_move(Orbit orbit, Vec3 *eye, Vec3 center, Vec3 *up);

bool orbit_moves(Orbit orbit);

#endif
