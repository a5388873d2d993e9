/*
 * hard: shared by the tests of hard cases: a scene is drawn in bytes and in floats, in either
 * precision, and compared with the exact picture of its meshes.
 */
#ifndef HARD_H
#define HARD_H

#include "base/random.h"
#include "core/canvas.h"
#include "lighting/lighting.h"
#include "reference/reference.h"

typedef struct Hard {
    Canvas bytes, floats;    /* of one size, in one context */
    Lighting *lightings[2];  /* by HardPrecision */
    Image image, real;       /* the last pictures */
    Mesh sphere, quad;       /* of radius 1, 24 by 12; of side 2 */
    double worst[2], max[2]; /* since hard_report, by HardPrecision: the largest error of
                                hard_check, and the loosest bound */
    int checked;             /* the number of pictures that hard_check has compared since */
} Hard;
extern Hard hard; /* of the test program */

typedef enum HardPrecision { HARD_HIGHP, HARD_MEDIUMP } HardPrecision;

/* Opens the default backend. Fails the test if it cannot. */
void hard_open(int width, int height);
void hard_close(void);

/* A main of list 0 with pictures of so many pixels each way; needs support/picture_check.h. */
#define HARD_TEST_MAIN(name, size)                                                                 \
    FIXTURE(open_all)                                                                              \
    {                                                                                              \
        hard_open(size, size);                                                                     \
    }                                                                                              \
    FIXTURE(close_all)                                                                             \
    {                                                                                              \
        hard_close();                                                                              \
    }                                                                                              \
    PICTURE_TEST_MAIN(name, open_all, close_all)

/* Resizes the pictures. */
void hard_resize(int width, int height);

/* The errors of a scene's pictures, in steps of 1/255. */
typedef struct HardResult {
    double byte_error; /* the largest inside objects */
    int x, y;          /* its place in the byte picture */
    int interior_pixels;
    long long not_finite; /* values of the float picture that are infinite or NaN */
} HardResult;

/* Draws a scene, which must pass scene_check, and compares it with
 * `exact`, or if that is NULL with reference_open's picture of its meshes. A mesh must not have
 * changed since an earlier call, or hard_forget must have been called for it. */
HardResult hard_draw(const Scene *scene, HardPrecision precision, const Reference *exact);
void hard_forget(const Mesh *mesh);

/* The exact picture of the scene's meshes. */
void hard_exact(const Scene *scene, Reference *exact);

/* Draws a scene and compares. Fails the test with one line that names the case if a value is not
 * finite, fewer than `min_pixels` pixels are inside objects, or a byte is farther than `max` steps
 * from the exact picture; then it keeps the pictures (see picture_check.h). */
void hard_check(const char *name, const Scene *scene, HardPrecision precision, double max,
                int min_pixels);

/* The same with a given exact picture, perhaps of an equivalent scene. */
typedef struct HardBound {
    HardPrecision precision;
    double max;
    int min_pixels;
} HardBound;
void hard_check_exact(const char *name, const Scene *scene, HardBound bound,
                      const Reference *exact);

/* Prints one line: the number of pictures compared since the last report, and their largest
 * errors. */
void hard_report(const char *name);

/* One object and one point light, from which hard cases are made. The scene points into the world.
 * Nothing is overexposed, and at each point of a unit sphere the angle between light and viewer is
 * at most 75 degrees. */
typedef struct HardWorld {
    Light lights[32];
    Object objects[8];
    Scene scene;
} HardWorld;
void hard_world(HardWorld *world, const Mesh *mesh);

/* hard_check with each reflection, of which the world's scene keeps the last one, in both
 * precisions, lit at the fragments and at the vertices: within 1 step in highp, within
 * oracle_mediump_max for mediump fragments. At the vertices, which are always highp, mediump
 * affects only colours: 1.5 steps. */
void hard_check_reflections(const char *name, HardWorld *world, double reach, int min_pixels);

/* Draws without comparing; every value must be finite. */
void hard_draw_finite(const Scene *scene, HardPrecision precision);

/* A unit vector, uniform over the sphere. */
Vec3 hard_random_direction(Random *random);

#endif
