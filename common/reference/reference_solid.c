/*
 * Of a convex solid a line cuts out a span: what lies between the two roots of a quadratic equation
 * (sphere, cylinder, cone), or between two planes, or in all such spans together (a box, a capped
 * cylinder). Its ends, with the parts that they lie on, are where the line meets the solid.
 *
 * Digits are kept by counting from the point of the line that is nearest to the solid's middle, or
 * to its axis or apex: there nothing cancels, however far away the origin is. A torus is a quartic,
 * of which polynomial_roots finds the roots, and Newton's steps on the distance from the ring
 * polish them.
 *
 * For shadows a segment often begins on the solid itself, and one root is then 0 but for rounding.
 * It is not computed but known: who knows which part the point lies on leaves that root out.
 */
#include "reference/reference_solid.h"

#include "shapes/mesh_solids.h"

/* What of a line lies within a convex solid, and through which parts it comes in and goes out. */
typedef struct Span {
    Real from, to;
    int entry, exit;
} Span;

enum { PART_OPEN = -1 }; /* there is no surface */

static const Span LINE = {-INFINITY, INFINITY, PART_OPEN, PART_OPEN};

/* Cuts a span to [from, to]. */
static void cut(Span *span, Real from, Real to, int entry, int exit)
{
    if (from > span->from) {
        span->from = from;
        span->entry = entry;
    }
    if (to < span->to) {
        span->to = to;
        span->exit = exit;
    }
}

static void cut_to_nothing(Span *span)
{
    span->to = -INFINITY;
}

/* What lies between two parallel planes, and the parts that those are. */
typedef struct Slab {
    Real low, high;
    int at_low, at_high;
} Slab;

/* Cuts to where low <= origin + t direction <= high in one coordinate. (Kay and Kajiya, Ray Tracing
 * Complex Scenes, SIGGRAPH 1986) */
static inline void cut_to_slab(Span *span, Real origin, Real direction, Slab slab)
{
    const Real low = slab.low - origin, high = slab.high - origin;
    if (direction > 0)
        cut(span, low / direction, high / direction, slab.at_low, slab.at_high);
    else if (direction < 0)
        cut(span, high / direction, low / direction, slab.at_high, slab.at_low);
    else if (origin < slab.low || origin > slab.high)
        cut_to_nothing(span);
}

/* From the point of the line that is nearest to the center, where nothing cancels. (Haines, Gunther
 * and Akenine-Moller, Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019)
 */
static void cut_to_sphere(Span *span, Real3 origin, Real3 direction, Real radius)
{
    const Real square = real3_dot(direction, direction);
    const Real nearest = -real3_dot(origin, direction) / square;
    const Real3 foot = real3_along(origin, nearest, direction);
    const Real half = (radius * radius - real3_dot(foot, foot)) / square;
    if (half < 0) {
        cut_to_nothing(span);
        return;
    }
    cut(span, nearest - real_sqrt(half), nearest + real_sqrt(half), PART_SIDE, PART_SIDE);
}

/* The same in the plane across the axis z. */
static void cut_to_tube(Span *span, Real3 origin, Real3 direction, Real radius)
{
    const Real square = direction.x * direction.x + direction.y * direction.y;
    if (!(square > 0)) {
        if (origin.x * origin.x + origin.y * origin.y > radius * radius)
            cut_to_nothing(span);
        return;
    }
    const Real nearest = -(origin.x * direction.x + origin.y * direction.y) / square;
    const Real moment = origin.x * direction.y - origin.y * direction.x;
    const Real half = (radius * radius - moment * moment / square) / square;
    if (half < 0) {
        cut_to_nothing(span);
        return;
    }
    cut(span, nearest - real_sqrt(half), nearest + real_sqrt(half), PART_SIDE, PART_SIDE);
}

/* Cuts to the half of the double cone x^2 + y^2 <= (slope w)^2 where w = height - z, the way down
 * from the apex, is not negative. */
static void cut_to_cone(Span *span, Real3 origin, Real3 direction, Real slope, Real height)
{
    /* From the point nearest to the apex, so that a far origin does not cost digits. */
    Real3 o = {origin.x, origin.y, origin.z - height};
    const Real nearest = -real3_dot(o, direction) / real3_dot(direction, direction);
    o = real3_along(o, nearest, direction);
    const Real down = -direction.z, k = slope * slope;
    const Real a = direction.x * direction.x + direction.y * direction.y - k * down * down;
    const Real b = o.x * direction.x + o.y * direction.y + k * o.z * down;
    const Real c = o.x * o.x + o.y * o.y - k * o.z * o.z;
    const Real discriminant = b * b - a * c;
    if (discriminant < 0) {
        cut_to_nothing(span);
        return;
    }
    /* Of the two roots of a s^2 + 2 b s + c, without cancellation. (Press et al., Numerical Recipes
     * in C, section 5.6) */
    const Real q = b > 0 ? -b - real_sqrt(discriminant) : -b + real_sqrt(discriminant);
    const Real one = a != 0 ? q / a : c / q, other = q != 0 ? c / q : one;
    const Real first = nearest + real_min(one, other), last = nearest + real_max(one, other);
    if (a > 0) {
        /* Between the roots; both are on the same half. */
        const Real middle = (first + last) / 2 - nearest;
        if (-o.z + middle * down < 0)
            cut_to_nothing(span);
        else
            cut(span, first, last, PART_SIDE, PART_SIDE);
    } else if (a < 0) {
        /* Outside the roots, the lower half of the cone being at the end where w grows. */
        if (down > 0)
            cut(span, last, INFINITY, PART_SIDE, PART_OPEN);
        else
            cut(span, -INFINITY, first, PART_OPEN, PART_SIDE);
    } else if (down > 0) { /* along the side: one root */
        cut(span, nearest + c / (-2 * b), INFINITY, PART_SIDE, PART_OPEN);
    } else {
        cut(span, -INFINITY, nearest + c / (-2 * b), PART_OPEN, PART_SIDE);
    }
}

static int plane_hits(const Solid *solid, Real3 origin, Real3 direction,
                      SolidHit hits[SOLID_MAX_HITS])
{
    if (!(direction.z != 0))
        return 0;
    const Real t = -origin.z / direction.z;
    const Real3 p = real3_along(origin, t, direction);
    const bool inside = solid->kind == SOLID_QUAD
                            ? real_abs(p.x) <= 1 && real_abs(p.y) <= 1
                            : p.x * p.x + p.y * p.y <= (Real)solid->radius * solid->radius;
    if (!inside)
        return 0;
    hits[0] = (SolidHit){t, PART_SIDE};
    return 1;
}

/* The torus: (|p|^2 + ring^2 - tube^2)^2 = 4 ring^2 (x^2 + y^2). (Hanrahan, in Glassner, An
 * Introduction to Ray Tracing, 1989, chapter 2) With s counted in lengths from the point of the
 * line nearest to the center, |p|^2 = |foot|^2 + s^2, and there is no cubic term. */

/* Near the surface of a thin tube the quartic is a small difference of large numbers; the distance
 * from the ring is not. Newton's step on (distance^2 - tube^2). */
static Real polish(Real ring, Real tube, Real3 foot, Real3 unit, Real s)
{
    for (int i = 0; i < 2; i++) {
        const Real3 p = real3_along(foot, s, unit);
        const Real across = real_sqrt(p.x * p.x + p.y * p.y), out = across - ring;
        const Real value = out * out + p.z * p.z - tube * tube;
        const Real slope = 2 * (out * (p.x * unit.x + p.y * unit.y) / across + p.z * unit.z);
        const Real step = value / slope;
        /* Where the line touches the surface the slope is no guide. */
        if (!(real_abs(step) < (Real)1e-6 * tube))
            break;
        s -= step;
    }
    return s;
}

static int torus_hits(const Solid *solid, Real3 origin, Real3 direction,
                      SolidHit hits[SOLID_MAX_HITS])
{
    const Real ring = solid->radius, tube = solid->tube;
    Span around = LINE;
    cut_to_slab(&around, origin.z, direction.z, (Slab){-tube, tube, PART_SIDE, PART_SIDE});
    cut_to_sphere(&around, origin, direction, ring + tube);
    if (!(around.from <= around.to))
        return 0;
    const Real length = real3_length(direction);
    const Real nearest = -real3_dot(origin, direction) / (length * length);
    const Real3 foot = real3_along(origin, nearest, direction);
    const Real3 unit = real3_scale(direction, 1 / length);
    const Real k = real3_dot(foot, foot) + (ring - tube) * (ring + tube);
    const Real factor = 4 * ring * ring;
    const Real c[5] = {k * k - factor * (foot.x * foot.x + foot.y * foot.y),
                       -2 * factor * (foot.x * unit.x + foot.y * unit.y),
                       2 * k - factor * (unit.x * unit.x + unit.y * unit.y), 0, 1};
    /* A little more, because the ends of the bracket may touch the surface. */
    const Real margin = tube / 1024;
    Real roots[SOLID_MAX_HITS];
    const int count = polynomial_roots(c, 4, (around.from - nearest) * length - margin,
                                       (around.to - nearest) * length + margin, roots);
    for (int i = 0; i < count; i++)
        hits[i] =
            (SolidHit){nearest + polish(ring, tube, foot, unit, roots[i]) / length, PART_SIDE};
    return count;
}

/* What of a line lies within a convex solid. */
static inline Span convex_span(const Solid *solid, Real3 origin, Real3 direction)
{
    const Real radius = solid->radius, height = solid->height;
    Span span = LINE;
    switch (solid->kind) {
    case SOLID_SPHERE:
        cut_to_sphere(&span, origin, direction, radius);
        break;
    case SOLID_BOX: /* front, right, up, left, down, back */
        cut_to_slab(&span, origin.x, direction.x, (Slab){-radius, radius, 3, 1});
        cut_to_slab(&span, origin.y, direction.y, (Slab){-radius, radius, 4, 2});
        cut_to_slab(&span, origin.z, direction.z, (Slab){-radius, radius, 5, 0});
        break;
    case SOLID_CYLINDER:
        cut_to_tube(&span, origin, direction, radius);
        cut_to_slab(&span, origin.z, direction.z,
                    (Slab){0, height, solid->caps & MESH_CAP_BOTTOM ? PART_BOTTOM : PART_OPEN,
                           solid->caps & MESH_CAP_TOP ? PART_TOP : PART_OPEN});
        break;
    case SOLID_CONE:
        cut_to_cone(&span, origin, direction, radius / height, height);
        cut_to_slab(&span, origin.z, direction.z, (Slab){0, INFINITY, PART_BOTTOM, PART_OPEN});
        break;
    default:
        cut_to_nothing(&span);
    }
    return span;
}

int ray_solid(const Solid *solid, Real3 origin, Real3 direction, SolidHit hits[SOLID_MAX_HITS])
{
    if (solid->kind == SOLID_TORUS)
        return torus_hits(solid, origin, direction, hits);
    if (solid->kind == SOLID_QUAD || solid->kind == SOLID_DISC)
        return plane_hits(solid, origin, direction, hits);
    const Span span = convex_span(solid, origin, direction);
    int count = 0;
    if (!(span.from <= span.to))
        return 0;
    if (span.entry != PART_OPEN)
        hits[count++] = (SolidHit){span.from, span.entry};
    if (span.exit != PART_OPEN)
        hits[count++] = (SolidHit){span.to, span.exit};
    return count;
}

static Real3 box_normal(int part)
{
    static const signed char normals[6][3] = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                              {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    return (Real3){normals[part][0], normals[part][1], normals[part][2]};
}

Real3 solid_normal(const Solid *solid, int part, Real3 p)
{
    const Real across = real_sqrt(p.x * p.x + p.y * p.y);
    if (solid->kind == SOLID_BOX)
        return box_normal(part);
    if (part == PART_BOTTOM)
        return (Real3){0, 0, -1};
    if (solid->kind == SOLID_SPHERE)
        return real3_unit(p);
    if (part == PART_TOP || solid->kind == SOLID_QUAD || solid->kind == SOLID_DISC || across == 0)
        return (Real3){0, 0, 1};
    const Real3 out = {p.x / across, p.y / across, 0};
    if (solid->kind == SOLID_CONE)
        return real3_unit((Real3){out.x * solid->height, out.y * solid->height, solid->radius});
    if (solid->kind == SOLID_TORUS)
        return real3_unit(real3_along(p, -(Real)solid->radius, out));
    return out;
}

/* Shadows. */

Real3 solid_project(const Solid *solid, int part, Real3 p)
{
    const Real radius = solid->radius, height = solid->height;
    const Real across = real_sqrt(p.x * p.x + p.y * p.y);
    if (solid->kind == SOLID_SPHERE)
        return real3_scale(real3_unit(p), radius);
    if (solid->kind == SOLID_BOX) {
        const Real3 n = box_normal(part);
        return (Real3){n.x != 0 ? n.x * radius : p.x, n.y != 0 ? n.y * radius : p.y,
                       n.z != 0 ? n.z * radius : p.z};
    }
    if (solid->kind == SOLID_TORUS) {
        const Real factor = across > 0 ? solid->radius / across : 0;
        const Real3 ring = {p.x * factor, p.y * factor, 0};
        return real3_along(ring, solid->tube, real3_unit(real3_subtract(p, ring)));
    }
    if (solid->kind == SOLID_QUAD || solid->kind == SOLID_DISC || part == PART_BOTTOM)
        return (Real3){p.x, p.y, 0};
    if (part == PART_TOP)
        return (Real3){p.x, p.y, height};
    /* The side of a cylinder or cone at the same height. */
    const Real z = real_max(0, real_min(p.z, height));
    const Real wanted = solid->kind == SOLID_CONE ? radius * (height - z) / height : radius;
    const Real factor = across > 0 ? wanted / across : 0;
    return (Real3){p.x * factor, p.y * factor, z};
}

/* How far outside a part's surface a point lies; by how much that may be wrong. */
typedef struct Outside {
    Real distance, error;
} Outside;

enum { MAX_PARTS = 6 };

static int outside_box(Real half, Real3 p, Real3 error, Outside outside[MAX_PARTS])
{
    const Real more = 4 * REAL_EPSILON * half;
    outside[0] = (Outside){p.z - half, error.z + more};
    outside[1] = (Outside){p.x - half, error.x + more};
    outside[2] = (Outside){p.y - half, error.y + more};
    outside[3] = (Outside){-p.x - half, error.x + more};
    outside[4] = (Outside){-p.y - half, error.y + more};
    outside[5] = (Outside){-p.z - half, error.z + more};
    return 6;
}

/* Fills in all parts of the solid's convex hull; a torus's surface; the plane and the border of a
 * square or disc. Returns their number. */
static int outside_parts(const Solid *solid, Real3 p, Real3 error, Outside outside[MAX_PARTS])
{
    const Real radius = solid->radius, height = solid->height;
    const Real across = real_sqrt(p.x * p.x + p.y * p.y);
    const Real sum = real3_reach(error) + 8 * REAL_EPSILON * (radius + height);
    switch (solid->kind) {
    case SOLID_SPHERE:
        outside[0] = (Outside){real3_length(p) - radius, sum};
        return 1;
    case SOLID_BOX:
        return outside_box(radius, p, error, outside);
    case SOLID_CONE: {
        const Real slant = real_sqrt(radius * radius + height * height);
        outside[PART_SIDE] = (Outside){(across * height - radius * (height - p.z)) / slant, sum};
        outside[PART_TOP] = (Outside){p.z - height, sum};
        outside[PART_BOTTOM] = (Outside){-p.z, error.z};
        return 3;
    }
    case SOLID_CYLINDER:
        outside[PART_SIDE] = (Outside){across - radius, sum};
        outside[PART_TOP] = (Outside){p.z - height, error.z + 4 * REAL_EPSILON * height};
        outside[PART_BOTTOM] = (Outside){-p.z, error.z};
        return 3;
    case SOLID_TORUS: {
        const Real out = across - radius;
        outside[0] = (Outside){real_sqrt(out * out + p.z * p.z) - solid->tube, sum};
        return 1;
    }
    case SOLID_DISC:
        outside[0] = (Outside){real_abs(p.z), error.z};
        outside[1] = (Outside){across - radius, sum};
        return 2;
    case SOLID_QUAD:
        outside[0] = (Outside){real_abs(p.z), error.z};
        outside[1] = (Outside){real_max(real_abs(p.x), real_abs(p.y)) - 1,
                               error.x + error.y + 4 * REAL_EPSILON};
        return 2;
    case SOLID_TEAPOT:
    case SOLID_NONE:
        break;
    }
    return 0;
}

uint32_t solid_touched(const Solid *solid, Real3 point, Real3 error)
{
    Outside outside[MAX_PARTS];
    const int count = outside_parts(solid, point, error, outside);
    uint32_t touched = 0;
    for (int i = 0; i < count; i++) {
        if (outside[i].distance > outside[i].error)
            return 0;
        if (real_abs(outside[i].distance) <= outside[i].error)
            touched |= (uint32_t)1 << i;
    }
    return touched;
}

static bool between_ends(Real t, Real end)
{
    return t > 0 && t < end;
}

/* Whether a line through a point on the hull of a convex solid lies outside of the solid on the
 * side of `way`. */
static bool goes_out(const Solid *solid, uint32_t touched, Real3 point, Real3 way)
{
    for (int part = 0; part < MAX_PARTS; part++)
        if (touched >> part & 1 && real3_dot(solid_normal(solid, part, point), way) >= 0)
            return true;
    return false;
}

static bool convex_blocks(const Solid *solid, const SolidSegment *segment)
{
    const Span span = convex_span(solid, segment->from, segment->way);
    const Real end = segment->endless ? INFINITY : 1;
    const bool entry = span.entry != PART_OPEN && between_ends(span.from, end);
    const bool exit = span.exit != PART_OPEN && between_ends(span.to, end);
    if (!(span.from <= span.to) || !(entry || exit))
        return false;
    const uint32_t touched = segment->touched | solid_touched(solid, segment->from, segment->error);
    const uint32_t at_light = segment->light_touched;
    if (touched && goes_out(solid, touched, segment->from, segment->way))
        return false;
    if (at_light && goes_out(solid, at_light, real3_add(segment->from, segment->way),
                             real3_scale(segment->way, -1)))
        return false;
    /* The ends that touch are the entry and the exit. */
    return (entry && !touched) || (exit && !at_light);
}

static bool plane_blocks(const Solid *solid, const SolidSegment *segment)
{
    SolidHit hits[SOLID_MAX_HITS];
    return plane_hits(solid, segment->from, segment->way, hits) > 0 &&
           between_ends(hits[0].t, segment->endless ? INFINITY : 1) && !segment->touched &&
           !segment->light_touched && !solid_touched(solid, segment->from, segment->error);
}

/* The quartic's other roots, on a line through a point of the torus: with q = |(x, y)| - ring the
 * terms that cancel there, q^2 + z^2 - tube^2, are left out. Counted from that point, in lengths.
 */
static void other_roots(const Solid *solid, Real3 p, Real3 unit, Real c[4])
{
    const Real ring = solid->radius, across = real_sqrt(p.x * p.x + p.y * p.y);
    const Real q = across - ring, along = real3_dot(p, unit);
    c[0] = 8 * ring * (q * (p.x * unit.x + p.y * unit.y) + across * p.z * unit.z);
    c[1] = 4 * (ring * q + along * along + ring * ring * unit.z * unit.z);
    c[2] = 4 * along;
    c[3] = 1;
}

static bool torus_blocks(const Solid *solid, const SolidSegment *segment)
{
    const Real ring = solid->radius, tube = solid->tube;
    const Real length = real3_length(segment->way), end = segment->endless ? INFINITY : length;
    const Real3 unit = real3_scale(segment->way, 1 / length);
    const Real margin = tube / 1024;
    Span around = LINE;
    cut_to_slab(&around, segment->from.z, unit.z, (Slab){-tube, tube, PART_SIDE, PART_SIDE});
    cut_to_sphere(&around, segment->from, unit, ring + tube);
    if (!(around.from <= around.to) || around.to < -margin || around.from > end + margin)
        return false;
    const bool touched = segment->touched || solid_touched(solid, segment->from, segment->error);
    Real roots[SOLID_MAX_HITS];
    int count = 0, nearest = -1;
    if (touched) {
        Real c[4];
        other_roots(solid, segment->from, unit, c);
        count = polynomial_roots(c, 3, 0, around.to + margin, roots);
    } else {
        SolidHit hits[SOLID_MAX_HITS];
        count = torus_hits(solid, segment->from, unit, hits);
        for (int i = 0; i < count; i++)
            roots[i] = hits[i].t;
    }
    for (int i = 0; i < count && segment->light_touched; i++)
        if (nearest < 0 || real_abs(roots[i] - end) < real_abs(roots[nearest] - end))
            nearest = i; /* the light's own */
    for (int i = 0; i < count; i++)
        if (i != nearest && between_ends(roots[i], end))
            return true;
    return false;
}

bool solid_blocks(const Solid *solid, const SolidSegment *segment)
{
    if (solid->kind == SOLID_TORUS)
        return torus_blocks(solid, segment);
    if (solid->kind == SOLID_QUAD || solid->kind == SOLID_DISC)
        return plane_blocks(solid, segment);
    return convex_blocks(solid, segment);
}
