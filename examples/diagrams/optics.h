/*
 * optics: light, surface and eye in a plane, in numbers.
 *
 * The surface is the line y = 0, its normal N is up. Angles are in degrees from N: the light's to
 * the left, the eye's to the right, as textbooks draw them. Lengths are in units of the vectors.
 */
#ifndef OPTICS_H
#define OPTICS_H

#include "core/matrix.h"
#include "scene/scene.h"

enum { OPTICS_SIDES_MAX = 16 };

typedef struct Optics {
    double light, eye; /* angles */
    double shininess;
    Reflection reflection;
    const Material *material; /* but for its shininess */
    bool radiating;           /* light and eye are near; otherwise both are far away */
    double ambient;           /* the intensity of ambient light */
    double distance;          /* of a lamp: in widths of what it lights, or marked on a curve */
    double constant, linear, quadratic; /* its attenuation */
    int sides;                          /* of a polygon, 1 to OPTICS_SIDES_MAX */
} Optics;

/* Where light and eye are if they are near: the eye is farther away where it would be before the
 * light. */
#define OPTICS_LIGHT_DISTANCE 1.35
Vec3 optics_light_place(const Optics *optics);
Vec3 optics_eye_place(const Optics *optics);

/* The vectors at a point; all are unit vectors. */
typedef struct OpticsVectors {
    Vec3 n, l, v;
    Vec3 r; /* the mirror image of L */
    Vec3 h; /* halfway between L and V; zero where they are opposite */
    double n_dot_l, r_dot_v, n_dot_h;
    double highlight; /* the power of R.V or N.H, 0 where the light is behind */
} OpticsVectors;

/* Unit vectors at an angle from the normal, to the left and to the right. Exact at right angles. */
Vec3 optics_left(double degrees);
Vec3 optics_right(double degrees);

OpticsVectors optics_vectors(const Optics *optics, Vec3 point, Vec3 normal);

/* What the highlight would be at the origin for an eye at this angle: the lobe's radius. */
double optics_lobe(const Optics *optics, double eye);

/* How far from R, in degrees, the highlight is half as bright; 180 if nowhere. */
double optics_half_angle(const Optics *optics);

/* The colour of a point under a white light, by the equation that the exact pictures use. Clamped
 * to 0..1. */
Vec3 optics_color(const Optics *optics, Vec3 point, Vec3 normal);

/* The optics of the same surface without a highlight, whose material is kept in `matte`. */
Optics optics_matte(const Optics *optics, Material *matte);

/* The angle between the rays of a lamp to the ends of what it lights, in degrees. */
double optics_spread(const Optics *optics);

/* The share of a lamp's light that is left at a distance, and where it is a share: 0 if it is less
 * everywhere, INFINITY if it is more. Without any coefficient the light is not attenuated. */
double optics_attenuation(const Optics *optics, double distance);
double optics_attenuated_to(const Optics *optics, double share);

/* The width of what a beam of width 1 lights; INFINITY unless N.L > 0. */
double optics_footprint(double n_dot_l);

#endif
