/*
 * glsl_bound_rules: what glsl_bound knows of each operation.
 */
#ifndef GLSL_BOUND_RULES_H
#define GLSL_BOUND_RULES_H

#include "glsl/glsl_bound.h"
#include "glsl/glsl_code.h"

#include <math.h>

static const GlslRange ANY = {-(double)INFINITY, (double)INFINITY};

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}
static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}
static inline double magnitude(GlslRange a)
{
    return larger(-a.low, a.high);
}
static inline GlslRange hull(GlslRange a, GlslRange b)
{
    return (GlslRange){smaller(a.low, b.low), larger(a.high, b.high)};
}
static inline bool is_point(GlslRange a)
{
    return a.low == a.high;
}

GlslRange range_product(GlslRange a, GlslRange b);
GlslRange range_sum(GlslRange a, GlslRange b);

/* What an operation gives; ANY, if it may be undefined. `same`: both operands are one number. */
GlslRange range_of(int op, GlslRange a, GlslRange b, bool same);

/* Its derivatives by a and b, between any two values; `result` is its range. */
void slopes_of(int op, GlslRange a, GlslRange b, bool same, GlslRange result, GlslRange by[2]);

/* By how much the driver's rounding changes a result in `result` of operands in these ranges. */
double rounding_of(const GlslErrors *errors, const GlslInstruction *at, GlslRange a, GlslRange b,
                   GlslRange result);

/* Of a number that becomes one of this precision. */
double conversion_of(const GlslErrors *errors, int precision, GlslRange a);

bool is_of_precision(const GlslErrors *errors, int precision, double value);

#endif
