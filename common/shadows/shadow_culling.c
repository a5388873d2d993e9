/*
 * A caster's shadow falls on a receiver only if the caster meets the hull of the receiver and the
 * light: a pyramid over the receiver's box, or for parallel light a prism. Two convex sets do not
 * meet if a plane lies between them. The sides of the boxes are tried first, which mostly settles
 * it; else Gilbert's algorithm looks for the plane. What it does not find in 64 steps counts as
 * meeting, so that a shadow may be drawn in vain, but none is missing.
 */
#include "shadows/shadow_culling.h"

#include <math.h>

static const double TOUCHES = 1e-6; /* of the boxes' sizes: floats of meshes are off by less */

PlacedBox placed_box(const MeshBox *box, Mat4 world_from_object)
{
    const Vec3 half = vec3_scale(vec3_subtract(box->high, box->low), 0.5);
    const Vec3 ways[3] = {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}};
    PlacedBox placed = {.center =
                            mat4_transform_point(world_from_object, vec3_add(box->low, half))};
    for (int i = 0; i < 3; i++)
        placed.half[i] = mat4_transform_direction(world_from_object, ways[i]);
    return placed;
}

double placed_reach(const PlacedBox *box, Vec3 way)
{
    return fabs(vec3_dot(box->half[0], way)) + fabs(vec3_dot(box->half[1], way)) +
           fabs(vec3_dot(box->half[2], way));
}

double placed_size(const PlacedBox *box)
{
    return vec3_length(box->half[0]) + vec3_length(box->half[1]) + vec3_length(box->half[2]);
}

/* The convex hull of a box and of where its segments to the light end. */
typedef struct Hull {
    const PlacedBox *box;
    bool has_end;
    Vec3 end;   /* the light */
    Vec3 sweep; /* or, for a directional one, the way beyond the occluder; zero: none */
} Hull;

/* The point of the hull that lies least far along `way`. */
static Vec3 least(const Hull *hull, Vec3 way)
{
    Vec3 point = hull->box->center;
    for (int i = 0; i < 3; i++)
        point = vec3_add(
            point, vec3_scale(hull->box->half[i], vec3_dot(hull->box->half[i], way) > 0 ? -1 : 1));
    if (vec3_dot(hull->sweep, way) < 0)
        point = vec3_add(point, hull->sweep);
    return hull->has_end && vec3_dot(hull->end, way) < vec3_dot(point, way) ? hull->end : point;
}

/* Whether the box lies on one side of a plane and the hull on the other. They may touch, but the
 * light is not in the box. */
static bool plane_separates(const PlacedBox *box, const Hull *hull, Vec3 normal)
{
    const double touches = TOUCHES * (placed_size(box) + placed_size(hull->box));
    Vec3 way;
    if (!vec3_normalize(normal, &way))
        return false;
    if (vec3_dot(way, vec3_subtract(hull->box->center, box->center)) < 0)
        way = vec3_scale(way, -1);
    const double most = placed_reach(box, way);
    const double from = vec3_dot(way, vec3_subtract(hull->box->center, box->center));
    return from - placed_reach(hull->box, way) >= most - touches &&
           vec3_dot(way, hull->sweep) >= 0 &&
           (!hull->has_end || vec3_dot(way, vec3_subtract(hull->end, box->center)) >= most);
}

/* Looks for the point of the differences of two convex sets that is nearest to the origin; whether
 * a plane on the way shows that it is not the origin. (Gilbert, An iterative procedure for
 * computing the minimum of a quadratic form on a convex set, SIAM J. Control 4, 1966) */
static bool search_separates(const PlacedBox *box, const Hull *hull)
{
    enum { STEPS = 64 };
    const Hull other = {.box = box};
    const double touches = TOUCHES * (placed_size(box) + placed_size(hull->box));
    Vec3 nearest = vec3_subtract(hull->box->center, box->center);
    for (int step = 0; step < STEPS; step++) {
        const double length = vec3_length(nearest);
        if (!(length > touches))
            return false;
        const Vec3 way = vec3_scale(nearest, 1 / length);
        const Vec3 support = vec3_subtract(least(hull, way), least(&other, vec3_scale(way, -1)));
        if (vec3_dot(support, way) > touches)
            return true;
        const Vec3 move = vec3_subtract(support, nearest);
        const double square = vec3_dot(move, move);
        if (square == 0)
            return false;
        const double t = fmin(fmax(-vec3_dot(nearest, move) / square, 0), 1);
        nearest = vec3_add(nearest, vec3_scale(move, t));
    }
    return false;
}

static bool separated(const PlacedBox *box, const Hull *hull)
{
    const PlacedBox *boxes[2] = {box, hull->box};
    for (int b = 0; b < 2; b++)
        for (int i = 0; i < 3; i++)
            if (plane_separates(box, hull,
                                vec3_cross(boxes[b]->half[i], boxes[b]->half[(i + 1) % 3])))
                return true;
    return search_separates(box, hull);
}

bool may_come_between(const PlacedBox *occluder, const PlacedBox *receiver, Vec4 light)
{
    const Vec3 place = {light.x, light.y, light.z};
    Vec3 way;
    if (light.w != 0)
        return !separated(occluder, &(Hull){.box = receiver, .has_end = true, .end = place});
    if (!vec3_normalize(place, &way))
        return true;
    const double beyond = vec3_dot(way, vec3_subtract(occluder->center, receiver->center)) +
                          placed_reach(occluder, way) + placed_reach(receiver, way);
    if (beyond <= 0)
        return false;
    return !separated(occluder, &(Hull){.box = receiver, .sweep = vec3_scale(way, beyond)});
}
