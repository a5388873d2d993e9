/* Two angles and a distance, applied to the camera of the scene. */
#include "core/orbit.h"

#include "base/parse.h"

#include <stdio.h>

double orbit_distance(Orbit orbit)
{
    return orbit.distance > 0 ? orbit.distance : 1;
}

static bool moves(Orbit orbit)
{
    return orbit.azimuth != 0 || orbit.elevation != 0 || orbit_distance(orbit) != 1;
}

static Vec3 turn(Vec3 vector, double degrees, Vec3 axis)
{
    return mat4_transform_direction(mat4_rotate(degrees, axis), vector);
}

void orbit_move(Orbit orbit, Vec3 *eye, Vec3 center, Vec3 *up)
{
    if (!moves(orbit))
        return;
    Vec3 back = vec3_scale(vec3_subtract(*eye, center), orbit_distance(orbit)), right;
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

bool orbit_text(Orbit orbit, char text[96])
{
    char azimuth[32], elevation[32], distance[32];
    const bool near = orbit_distance(orbit) == 1;
    text[0] = '\0';
    if (!moves(orbit))
        return false;
    parse_number_text(orbit.azimuth, azimuth);
    parse_number_text(orbit.elevation, elevation);
    parse_number_text(orbit_distance(orbit), distance);
    snprintf(text, 96, "%s,%s%s%s", azimuth, elevation, near ? "" : ",", near ? "" : distance);
    return true;
}
