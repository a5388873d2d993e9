/*
 * interval: bounds of what a driver computes, from the errors that were measured.
 */
#ifndef INTERVAL_H
#define INTERVAL_H

#include "core/matrix.h"
#include "study/arithmetic/arithmetic.h"

/* All values between two. Where anything may be, also NaN, it is INTERVAL_ANYTHING. */
typedef struct Interval {
    double low, high;
} Interval;

typedef struct Interval3 {
    Interval x, y, z;
} Interval3;

/* What computes; NULL: exactly. */
typedef const Arithmetic *Machine;

/* fmax of numbers that are not NaN, without a call: this is computed often. */
static inline double interval_larger(double a, double b)
{
    return a > b ? a : b;
}

/* The largest error of a function in units; where it can fail, any. */
double interval_units(Machine machine, Function function);

Interval interval_just(double value);
double interval_magnitude(Interval a);

/* With an error of so many units of the larger of the result and `magnitude`, the largest term. */
Interval interval_widened(Machine machine, Interval a, double ulps, double magnitude);

/* As a number of the machine: an input. */
Interval interval_input(Machine machine, Interval a);
Interval3 interval_input3(Machine m, Vec3 v);

Interval interval_add(Machine m, Interval a, Interval b);
Interval interval_exact_product(Interval a, Interval b);
Interval interval_multiply(Machine m, Interval a, Interval b);
Interval interval_negative(Interval a);
Interval interval_sum_of_three(Machine m, Interval x, Interval y, Interval z);
Interval interval_dot(Machine m, Interval3 a, Interval3 b);
Interval interval_square_length(Machine m, Interval3 a);
Interval3 interval_scaled(Machine m, Interval3 a, Interval by);
Interval3 interval_sum3(Machine m, Interval3 a, Interval3 b);
Interval3 interval_negative3(Interval3 a);

/* LEAST of shaders/lighting/guards.glsl, and safe_normalize. */
double interval_least(Machine m);
Interval3 interval_unit(Machine m, Interval3 a);

/* pow, and its largest absolute error for bases up to 1. */
Interval interval_power(Machine m, Interval base, double exponent);
double interval_power_error(Machine m, double exponent);

#endif
