/*
 * oracle: what a scene shows at the centre of a pixel, in double precision: the judge of pictures
 * and of the exact picture.
 *
 * Shares vectors and matrices with the programs, nothing with lighting, the shaders and reference:
 * one ray, the formulas of the solids, every triangle of a mesh, and the lighting equation (OpenGL
 * 1.1 specification, section 2.13.1) written again, for clarity and not for speed. Shadows, teapots
 * and colours of vertices have no formula here.
 */
#ifndef ORACLE_H
#define ORACLE_H

#include "scene/scene.h"

/* A point of a surface that lights are to reach, in world coordinates. */
typedef struct OraclePoint {
    const Object *object;
    bool back;          /* the side that is lit is the back's, with its material */
    Vec3 point, normal; /* unit, on the side that is lit */
    Vec3 viewer;        /* the direction towards it, unit */
    double from_jump;   /* oracle_light sets it: how far a cosine is from where light jumps: a
                           cone's edge, and N.L = 0 if there is a highlight */
} OraclePoint;

/* How far a point is outside a closed solid; negative inside. */
double oracle_outside(const Solid *solid, Vec3 p);

/* The sum of the lighting equation, not clamped. Of the point are needed: object, back, point,
 * normal, viewer. */
Vec3 oracle_light(const Scene *scene, OraclePoint *at);

/* The colour, in steps of 1/255, that is shown at a pixel's centre: clamped, marked or encoded as
 * the scene says. False: nothing is met there, or something without formula. */
bool oracle_color(const Scene *scene, int width, int height, int x, int y, double color[3]);

/*
 * Bounds for a fragment shader in mediump of 11 significant bits, with u = 2^-11 for one rounding.
 * Lengths of vectors are about 1 but where they are given; errors are lengths of vectors.
 */
extern const double ORACLE_MEDIUMP_UNIT; /* u */

/* The largest possible distance, in steps of 1/255, between a mediump picture lit at the fragments
 * and the exact one. `reach` bounds how far eye and light are relative to the distance between
 * light and surface: the largest (|light| + |point| + d) / d, in eye coordinates; 1 for directional
 * lights. Light and viewer are at most 75 degrees apart wherever there is a highlight. At most 255,
 * which is no bound. */
double oracle_mediump_max(const Scene *scene, double reach);

#endif
