/*
 * probe: the scenes in which a submission is drawn, each made so that other mistakes show. No GL.
 *
 *   A  the lab's own scene, as its program draws it
 *   B  turned, moved, and where the lab has that unevenly scaled; the camera off the axis
 *   C  a coarse sphere and a narrow highlight; in labs of flat shapes a solid of many faces
 *   D  the light behind the object, and a wide highlight
 *   E  objects that cover each other, the far one drawn last
 *   F  a picture twice as wide as high, the light near the surface
 *   G  all of it 300 times as large: what 16 bits cannot hold
 *   H  the lights beside the eye, which is the world's origin and looks along -z
 *   I  the lights beyond the object, the eye on the z axis, a wide highlight
 *
 * H and I only tell mistakes apart: near the line of sight highlights show that are nowhere else.
 * Each has a form that is always the same, which students may know, and one for every seed: other
 * colours, places, turns, sizes and times. In lab 3 the object lies where the moment says; in
 * lab 10 it is always the unit sphere.
 */
#ifndef PROBE_H
#define PROBE_H

#include "lab.h"

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

enum { PROBE_MOST_OBJECTS = 2 };

typedef struct Probe {
    ProbeKind kind;
    bool known;        /* else it is one of a seed's */
    int width, height; /* of its picture */
    double seconds;
    Scene scene; /* points into this probe, which must not be moved */
    Light lights[LAB_MOST_LIGHTS];
    Object objects[PROBE_MOST_OBJECTS];
    Mesh meshes[PROBE_MOST_OBJECTS];
    double
        fitted[PROBE_MOST_OBJECTS]; /* lab 7: Blinn-Phong's exponent that goes with the object's */
} Probe;

/* The known form of a scene. False, with a message, where memory runs out. */
bool probe_open_known(Probe *probe, const Lab *lab, ProbeKind kind, Message *message);

/* A seed's. */
bool probe_open_seed(Probe *probe, const Lab *lab, ProbeKind kind, uint64_t seed, Message *message);

/* What the lab's program shows at a moment. */
bool probe_open_usual(Probe *probe, const Lab *lab, double seconds, Message *message);

/* Where lab 3 wants its cube: move * turn * scale, the turn about PROBE_AXIS, by
 * OPTIONS_DEGREES_PER_SECOND. */
extern const Vec3 PROBE_AXIS;
void probe_world_parts(double seconds, Mat4 *move, Mat4 *turn, Mat4 *scale);

/* NULL or zeroed is fine. */
void probe_close(Probe *probe);

/* Numbers that depend on nothing but the seed. (Steele, Lea and Flood, Fast splittable pseudorandom
 * number generators, 2014) */
typedef struct Random {
    uint64_t state;
} Random;
double random_between(Random *random, double least, double most);

#endif
