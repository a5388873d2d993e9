/*
 * reference_real: the number that the reference computes with, and vectors of it.
 *
 * A double; where REFERENCE_QUAD is defined a __float128, for the test that measures what rounding
 * to double does. Functions have other names then, so that a program can have both.
 */
#ifndef REFERENCE_REAL_H
#define REFERENCE_REAL_H

#include "core/matrix.h"

#include <math.h>

#ifdef REFERENCE_QUAD

#include <quadmath.h>

typedef __float128 Real;
#define REAL_EPSILON FLT128_EPSILON
#define REAL_PI M_PIq
#define real_sqrt sqrtq
#define real_abs fabsq
#define real_pow powq
#define real_cos cosq
#define real_tan tanq
#define real_max fmaxq
#define real_min fminq

#define ray_solid quad_ray_solid
#define solid_normal quad_solid_normal
#define solid_project quad_solid_project
#define solid_touched quad_solid_touched
#define solid_blocks quad_solid_blocks
#define shade_point quad_shade_point
#define shade_light quad_shade_light
#define shade_arriving quad_shade_arriving
#define shade_base quad_shade_base
#define shade_add quad_shade_add
#define polynomial_roots quad_polynomial_roots
#define bounds_build quad_bounds_build
#define triangles_open quad_triangles_open
#define triangles_ray quad_triangles_ray
#define triangles_block quad_triangles_block
#define triangles_share quad_triangles_share
#define triangles_close quad_triangles_close
#define trace_open quad_trace_open
#define trace_sample quad_trace_sample
#define trace_object quad_trace_object
#define trace_point quad_trace_point
#define trace_place quad_trace_place
#define trace_same_side quad_trace_same_side
#define trace_agree quad_trace_agree
#define trace_close quad_trace_close
#define trace_casts quad_trace_casts
#define trace_pixel_lights quad_trace_pixel_lights
#define shadows_open quad_shadows_open
#define shadows_close quad_shadows_close
#define shadow_start_solid quad_shadow_start_solid
#define shadow_start_triangle quad_shadow_start_triangle
#define shadow_falls quad_shadow_falls
#define shadow_shade quad_shadow_shade
#define trace_object_open quad_trace_object_open
#define trace_object_close quad_trace_object_close
#define trace_object_normal quad_trace_object_normal
#define trace_object_place quad_trace_object_place

#else

#include <float.h>

typedef double Real;
#define REAL_EPSILON DBL_EPSILON
#define REAL_PI 3.14159265358979323846
#define real_sqrt sqrt
#define real_abs fabs
#define real_pow pow
#define real_cos cos
#define real_tan tan
/* Plain comparisons, for what is not a number does not come here. */
#define real_max(a, b) ((a) > (b) ? (a) : (b))
#define real_min(a, b) ((a) < (b) ? (a) : (b))

#endif

/* Two numbers at once. Of NaN or equal numbers the maximum and minimum are the second argument. */
#if defined(__SSE2__) && !defined(REFERENCE_QUAD)

#include <emmintrin.h>

typedef __m128d Real2;
#define real2 _mm_set1_pd
#define real2_load _mm_loadu_pd
#define real2_store _mm_storeu_pd
#define real2_subtract _mm_sub_pd
#define real2_multiply _mm_mul_pd
#define real2_max _mm_max_pd
#define real2_min _mm_min_pd
/* Bit 0: of the first number, bit 1: of the second. */
#define real2_at_most(a, b) _mm_movemask_pd(_mm_cmple_pd(a, b))

#else

typedef struct Real2 {
    Real first, second;
} Real2;

static inline Real2 real2(Real both)
{
    return (Real2){both, both};
}

static inline Real2 real2_load(const Real *from)
{
    return (Real2){from[0], from[1]};
}

static inline void real2_store(Real *to, Real2 a)
{
    to[0] = a.first;
    to[1] = a.second;
}

static inline Real2 real2_subtract(Real2 a, Real2 b)
{
    return (Real2){a.first - b.first, a.second - b.second};
}

static inline Real2 real2_multiply(Real2 a, Real2 b)
{
    return (Real2){a.first * b.first, a.second * b.second};
}

static inline Real2 real2_max(Real2 a, Real2 b)
{
    return (Real2){a.first > b.first ? a.first : b.first,
                   a.second > b.second ? a.second : b.second};
}

static inline Real2 real2_min(Real2 a, Real2 b)
{
    return (Real2){a.first < b.first ? a.first : b.first,
                   a.second < b.second ? a.second : b.second};
}

static inline int real2_at_most(Real2 a, Real2 b)
{
    return (a.first <= b.first) + 2 * (a.second <= b.second);
}

#endif

typedef struct Real3 {
    Real x, y, z;
} Real3;

static inline Real3 real3(Vec3 a)
{
    return (Real3){a.x, a.y, a.z};
}

static inline Vec3 real3_round(Real3 a)
{
    return (Vec3){(double)a.x, (double)a.y, (double)a.z};
}

static inline Real3 real3_add(Real3 a, Real3 b)
{
    return (Real3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline Real3 real3_subtract(Real3 a, Real3 b)
{
    return (Real3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline Real3 real3_scale(Real3 a, Real factor)
{
    return (Real3){a.x * factor, a.y * factor, a.z * factor};
}

/* a + factor b */
static inline Real3 real3_along(Real3 a, Real factor, Real3 b)
{
    return (Real3){a.x + factor * b.x, a.y + factor * b.y, a.z + factor * b.z};
}

static inline Real3 real3_product(Real3 a, Real3 b)
{
    return (Real3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline Real real3_dot(Real3 a, Real3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* b x a is exactly -(a x b). */
static inline Real3 real3_cross(Real3 a, Real3 b)
{
    return (Real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline Real real3_length(Real3 a)
{
    return real_sqrt(real3_dot(a, a));
}

/* The sum of its components' sizes. */
static inline Real real3_reach(Real3 a)
{
    return real_abs(a.x) + real_abs(a.y) + real_abs(a.z);
}

static inline Real real3_largest(Real3 a)
{
    return real_max(real_max(a.x, a.y), a.z);
}

/* The unit vector along `a`; zero where `a` is. */
static inline Real3 real3_unit(Real3 a)
{
    const Real length = real3_length(a);
    return length > 0 ? real3_scale(a, 1 / length) : (Real3){0, 0, 0};
}

#endif
