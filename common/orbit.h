/*
 * orbit: a camera moved about the point that it looks at.
 */
#ifndef ORBIT_H
#define ORBIT_H

#include "matrix.h"

/* Degrees, and a factor. Zeroed, the camera stays where it is. */
typedef struct Orbit {
    double azimuth;   /* to the camera's right, about its up direction */
    double elevation; /* from there towards up, -90 to 90 */
    double distance;  /* times that from eye to center; 0: 1 */
} Orbit;

/* Its distance, 1 where it says nothing. */
double orbit_distance(Orbit orbit);

/* Moves the eye, and `up` with it. An orbit that moves nothing changes no bit. Where the camera
 * looks along `up`, there is no right and no higher: only the distance changes. */
void orbit_move(Orbit orbit, Vec3 *eye, Vec3 center, Vec3 *up);

/* Writes it as --orbit takes it, "30,-10" or "30,-10,0.5". False, and an empty text, where it moves
 * nothing. */
bool orbit_text(Orbit orbit, char text[96]);

#endif
