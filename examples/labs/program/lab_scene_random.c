/* Rejection: what is drawn by lot is drawn again until it is what was asked for. */
#include "labs/program/lab_scene_parts.h"

#include <math.h>

Vec3 random_color(Random *random, double min, double max)
{
    Vec3 color;
    const double step = 0.12 * (max - min);
    do {
        color.x = random_between(random, min, max);
        color.y = random_between(random, min, max);
        color.z = random_between(random, min, max);
    } while (fabs(color.x - color.y) < step || fabs(color.y - color.z) < step ||
             fabs(color.z - color.x) < step);
    return color;
}

Vec3 random_direction(Random *random)
{
    const double z = random_between(random, -1, 1), a = random_between(random, 0, 2 * acos(-1));
    const double r = sqrt(1 - z * z);
    return (Vec3){r * cos(a), r * sin(a), z};
}

Vec3 random_near(Random *random, Vec3 axis, double min, double max)
{
    Vec3 direction;
    double angle;
    vec3_normalize(axis, &axis);
    do {
        direction = random_direction(random);
        angle = acos(vec3_dot(direction, axis)) * 180 / acos(-1);
    } while (!(angle >= min && angle <= max));
    return direction;
}

bool random_chance(Random *random)
{
    return random_between(random, 0, 1) < 0.5;
}

double random_signed(Random *random, double min, double max)
{
    const double size = random_between(random, min, max);
    return random_chance(random) ? size : -size;
}
