/*
 * Interval arithmetic: a number is known by two ends between which it lies, and each operation
 * gives the ends between which its result lies, whatever the operands are within theirs (Moore,
 * Interval Analysis, 1966). Here the ends are computed in double precision and then moved apart by
 * the largest error that the operation was measured to have on a machine, so that they hold for
 * that machine. Intervals do not know that two numbers depend on each other (x - x is no zero), so
 * they grow wider than need be; where that matters, as in a unit vector, a formula is bounded as a
 * whole.
 */
#include "study/arithmetic/interval.h"

#include <math.h>

static const Interval ANYTHING = {-(double)INFINITY, (double)INFINITY};

Interval interval_just(double value)
{
    return (Interval){value, value};
}

/* The largest error of a function in units; where it can fail, any. */
double interval_units(Machine machine, Function function)
{
    const Accuracy *accuracy = &machine->accuracies[function];
    return accuracy->wrong ? (double)INFINITY : accuracy->largest;
}

/* With an error of so many units of the larger of the result and `magnitude`, the largest term. */
Interval interval_widened(Machine machine, Interval a, double ulps, double magnitude)
{
    if (!(a.low <= a.high))
        return ANYTHING;
    if (!machine)
        return a;
    const Format *format = &machine->format;
    const double largest = interval_larger(interval_larger(fabs(a.low), fabs(a.high)), magnitude);
    if (largest == 0)
        return a;
    const double most = format_max(format);
    double error = ulps * format_ulp(format, largest < most ? largest : most);
    if (!format->denormals || !format->denormal_inputs)
        error = interval_larger(error, power_of_two(format->min_exponent)); /* taken for 0 */
    if (a.low > -INFINITY)
        a.low -= error;
    if (a.high < INFINITY)
        a.high += error;
    a.high = a.high > most ? (double)INFINITY : a.high;
    a.low = a.low < -most ? -(double)INFINITY : a.low;
    /* What overflows may also stay at the largest number. */
    a.low = a.low > most ? most : a.low;
    a.high = a.high < -most ? -most : a.high;
    return a;
}

/* As a number of the machine: an input. */
Interval interval_input(Machine machine, Interval a)
{
    return interval_widened(machine, a, 0.5, 0);
}

double interval_magnitude(Interval a)
{
    return interval_larger(fabs(a.low), fabs(a.high));
}

Interval interval_add(Machine m, Interval a, Interval b)
{
    const Interval sum = {a.low + b.low, a.high + b.high};
    return interval_widened(m, sum, m ? interval_units(m, FUNCTION_ADD) : 0,
                            interval_larger(interval_magnitude(a), interval_magnitude(b)));
}

Interval interval_exact_product(Interval a, Interval b)
{
    const double ends[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    Interval product = interval_just(ends[0]);
    for (int i = 0; i < 4; i++) {
        if (isnan(ends[i])) /* 0 times infinity */
            return ANYTHING;
        product.low = ends[i] < product.low ? ends[i] : product.low;
        product.high = interval_larger(product.high, ends[i]);
    }
    return product;
}

Interval interval_multiply(Machine m, Interval a, Interval b)
{
    return interval_widened(m, interval_exact_product(a, b),
                            m ? interval_units(m, FUNCTION_MULTIPLY) : 0, 0);
}

Interval interval_negative(Interval a)
{
    return (Interval){-a.high, -a.low};
}

static Interval square_of(Interval a)
{
    const double low = a.low > 0 ? a.low : a.high < 0 ? -a.high : 0, high = interval_magnitude(a);
    return (Interval){low * low, high * high};
}

Interval interval_sum_of_three(Machine m, Interval x, Interval y, Interval z)
{
    const Interval sum = {x.low + y.low + z.low, x.high + y.high + z.high};
    return interval_widened(
        m, sum, m ? interval_units(m, FUNCTION_DOT) : 0,
        interval_larger(interval_magnitude(x),
                        interval_larger(interval_magnitude(y), interval_magnitude(z))));
}

Interval interval_dot(Machine m, Interval3 a, Interval3 b)
{
    return interval_sum_of_three(m, interval_exact_product(a.x, b.x),
                                 interval_exact_product(a.y, b.y),
                                 interval_exact_product(a.z, b.z));
}

Interval interval_square_length(Machine m, Interval3 a)
{
    const Interval sum = interval_sum_of_three(m, square_of(a.x), square_of(a.y), square_of(a.z));
    return (Interval){interval_larger(sum.low, 0), sum.high};
}

Interval3 interval_scaled(Machine m, Interval3 a, Interval by)
{
    return (Interval3){interval_multiply(m, a.x, by), interval_multiply(m, a.y, by),
                       interval_multiply(m, a.z, by)};
}

Interval3 interval_sum3(Machine m, Interval3 a, Interval3 b)
{
    return (Interval3){interval_add(m, a.x, b.x), interval_add(m, a.y, b.y),
                       interval_add(m, a.z, b.z)};
}

Interval3 interval_negative3(Interval3 a)
{
    return (Interval3){interval_negative(a.x), interval_negative(a.y), interval_negative(a.z)};
}

Interval3 interval_input3(Machine m, Vec3 v)
{
    return (Interval3){interval_input(m, interval_just(v.x)), interval_input(m, interval_just(v.y)),
                       interval_input(m, interval_just(v.z))};
}

/* shaders/lighting/guards.glsl: LEAST and MOST of either kind of numbers. */
double interval_least(Machine m)
{
    return m && m->format.max_exponent < 100 ? 6.2e-5 : 1e-37;
}

static Interval inverse_root(Machine m, Interval square)
{
    const double least = interval_least(m);
    const Interval root = {1 / sqrt(interval_larger(square.high, least)),
                           1 / sqrt(interval_larger(square.low, least))};
    return interval_widened(m, root, m ? interval_units(m, FUNCTION_INVERSESQRT) : 0, 0);
}

/* x / sqrt(x^2 + others), which grows with x. */
static double unit_end(double x, Interval others, bool lower)
{
    const double rest = (x > 0) == lower ? others.high : others.low;
    return x == 0 ? 0 : x / sqrt(x * x + rest);
}

static Interval unit_part(Interval x, Interval y, Interval z)
{
    const Interval a = square_of(y), b = square_of(z), others = {a.low + b.low, a.high + b.high};
    return (Interval){unit_end(x.low, others, true), unit_end(x.high, others, false)};
}

/* safe_normalize. Where no guard is in the way, it is bounded as a whole, as normalize was
 * measured: the parts of a vector do not vary apart from its length. */
Interval3 interval_unit(Machine m, Interval3 a)
{
    const Interval square = interval_square_length(m, a);
    if (!(square.low >= interval_least(m) && square.high < INFINITY))
        return interval_scaled(m, a, inverse_root(m, square));
    const double error = m ? interval_units(m, FUNCTION_NORMALIZE) : 0;
    return (Interval3){interval_widened(m, unit_part(a.x, a.y, a.z), error, 0),
                       interval_widened(m, unit_part(a.y, a.z, a.x), error, 0),
                       interval_widened(m, unit_part(a.z, a.x, a.y), error, 0)};
}

/* The largest absolute error of pow for bases up to 1. */
double interval_power_error(Machine m, double exponent)
{
    enum { FIRST = -4, LAST = 11 };
    double error = 0;
    const int last = exponent > 0 ? ilogb(exponent) : FIRST;
    for (int i = FIRST; i <= LAST && i <= (last < FIRST ? FIRST : last); i++)
        error = interval_larger(error, (double)m->accuracies[FUNCTION_POW].absolute[i - FIRST]);
    return error;
}

Interval interval_power(Machine m, Interval base, double exponent)
{
    if (base.high <= 0)
        return interval_just(exponent == 0);
    /* Above 1 colours are clamped; the error grows with the result. */
    const double high = pow(base.high, exponent), low = base.low > 0    ? pow(base.low, exponent)
                                                        : exponent == 0 ? 1
                                                                        : 0;
    const double error = m ? interval_power_error(m, exponent) : 0;
    return (Interval){interval_larger(low - error, 0),
                      high + error * interval_larger(high * high, 1)};
}
