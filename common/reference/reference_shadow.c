/* The rules are told in reference_shadow.h; here they are bounds of errors, in the coordinates of
 * the object that is asked. */
#include "reference/reference_shadow.h"

#include "reference/reference_solid.h"

#include <stdlib.h>

/* So many roundings of a coordinate are the error of another that was computed from it. */
static const Real ROUNDINGS = 32 * REAL_EPSILON;

static Real3 to_local(const TraceObject *ready, Real3 v)
{
    return (Real3){real3_dot(ready->inverse[0], v), real3_dot(ready->inverse[1], v),
                   real3_dot(ready->inverse[2], v)};
}

/* The error in object coordinates of a point computed from coordinates of this size. */
static Real3 local_error(const TraceObject *ready, Real reach)
{
    const Real error = ROUNDINGS * (reach + real3_reach(ready->offset));
    return (Real3){error * real3_reach(ready->inverse[0]), error * real3_reach(ready->inverse[1]),
                   error * real3_reach(ready->inverse[2])};
}

static ShadowEnd light_end(const TraceObject *ready, const ShadeLight *light)
{
    if (light->light->kind == LIGHT_DIRECTIONAL)
        return (ShadowEnd){to_local(ready, light->direction), 0};
    ShadowEnd end = {to_local(ready, real3_subtract(light->position, ready->offset)), 0};
    end.touched = solid_touched(&ready->object->solid, end.place,
                                local_error(ready, real3_reach(light->position)));
    return end;
}

bool shadows_open(Shadows *shadows, const TraceObject *objects, int object_count,
                  const ShadeLight *lights, int light_count)
{
    const size_t count = (size_t)object_count * (size_t)light_count;
    *shadows = (Shadows){objects, object_count, lights, light_count,
                         malloc((count + 1) * sizeof *shadows->ends)};
    if (!shadows->ends)
        return false;
    for (int i = 0; i < object_count; i++)
        for (int k = 0; k < light_count && objects[i].exact; k++)
            shadows->ends[i * light_count + k] = light_end(&objects[i], &lights[k]);
    return true;
}

void shadows_close(Shadows *shadows)
{
    free(shadows->ends);
    *shadows = (Shadows){.ends = NULL};
}

static Real3 turned_to(Real3 normal, Real3 side)
{
    return real3_scale(normal, real3_dot(normal, side) < 0 ? -1 : 1);
}

ShadowPoint shadow_start_solid(const Shadows *shadows, int object, int part, Real3 local,
                               Real3 geometric, Real3 shading)
{
    const TraceObject *ready = &shadows->objects[object];
    ShadowPoint point = {.shadows = shadows, .object = object, .part = part};
    point.normal = turned_to(geometric, shading);
    point.local = solid_project(&ready->object->solid, part, local);
    point.from = trace_object_place(ready, point.local);
    point.reach = real3_reach(point.from) + real3_reach(ready->offset);
    return point;
}

/* On the surface that smooth normals suggest: moved out of the tangent planes of the corners.
 * (Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021, chapter 4) */
static Real3 rounded(const TraceObject *ready, const uint32_t *indices, const Real weights[3],
                     Real3 shading, Real3 place)
{
    Real3 moved = place;
    for (int k = 0; k < 3; k++) {
        const Real3 normal = ready->normals[indices[k]];
        const Real height = real3_dot(real3_subtract(place, ready->points[indices[k]]), normal);
        if (real3_dot(normal, shading) < 0 ? height > 0 : height < 0)
            moved = real3_along(moved, -height * weights[k], normal);
    }
    return moved;
}

ShadowPoint shadow_start_triangle(const Shadows *shadows, int object, uint32_t triangle,
                                  const Real weights[3], Real3 geometric, Real3 shading)
{
    const TraceObject *ready = &shadows->objects[object];
    const uint32_t *indices =
        ready->mesh->indices + 3 * (size_t)ready->triangles.triangles[triangle].number;
    const Real3 *v = ready->points;
    ShadowPoint point = {.shadows = shadows, .object = object, .triangle = triangle};
    point.normal = turned_to(geometric, shading);
    /* By weights, not by the length of the ray: in the triangle's plane, at any angle. */
    point.from =
        real3_along(real3_along(real3_scale(v[indices[0]], weights[0]), weights[1], v[indices[1]]),
                    weights[2], v[indices[2]]);
    point.reach = real3_reach(v[indices[0]]) + real3_reach(v[indices[1]]) +
                  real3_reach(v[indices[2]]) + real3_reach(ready->offset);
    if (ready->smooth) {
        point.normal = shading;
        point.from = rounded(ready, indices, weights, shading, point.from);
    }
    return point;
}

/* Whether both ends of a segment surely lie on the same side of a plane. */
static bool beside_plane(const TraceObject *ready, const ShadowPoint *point, Real3 way,
                         bool endless)
{
    const Real3 up = ready->inverse[2];
    const Real height = real3_dot(up, real3_subtract(point->from, ready->offset));
    const Real steps = real3_dot(up, way);
    const Real error = ROUNDINGS * real3_reach(up) *
                       (point->reach + real3_reach(ready->offset) + real3_reach(way));
    const Real other = endless ? steps : height + steps, margin = endless ? 0 : error;
    return height > error ? other > margin : height < -error && other < -margin;
}

static bool solid_between(const ShadowPoint *point, int number, int light, Real3 way)
{
    const Shadows *shadows = point->shadows;
    const TraceObject *ready = &shadows->objects[number];
    const bool endless = shadows->lights[light].light->kind == LIGHT_DIRECTIONAL;
    if ((ready->object->solid.kind == SOLID_QUAD || ready->object->solid.kind == SOLID_DISC) &&
        (number == point->object || beside_plane(ready, point, way, endless)))
        return false;
    const ShadowEnd *end = &shadows->ends[number * shadows->light_count + light];
    SolidSegment segment = {.way = end->place, .light_touched = end->touched};
    segment.endless = endless;
    if (number == point->object) {
        segment.from = point->local;
        segment.touched = (uint32_t)1 << point->part;
    } else {
        segment.from = to_local(ready, real3_subtract(point->from, ready->offset));
        segment.error = local_error(ready, point->reach);
    }
    if (!segment.endless)
        segment.way = real3_subtract(end->place, segment.from);
    return solid_blocks(&ready->object->solid, &segment);
}

static bool triangles_between(const ShadowPoint *point, int number, int light, Real3 way)
{
    const TraceObject *ready = &point->shadows->objects[number];
    const ShadeLight *shade = &point->shadows->lights[light];
    const Real offset = real3_reach(ready->offset);
    const TriangleSegment segment = {
        .from = point->from,
        .way = way,
        .endless = shade->light->kind == LIGHT_DIRECTIONAL,
        .own = number == point->object ? point->triangle : TRIANGLES_NONE,
        .error = ROUNDINGS * (point->reach + offset),
        .light_error = ROUNDINGS * (real3_reach(shade->position) + point->reach + offset)};
    return triangles_block(&ready->triangles, &segment);
}

bool shadow_falls(const ShadowPoint *point, int light)
{
    const Shadows *shadows = point->shadows;
    const ShadeLight *shade = &shadows->lights[light];
    const bool endless = shade->light->kind == LIGHT_DIRECTIONAL;
    const Real3 way = endless ? shade->direction : real3_subtract(shade->position, point->from);
    const bool convex = object_is_convex(shadows->objects[point->object].object);
    if (!convex && !(real3_dot(point->normal, way) > 0))
        return true;
    for (int i = 0; i < shadows->object_count; i++)
        if (shadows->objects[i].object->lamp || (convex && i == point->object) ||
            ball_missed(&shadows->objects[i].ball, point->from, way, endless))
            continue;
        else if (shadows->objects[i].exact ? solid_between(point, i, light, way)
                                           : triangles_between(point, i, light, way))
            return true;
    return false;
}

/* At a shadow's edge all that arrives would change; outside the light's cone nothing does, but at
 * the cone's edge, about which the points inside tell. */
static void add_shadowed(const ShadowPoint *start, int number, const LightSample *sample,
                         Real3 *color, ShadeSides *sides)
{
    const Real arriving = shade_arriving(sample);
    const bool hidden = arriving > 0 && shadow_falls(start, number);
    const Real3 left = hidden ? sample->ambient : sample->sum;
    const bool in_cone = sample->in_cone;
    if (arriving > 0)
        shade_note_light(sides, number, hidden);
    shade_note_side(sides, 2 * number + 1, in_cone && sample->faces && !hidden,
                    hidden    ? arriving
                    : in_cone ? sample->highlight
                              : 0);
    shade_note_side(sides, 2 * number, in_cone, in_cone ? real3_largest(left) : 0);
    if (in_cone)
        *color = real3_add(*color, left);
}

Real3 shadow_shade(const Shading *shading, const ShadePoint *point, const ShadowPoint *start,
                   ShadeSides *sides)
{
    Real3 color = shade_base(shading, point);
    *sides = (ShadeSides){.bits = 0};
    for (int i = 0; i < shading->light_count; i++) {
        const LightSample sample = shade_light(shading, point, i);
        if (shading->lights[i].light->shadows)
            add_shadowed(start, i, &sample, &color, sides);
        else
            shade_add(shading, i, &sample, &color, sides);
    }
    return color;
}
