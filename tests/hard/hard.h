/*
 * hard: what the tests of hard cases share: a scene is drawn in bytes and in floats, in either
 * precision, and compared with the exact picture of its meshes.
 */
#ifndef HARD_H
#define HARD_H

#include "canvas.h"
#include "lighting.h"
#include "reference.h"

typedef struct Hard {
    Canvas bytes, floats;     /* of one size, in one context */
    Lighting *lightings[2];   /* by HardPrecision */
    Image image, real;        /* the last pictures */
    double worst[2], most[2]; /* by HardPrecision, since hard_report: the largest error of
                                 hard_check, and the loosest bound that it had to keep */
    int checked;              /* how many pictures hard_check has seen since */
} Hard;

typedef enum HardPrecision { HARD_HIGHP, HARD_MEDIUMP } HardPrecision;

/* Opens the default backend. Fails the test that runs where it cannot. */
void hard_open(Hard *hard, int width, int height);
void hard_close(Hard *hard);

/* Gives the pictures another size. */
void hard_resize(Hard *hard, int width, int height);

/* How the pictures of a scene came out. Errors in steps of 1/255. */
typedef struct HardResult {
    double byte_error, float_error; /* the largest inside objects; in floats clamped to 0..1 */
    int x, y;                       /* where the byte picture has it */
    int interior_pixels;
    long long
        not_finite; /* values of the float picture, anywhere, that are infinite or no number */
} HardResult;

/* Draws a scene that passes scene_check (fails the test where it does not) and compares it with
 * `exact`, or where that is NULL with reference_open's picture of its meshes. A mesh must not have
 * changed since an earlier call, or hard_forget must have been called for it. */
HardResult hard_draw(Hard *hard, const Scene *scene, HardPrecision precision,
                     const Reference *exact);
void hard_forget(Hard *hard, const Mesh *mesh);

/* The exact picture of the scene's meshes, or with `solids` of its solids. */
void hard_exact(const Hard *hard, const Scene *scene, bool solids, Reference *exact);

/* Draws a scene, and fails the test with one line that names the case where a value is not finite,
 * fewer than `least_pixels` pixels are inside objects, or a byte is farther than `most` steps from
 * the exact picture; keeps the pictures then (see picture_check.h). */
void hard_check(Hard *hard, const char *name, const Scene *scene, HardPrecision precision,
                double most, int least_pixels);

/* Prints one line: how many pictures hard_check has seen since the last report, and their largest
 * errors. */
void hard_report(Hard *hard, const char *name);

/* One object and one point light, from which hard cases are made. The scene points into the world.
 * Nothing is brighter than can be shown, and from no point of a unit sphere do light and viewer lie
 * farther than 75 degrees apart. */
typedef struct HardWorld {
    Light lights[32];
    Object objects[8];
    Scene scene;
} HardWorld;
void hard_world(HardWorld *world, const Mesh *mesh);

/* How far, in steps of 1/255, a picture in mediump may lie from the exact one where light is
 * computed at the fragments; the derivation is in hard.c. `reach` says how far eye and light are
 * for the distance between light and surface: the largest (|light| + |point| + d) / d, in eye
 * coordinates, 1 for directional lights. 255 at most, which says nothing any more. */
double hard_mediump_most(const Scene *scene, double reach);

/* hard_check in both precisions with light at the fragments and at the vertices: within 1 step in
 * highp, within hard_mediump_most in mediump at the fragments; at the vertices, which are highp
 * always, mediump has colours only, and 1.5 steps. */
void hard_check_ways(Hard *hard, const char *name, const Scene *scene, double reach,
                     int least_pixels);

/* hard_check_ways with each reflection, of the world's scene, which keeps the last. */
void hard_check_reflections(Hard *hard, const char *name, HardWorld *world, double reach,
                            int least_pixels);

/* Numbers that look random, the same for the same seed: splitmix64 (Steele, Lea and Flood, Fast
 * splittable pseudorandom number generators, OOPSLA 2014). */
typedef struct HardRandom {
    unsigned long long state;
} HardRandom;
double hard_random(HardRandom *random, double least, double most); /* evenly */
int hard_random_below(HardRandom *random, int limit);
Vec3 hard_random_direction(HardRandom *random); /* unit, evenly over the sphere */

#endif
