/*
 * A sample keeps more than its color: which smooth surface was seen, from which side, and on which
 * side of each jump of the light the point lies. Samples that agree in all of that, have like
 * colors, and lie in each other's tangent planes are taken for one smooth surface; whether a pixel
 * has an edge is decided by nothing else.
 */
#include "reference/reference_trace.h"

uint32_t trace_pixel_lights(const Sample *const rows[3])
{
    uint32_t lights = 0;
    for (int row = 0; row < 3; row++)
        for (int i = 0; i < 3; i++)
            lights |= rows[row][i].object == rows[1][1].object ? rows[row][i].lights : 0;
    return lights;
}

/* A smooth surface's chord is nearly perpendicular to the mean of the normals at its ends: on a
 * circle exactly, elsewhere but for the third power of its length. A jump in depth is along the
 * view. */
static bool in_tangent_planes(const Sample *a, const Sample *b)
{
    const Real3 chord = real3_subtract(real3(b->position), real3(a->position));
    const Real out = real3_dot(chord, real3_add(real3(a->normal), real3(b->normal)));
    return out * out <= (Real)0.0025 * real3_dot(chord, chord);
}

/* Whether triangles hang together smoothly: by an edge, with its normals; else not where a crease
 * is between them; else by a corner at which they are not folded, or as far as their planes tell.
 */
static bool joined(const Triangles *triangles, const Sample *a, const Sample *b)
{
    const TrianglesShare share = triangles_share(triangles, a->triangle, b->triangle);
    if (share.corners >= 2 || share.places > share.corners)
        return share.corners >= 2;
    return real3_dot(real3(a->normal), real3(b->normal)) > (Real)0.7 &&
           (share.corners == 1 || in_tangent_planes(a, b));
}

static bool like_colors(const Sample *a, const Sample *b)
{
    for (int k = 0; k < 3; k++)
        if (fabsf(a->color[k] - b->color[k]) > 0.0625F)
            return false;
    return true;
}

bool trace_same_side(const Sample *a, const Sample *b)
{
    return a->object == b->object && a->piece == b->piece && a->front == b->front &&
           a->clipped == b->clipped &&
           ((a->sides ^ b->sides) & (a->sides_matter | b->sides_matter)) == 0;
}

bool trace_agree(const Trace *trace, const Sample *a, const Sample *b)
{
    if (!trace_same_side(a, b))
        return false;
    if (a->object < 0)
        return true;
    const TraceObject *ready = trace_object(trace, a->object);
    if (!like_colors(a, b))
        return false;
    if (!ready->exact)
        return joined(&ready->triangles, a, b);
    /* Of all solids only a torus lies before itself with the same side outwards. */
    return ready->object->solid.kind != SOLID_TORUS || in_tangent_planes(a, b);
}
