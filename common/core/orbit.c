/* Three angles and a distance, applied to the camera of the scene. */
#include "core/orbit.h"

double orbit_distance(Orbit orbit)
{
    return orbit.distance > 0 ? orbit.distance : 1;
}

bool orbit_moves(Orbit orbit)
{
    return orbit.azimuth != 0 || orbit.elevation != 0 || orbit_distance(orbit) != 1 ||
           orbit.roll != 0;
}

static Vec3 turn(Vec3 vector, double degrees, Vec3 axis)
{
    return mat4_transform_direction(mat4_rotate(degrees, axis), vector);
}

void orbit_move(Orbit orbit, Vec3 *eye, Vec3 center, Vec3 *up)
{
    if (!orbit_moves(orbit))
        return;
    Vec3 back = vec3_scale(vec3_subtract(*eye, center), orbit_distance(orbit)), right;
    if (vec3_normalize(vec3_cross(*up, back), &right)) {
        const Vec3 axis = *up;
        if (orbit.elevation != 0) {
            *up = turn(vec3_cross(back, right), -orbit.elevation, right);
            back = turn(back, -orbit.elevation, right);
        }
        back = turn(back, orbit.azimuth, axis);
        *up = turn(turn(*up, orbit.azimuth, axis), -orbit.roll, back);
    }
    *eye = vec3_add(center, back);
}
