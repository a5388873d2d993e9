/*
 * reference_explain: the lighting equation at a point of the picture, term by term.
 *
 * Space: the axes are the world's.
 */
#ifndef REFERENCE_EXPLAIN_H
#define REFERENCE_EXPLAIN_H

#include "reference/reference_trace.h"

/* What one light that is on adds: share (ambient + diffuse + specular), of which a shadow leaves
 * the ambient. */
typedef struct ExplainLight {
    const Light *light;     /* the scene's */
    Vec3 direction, mirror; /* unit: L; R, or H where the reflection is Blinn's */
    double share;           /* what arrives by attenuation and cone */
    double n_dot_l, cosine; /* cosine: R.V or N.H; neither below 0, unless dots are signed */
    bool hidden, outside;   /* in a shadow; of the cone */
    Vec3 ambient, diffuse, specular;
} ExplainLight;

typedef struct Explained {
    Material material;
    Vec3 position, normal, viewer; /* seen from the eye; unit: N, V */
    double depth;                  /* as in Sample */
    Vec3 base;                     /* emission and global ambient light */
    ExplainLight *lights;
    int count;
    bool phong; /* R.V */
} Explained;

/* At x, y as in trace_sample. False: no surface is lit there; to be closed all the same. */
bool explain_open(Explained *explained, const Trace *trace, double x, double y);
void explain_close(Explained *explained);

#endif
