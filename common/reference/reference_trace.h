/*
 * reference_trace: what a ray from the eye through one point of the picture sees, and its color.
 *
 * The whole of what a pixel's exactness rests on; how pixels are made of such samples is in
 * reference_pixel.h.
 */
#ifndef REFERENCE_TRACE_H
#define REFERENCE_TRACE_H

#include "reference/reference.h"
#include "reference/reference_object.h"
#include "reference/reference_real.h"
#include "scene/scene.h"

#include <stdint.h>

typedef struct Trace Trace;

/* Prepares a scene that has passed scene_check. Of the options are used: the picture's size,
 * `meshes`, `threads` (at least 1) and `stop`. A trace may be used by several threads. */
bool trace_open(Trace **trace, const Scene *scene, const ReferenceOptions *options,
                Message *message);
void trace_close(Trace *trace); /* NULL is fine */

/* What is seen at one point. Space: the axes are the world's, the origin is the eye. */
typedef struct Sample {
    int object;        /* -1: the background; the rest is then 0, but for the color */
    uint32_t piece;    /* which of its smooth surfaces */
    uint32_t triangle; /* its place in the hierarchy, where the object has triangles */
    bool front;
    bool clipped;                 /* painted magenta */
    uint32_t sides, sides_matter; /* see ShadeSides */
    uint32_t lights;              /* the same: which of those that cast shadows reach it */
    float color[3];               /* as in Reference */
    double linear[3];             /* the same before it is rounded to float, and encoded */
    double depth;                 /* as in Reference; INFINITY for the background */
    Vec3 position, normal;        /* the normal is the surface's own, a unit vector */
} Sample;

/* x in 0..width from the left, y in 0..height from the top, in pixels. */
void trace_sample(const Trace *trace, double x, double y, Sample *sample);

/* What is lit there, and by what. False: nothing, or light is computed at corners. */
typedef struct TracePoint {
    const Shading *shading;
    Material material;
    ShadePoint point; /* points at the material */
} TracePoint;
bool trace_point(const Trace *trace, double x, double y, TracePoint *point);

/* Where in the picture a position before the eye, as in Sample, is seen. */
void trace_place(const Trace *trace, Vec3 position, double at[2]);

const TraceObject *trace_object(const Trace *trace, int number);

/* Whether a light of the scene casts shadows. */
bool trace_casts(const Trace *trace);

/* Sample.lights of the nine samples of a pixel, three of each row of its grid, together: of those
 * on the object at its center. */
uint32_t trace_pixel_lights(const Sample *const rows[3]);

/* Whether two samples agree in whatever is discrete: object, face, front or back, and the sides of
 * the jumps of light. */
bool trace_same_side(const Sample *a, const Sample *b);

/* Whether two samples near each other lie on one smooth surface, lit smoothly, as far as can be
 * told from them: they are on the same side, their colors lie within 1/16, and each lies
 * in the other's tangent plane, or on a triangle next to it. */
bool trace_agree(const Trace *trace, const Sample *a, const Sample *b);

#endif
