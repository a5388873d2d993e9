/*
 * probe: the scenes in which a submission is drawn, each made to reveal other mistakes. No GL.
 *
 *   A  the lab's own scene, as its program draws it
 *   B  turned, moved and, if the lab scales, scaled unevenly; the camera off the axis
 *   C  a coarse sphere and a narrow highlight; in labs of flat shapes a solid with many faces
 *   D  the light behind the object, a wide highlight
 *   E  overlapping objects, the far one drawn last
 *   F  a picture twice as wide as high, the light near the surface
 *   G  everything 300 times as large: overflows 16 bits
 *   H  the lights beside the eye, which is the world's origin and looks along -z
 *   I  the lights beyond the object, the eye on the z axis, a wide highlight
 *
 * H and I serve to tell mistakes apart: they show highlights near the line of sight. Each scene has
 * a known form, always the same, and one per seed, with other colours, positions, sizes and times.
 * In lab 3 the time gives the model matrix; lab 10 always has the unit sphere; lab 11 has a floor,
 * and its eye is always above it (probe_shadow.h).
 */
#ifndef PROBE_H
#define PROBE_H

#include "base/random.h"
#include "labs/program/lab.h"

#include <stdint.h>

typedef enum ProbeKind {
    PROBE_PLAIN,
    PROBE_MOVED,
    PROBE_COARSE,
    PROBE_BEHIND,
    PROBE_CROWD,
    PROBE_WIDE,
    PROBE_HUGE,
    PROBE_ALONG,
    PROBE_AGAINST,
    PROBE_KIND_COUNT,
} ProbeKind;

/* "A" to "I". */
extern const char *const PROBE_NAMES[PROBE_KIND_COUNT];

enum { PROBE_MAX_OBJECTS = 3 };

typedef struct Probe {
    ProbeKind kind;
    bool known; /* else of a seed */
    int width, height;
    double seconds;
    Scene scene; /* points into this probe: do not move it */
    Light lights[LAB_MAX_LIGHTS];
    Object objects[PROBE_MAX_OBJECTS];
    Mesh meshes[PROBE_MAX_OBJECTS];
    double fitted[PROBE_MAX_OBJECTS]; /* lab 7: Blinn-Phong's exponent for the object's */
} Probe;

/* The known form of a scene. False, with a message: out of memory. */
bool probe_open_known(Probe *probe, const Lab *lab, ProbeKind kind, Message *message);

/* The form of a seed. */
bool probe_open_seed(Probe *probe, const Lab *lab, ProbeKind kind, uint64_t seed, Message *message);

/* The scene of the lab's program at a time. */
bool probe_open_usual(Probe *probe, const Lab *lab, double seconds, Message *message);

/* Lab 3's model matrix is move * turn * scale; the turn is about PROBE_AXIS, by DEGREES_PER_SECOND.
 */
extern const Vec3 PROBE_AXIS;
void probe_world_parts(double seconds, Mat4 *move, Mat4 *turn, Mat4 *scale);

/* NULL or zeroed is fine. */
void probe_close(Probe *probe);

#endif
