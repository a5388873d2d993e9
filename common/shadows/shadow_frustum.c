/*
 * A map's texels are few, so it should show what casts and receives, and nothing else. Corners of
 * boxes are projected from the light, those of casters and those of receivers; the map covers what
 * both have in common across the view, and in depth what casts. A light that shines in all
 * directions gets one frustum if that sees all casters, or else the faces of a cube that any lie
 * in.
 */
#include "shadows/shadow_frustum.h"

#include <math.h>

static const double WIDEST = 2;        /* tangent of half the angle that one frustum sees */
static const double CUBE_REACH = 1.02; /* of a face: they overlap, for bias */
static const double NEAREST = 1e-4;    /* near over far, at least */

/* Ranges in x, y (tangents in perspective) and depth. */
typedef struct Seen {
    double low[3], high[3];
    bool any;
} Seen;

static Seen seen_nothing(void)
{
    return (Seen){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
}

static Vec3 corner_of(const PlacedBox *box, int corner)
{
    Vec3 point = box->center;
    for (int i = 0; i < 3; i++)
        point = vec3_add(point, vec3_scale(box->half[i], corner >> i & 1 ? 1 : -1));
    return point;
}

/* No point of a box is nearer to the light along its view: the largest distance of the box from it
 * along one of the box's sides. What lies beside the frustum does not count. */
static double least_depth(const ShadowFrustum *frustum, const PlacedBox *box, double reach)
{
    const Vec3 center = mat4_transform_point(frustum->light_from_world, box->center);
    double distance = 0;
    for (int k = 0; k < 3; k++) {
        Vec3 way;
        if (!vec3_normalize(vec3_cross(box->half[k], box->half[(k + 1) % 3]), &way))
            continue;
        const double from =
            vec3_dot(center, mat4_transform_direction(frustum->light_from_world, way));
        distance = fmax(distance, fabs(from) - placed_reach(box, way));
    }
    return distance / sqrt(1 + 2 * reach * reach);
}

/* Adds what of a box lies in the frustum. A box that reaches behind the light fills its view. */
static void see_box(Seen *seen, const ShadowFrustum *frustum, const PlacedBox *box, double reach)
{
    int beyond[5] = {0};
    bool behind = false;
    Seen own = seen_nothing();
    for (int c = 0; c < 8; c++) {
        const Vec3 p = mat4_transform_point(frustum->light_from_world, corner_of(box, c));
        const double depth = -p.z, share = frustum->perspective ? 1 / depth : 1;
        const double at[3] = {p.x * share, p.y * share, depth};
        if (frustum->perspective) {
            const bool out[5] = {p.x > reach * depth, -p.x > reach * depth, p.y > reach * depth,
                                 -p.y > reach * depth, depth <= 0};
            for (int k = 0; k < 5; k++)
                beyond[k] += out[k];
            behind |= depth <= 0;
        }
        for (int k = 0; k < 3; k++) {
            own.low[k] = fmin(own.low[k], at[k]);
            own.high[k] = fmax(own.high[k], at[k]);
        }
    }
    for (int k = 0; k < 5; k++)
        if (beyond[k] == 8)
            return;
    if (frustum->perspective)
        own.low[2] = fmax(own.low[2], least_depth(frustum, box, reach));
    for (int k = 0; k < 2 && frustum->perspective; k++) {
        own.low[k] = behind ? -reach : fmax(own.low[k], -reach);
        own.high[k] = behind ? reach : fmin(own.high[k], reach);
    }
    for (int k = 0; k < 3; k++) {
        seen->low[k] = fmin(seen->low[k], own.low[k]);
        seen->high[k] = fmax(seen->high[k], own.high[k]);
    }
    seen->any = true;
}

static Seen see(const ShadowFrustum *frustum, const ShadowFitting *fitting, const uint32_t *which,
                double reach)
{
    Seen seen = seen_nothing();
    for (int i = 0; i < fitting->count; i++)
        if (which[i] >> fitting->number & 1)
            see_box(&seen, frustum, &fitting->boxes[i], reach);
    return seen;
}

/* False: nothing that casts and receives is seen. */
static bool fit(ShadowFrustum *frustum, const ShadowFitting *fitting, double reach, int size)
{
    const Seen casts = see(frustum, fitting, fitting->throws, reach);
    const Seen receives = see(frustum, fitting, fitting->receives, reach);
    double low[2], high[2];
    if (!casts.any || !receives.any)
        return false;
    for (int k = 0; k < 2; k++) {
        low[k] = fmax(casts.low[k], receives.low[k]);
        high[k] = fmin(casts.high[k], receives.high[k]);
    }
    frustum->width = fmax(high[0] - low[0], high[1] - low[1]);
    if (!(frustum->width > 0) || !(high[0] >= low[0]) || !(high[1] >= low[1]))
        return false;
    for (int k = 0; k < 2; k++) { /* one that is seen edge on is thin */
        const double pad = fmax(2.0 / size * (high[k] - low[k]), 1e-3 * frustum->width);
        low[k] -= pad;
        high[k] += pad;
    }
    frustum->width = fmax(high[0] - low[0], high[1] - low[1]);
    const double pad = 1e-3 * (casts.high[2] - casts.low[2]) + 1e-6 * fabs(casts.high[2]);
    const double far = frustum->far = casts.high[2] + pad;
    const double near = frustum->near =
        frustum->perspective ? fmax(casts.low[2] - pad, NEAREST * far) : casts.low[2] - pad;
    return frustum->perspective
               ? mat4_try_frustum((MatrixSides){low[0] * near, high[0] * near, low[1] * near,
                                                high[1] * near, near, far},
                                  &frustum->map_from_light)
               : mat4_try_ortho((MatrixSides){low[0], high[0], low[1], high[1], near, far},
                                &frustum->map_from_light);
}

/* Looks from the light along an axis. */
static ShadowFrustum look(Vec3 from, Vec3 axis, bool perspective)
{
    const double x = fabs(axis.x), y = fabs(axis.y), z = fabs(axis.z);
    const Vec3 up = {x < y && x < z, x >= y && y < z, (x >= z && y >= z) || (x < y && x >= z)};
    return (ShadowFrustum){.light_from_world = mat4_look_at(from, vec3_add(from, axis), up),
                           .perspective = perspective};
}

/* Of what casts. */
static Vec3 middle_of(const ShadowFitting *fitting)
{
    Vec3 sum = {0, 0, 0};
    int count = 0;
    for (int i = 0; i < fitting->count; i++) {
        if (!(fitting->throws[i] >> fitting->number & 1))
            continue;
        sum = vec3_add(sum, fitting->boxes[i].center);
        count++;
    }
    return vec3_scale(sum, 1.0 / (count ? count : 1));
}

/* Whether what casts is within the angle that one frustum sees. */
static bool sees_all(const ShadowFrustum *frustum, const ShadowFitting *fitting)
{
    for (int i = 0; i < fitting->count; i++)
        for (int c = 0; c < 8 && fitting->throws[i] >> fitting->number & 1; c++) {
            const Vec3 p =
                mat4_transform_point(frustum->light_from_world, corner_of(&fitting->boxes[i], c));
            if (!(fmax(fabs(p.x), fabs(p.y)) < -WIDEST * p.z))
                return false;
        }
    return true;
}

int shadow_frusta(const ShadowFitting *fitting, int size, ShadowFrustum frusta[SHADOW_FACES])
{
    const Vec3 place = {fitting->light.x, fitting->light.y, fitting->light.z};
    const Vec3 middle = middle_of(fitting);
    Vec3 axis;
    int count = 0;
    if (fitting->light.w == 0) {
        frusta[0] = look(middle, vec3_scale(vec3_unit(place), -1), false);
        return fit(&frusta[0], fitting, INFINITY, size);
    }
    if (vec3_normalize(fitting->axis, &axis) && fitting->reach <= WIDEST) {
        frusta[0] = look(place, axis, true);
        return fit(&frusta[0], fitting, fitting->reach, size);
    }
    if (!vec3_normalize(vec3_subtract(middle, place), &axis))
        axis = (Vec3){0, -1, 0};
    const ShadowFrustum first = look(place, axis, true);
    if (sees_all(&first, fitting)) {
        frusta[0] = first;
        return fit(&frusta[0], fitting, WIDEST, size);
    }
    for (int i = 0; i < SHADOW_FACES; i++) {
        const double *m = first.light_from_world.m;
        const Vec3 row = {m[i / 2], m[4 + i / 2], m[8 + i / 2]};
        frusta[count] = look(place, vec3_scale(row, i % 2 ? -1 : 1), true);
        count += fit(&frusta[count], fitting, CUBE_REACH, size);
    }
    return count;
}

double shadow_depth_step(const ShadowFrustum *frustum, int bits, double distance)
{
    const double near = frustum->near, far = frustum->far, step = (far - near) * exp2(-bits);
    return frustum->perspective ? step * distance * distance / (far * near) : step;
}
