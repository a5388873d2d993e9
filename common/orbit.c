#include "orbit.h"

/* `axis` need not be unit. */
static Vec3 turn(Vec3 vector, double degrees, Vec3 axis)
{
    Mat4 rotation;
    return mat4_rotate(degrees, axis, &rotation) ? mat4_transform_direction(rotation, vector)
                                                 : vector;
}

void orbit_move(Orbit orbit, Vec3 *eye, Vec3 center, Vec3 *up)
{
    const double distance = orbit.distance > 0 ? orbit.distance : 1;
    if (orbit.azimuth == 0 && orbit.elevation == 0 && distance == 1)
        return;
    Vec3 back = vec3_scale(vec3_subtract(*eye, center), distance), right;
    if (vec3_normalize(vec3_cross(*up, back), &right)) {
        const Vec3 axis = *up;
        if (orbit.elevation != 0) {
            *up = turn(vec3_cross(back, right), -orbit.elevation, right);
            back = turn(back, -orbit.elevation, right);
        }
        back = turn(back, orbit.azimuth, axis);
        *up = turn(*up, orbit.azimuth, axis);
    }
    *eye = vec3_add(center, back);
}
