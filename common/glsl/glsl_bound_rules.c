/*
 * Ranges of operations are by their monotony: their ends are results at ends of the operands. A
 * derivative's range holds between any two values in the operands' ranges (the mean value theorem);
 * of what has a corner, as max, it has the derivatives at both sides (Clarke's), and of what jumps
 * it is unknown.
 */
#include "glsl/glsl_bound_tape.h"

#include <stdint.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static GlslRange square(GlslRange a)
{
    const double low = a.low > 0 ? a.low : a.high < 0 ? -a.high : 0, high = magnitude(a);
    return (GlslRange){low * low, high * high};
}

static GlslRange quotient(GlslRange a, GlslRange b)
{
    if (b.low <= 0 && b.high >= 0)
        return ANY;
    return range_product(a, (GlslRange){1 / b.high, 1 / b.low});
}

static GlslRange corners(double (*f)(double, double), GlslRange a, GlslRange b)
{
    const double ends[4] = {f(a.low, b.low), f(a.low, b.high), f(a.high, b.low), f(a.high, b.high)};
    return (GlslRange){smaller(smaller(ends[0], ends[1]), smaller(ends[2], ends[3])),
                       larger(larger(ends[0], ends[1]), larger(ends[2], ends[3]))};
}

static GlslRange power(GlslRange a, GlslRange b)
{
    if (a.low < 0 || (a.low == 0 && b.low <= 0))
        return ANY;
    if (is_point(a) && is_point(b))
        return (GlslRange){pow(a.low, b.low), pow(a.low, b.low)};
    return corners(pow, a, b);
}

/* cos, or sin of what is PI / 2 less. */
static GlslRange wave(GlslRange a)
{
    if (!(a.high - a.low < 2 * PI))
        return !isfinite(a.high - a.low) ? ANY : (GlslRange){-1, 1};
    static const double SHIFT = 1e-15; /* the rounding of PI / 2, and more */
    const double low = cos(a.low), high = cos(a.high);
    const double first = ceil(a.low / (2 * PI)) * 2 * PI;
    const double lowest = ceil((a.low - PI) / (2 * PI)) * 2 * PI + PI;
    return (GlslRange){lowest <= a.high ? -1 : smaller(low, high) - SHIFT,
                       first <= a.high ? 1 : larger(low, high) + SHIFT};
}

static GlslRange shifted(GlslRange a, double by)
{
    return (GlslRange){a.low + by, a.high + by};
}

static GlslRange falling(double (*f)(double), GlslRange a)
{
    return (GlslRange){f(a.high), f(a.low)};
}

static GlslRange rising(double (*f)(double), GlslRange a)
{
    return (GlslRange){f(a.low), f(a.high)};
}

static double sign(double a)
{
    return (a > 0) - (a < 0);
}

static GlslRange arc(GlslRange y, GlslRange x)
{
    if (x.low <= 0 && y.low <= 0 && y.high >= 0)
        return is_point(y) && x.low == x.high && x.low != 0
                   ? (GlslRange){atan2(y.low, x.low), atan2(y.low, x.low)}
                   : ANY;
    return corners(atan2, y, x);
}

static GlslRange boolean(bool certain, bool possible)
{
    return (GlslRange){certain, possible};
}

static bool holds_zero(GlslRange a)
{
    return a.low <= 0 && a.high >= 0;
}

static bool is_zero(GlslRange a)
{
    return a.low == 0 && a.high == 0;
}

static GlslRange truth(int op, GlslRange a, GlslRange b)
{
    const bool equal = is_point(a) && is_point(b) && a.low == b.low;
    const bool meet = a.low <= b.high && b.low <= a.high;
    const bool a_is = !holds_zero(a), b_is = !holds_zero(b), a_may = !is_zero(a),
               b_may = !is_zero(b);
    /* clang-format off */
    switch (op) {
    case OP_LESS: return boolean(a.high < b.low, a.low < b.high);
    case OP_LESS_EQUAL: return boolean(a.high <= b.low, a.low <= b.high);
    case OP_EQUAL: return boolean(equal, meet);
    case OP_NOT_EQUAL: return boolean(!meet, !equal);
    case OP_NOT: return boolean(is_zero(a), holds_zero(a));
    case OP_AND: return boolean(a_is && b_is, a_may && b_may);
    case OP_OR: return boolean(a_is || b_is, a_may || b_may);
    case OP_XOR:
        return boolean((a_is && is_zero(b)) || (b_is && is_zero(a)),
                       !((a_is && b_is) || (is_zero(a) && is_zero(b))));
    default: return boolean(a_is, a_may); /* OP_BOOL */
    }
    /* clang-format on */
}

static GlslRange function(int op, GlslRange a, GlslRange b)
{
    if (!isfinite(magnitude(a)) && op >= OP_SIN && op <= OP_INVERSE_SQRT)
        return ANY; /* it may be no number */
    /* clang-format off */
    switch (op) {
    case OP_SIN: return is_point(a) ? rising(sin, a) : wave(shifted(a, -PI / 2));
    case OP_COS: return is_point(a) ? rising(cos, a) : wave(a);
    case OP_ASIN: return a.low < -1 || a.high > 1 ? ANY : rising(asin, a);
    case OP_ACOS: return a.low < -1 || a.high > 1 ? ANY : falling(acos, a);
    case OP_ATAN: return rising(atan, a);
    case OP_ATAN2: return arc(a, b);
    case OP_POW: return power(a, b);
    case OP_EXP2: return rising(exp2, a);
    case OP_LOG2: return a.low > 0 ? rising(log2, a) : ANY;
    case OP_SQRT: return a.low < 0 ? ANY : rising(sqrt, a);
    case OP_INVERSE_SQRT:
        return a.low > 0 ? (GlslRange){1 / sqrt(a.high), 1 / sqrt(a.low)} : ANY;
    case OP_INT_DIVIDE:
        return is_zero(b) ? (GlslRange){0, 0} : rising(trunc, quotient(a, b));
    default: return truth(op, a, b);
    }
    /* clang-format on */
}

GlslRange range_of(int op, GlslRange a, GlslRange b, bool same)
{
    if (is_any(a) || (is_any(b) && (op == OP_MIN || op == OP_MAX)))
        return op >= OP_NOT && op <= OP_XOR ? (GlslRange){0, 1}
               : op == OP_SIGN              ? (GlslRange){-1, 1}
                                            : ANY;
    /* clang-format off */
    switch (op) {
    case OP_ADD: return range_sum(a, b);
    case OP_SUBTRACT:
        return same && isfinite(magnitude(a)) ? (GlslRange){0, 0} : range_minus(a, b);
    case OP_MULTIPLY:
        if ((!isfinite(magnitude(a)) && holds_zero(b)) ||
            (!isfinite(magnitude(b)) && holds_zero(a)))
            return ANY; /* 0 times infinity */
        return same ? square(a) : range_product(a, b);
    case OP_DIVIDE: return quotient(a, b);
    case OP_SET: return a;
    case OP_NEGATE: return (GlslRange){-a.high, -a.low};
    case OP_MIN: return (GlslRange){smaller(a.low, b.low), smaller(a.high, b.high)};
    case OP_MAX: return (GlslRange){larger(a.low, b.low), larger(a.high, b.high)};
    case OP_ABS:
        return (GlslRange){a.low > 0 ? a.low : a.high < 0 ? -a.high : 0, magnitude(a)};
    case OP_SIGN: return rising(sign, a);
    case OP_FLOOR: return rising(floor, a);
    case OP_CEIL: return rising(ceil, a);
    case OP_TRUNCATE: return rising(trunc, a);
    default: return function(op, a, b);
    }
    /* clang-format on */
}

/* Of the larger of two. */
static void choice_slopes(GlslRange a, GlslRange b, GlslRange by[2])
{
    by[0] = (GlslRange){a.low >= b.high, a.high > b.low};
    by[1] = (GlslRange){b.low >= a.high, b.high > a.low};
}

static void arc_slopes(GlslRange y, GlslRange x, GlslRange by[2])
{
    const GlslRange squares = range_sum(square(x), square(y));
    by[0] = quotient(x, squares);
    by[1] = quotient((GlslRange){-y.high, -y.low}, squares);
}

static void power_slopes(GlslRange a, GlslRange b, GlslRange result, GlslRange by[2])
{
    by[0] = range_product(b, power(a, shifted(b, -1)));
    if (is_point(b) && b.low >= 1 && a.low == 0)
        by[0] = (GlslRange){0, b.low * pow(a.high, b.low - 1)};
    by[1] = is_point(b) ? (GlslRange){0, 0} /* one number for both */
            : a.low > 0 ? range_product(rising(log, a), result)
                        : ANY;
}

/* Of a function of one number; else ANY. */
static GlslRange slope_of(int op, GlslRange a, GlslRange result)
{
    const GlslRange squares = square(a);
    const GlslRange left = {smaller(1 - squares.high, 1 - squares.low), 1 - squares.low};
    const GlslRange arcs = left.low > 0 ? (GlslRange){1 / sqrt(left.high), 1 / sqrt(left.low)}
                                        : (GlslRange){1, (double)INFINITY};
    /* clang-format off */
    switch (op) {
    case OP_SET: return (GlslRange){1, 1};
    case OP_NEGATE: return (GlslRange){-1, -1};
    case OP_ABS: return (GlslRange){a.low >= 0 ? 1 : -1, a.high <= 0 ? -1 : 1};
    case OP_SIN: return wave(a);
    case OP_COS: return wave(shifted(a, PI / 2));
    case OP_ASIN: return arcs;
    case OP_ACOS: return (GlslRange){-arcs.high, -arcs.low};
    case OP_ATAN: return (GlslRange){1 / (1 + squares.high), 1 / (1 + squares.low)};
    case OP_EXP2: return range_product(result, (GlslRange){log(2), log(2)});
    case OP_LOG2: return a.low > 0 ? (GlslRange){1 / log(2) / a.high, 1 / log(2) / a.low} : ANY;
    case OP_SQRT:
        return a.low >= 0 ? (GlslRange){.5 / sqrt(a.high), .5 / sqrt(a.low)} : ANY;
    case OP_INVERSE_SQRT:
        return a.low > 0 ? (GlslRange){-.5 / (a.low * sqrt(a.low)), -.5 / (a.high * sqrt(a.high))}
                         : ANY;
    default: return is_point(result) ? (GlslRange){0, 0} : ANY;
    }
    /* clang-format on */
}

void slopes_of(int op, GlslRange a, GlslRange b, GlslRange result, GlslRange by[2])
{
    by[1] = (GlslRange){0, 0};
    /* clang-format off */
    switch (op) {
    case OP_ADD: by[0] = by[1] = (GlslRange){1, 1}; break;
    case OP_SUBTRACT: by[0] = (GlslRange){1, 1}; by[1] = (GlslRange){-1, -1}; break;
    case OP_MULTIPLY: by[0] = b; by[1] = a; break;
    case OP_DIVIDE:
        by[0] = quotient((GlslRange){1, 1}, b);
        by[1] = range_product(range_product(result, by[0]), (GlslRange){-1, -1});
        break;
    case OP_MAX: choice_slopes(a, b, by); break;
    case OP_MIN: choice_slopes((GlslRange){-a.high, -a.low}, (GlslRange){-b.high, -b.low}, by); break;
    case OP_POW: power_slopes(a, b, result, by); break;
    case OP_ATAN2: arc_slopes(a, b, by); break;
    default: by[0] = slope_of(op, a, result);
    }
    /* clang-format on */
}

/* The driver's rounding */

/* 2^exponent, faster than ldexp. */
static double two(int exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static double unit_at(const GlslErrors *errors, int precision, double size)
{
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    const int exponent = (int)(bits >> 52 & 0x7FF) - 1023;
    const int least = errors->numbers.of[precision].least;
    return two((exponent > least ? exponent : least) - errors->numbers.of[precision].bits + 1);
}

bool is_of_precision(const GlslErrors *errors, int precision, double value)
{
    if (value == 0 || errors->numbers.of[precision].bits == 53)
        return true;
    const double unit = unit_at(errors, precision, fabs(value));
    return value / unit == rint(value / unit) &&
           fabs(value) >= two(errors->numbers.of[precision].least) &&
           fabs(value) < two(errors->numbers.of[precision].most + 1);
}

/* Small results may become 0, large ones infinite. */
static double rounded(const GlslErrors *errors, int precision, double units, double size,
                      GlslRange result)
{
    const int bits = errors->numbers.of[precision].bits;
    if (bits == 53 || (result.low == 0 && result.high == 0 && size == 0))
        return 0;
    const double most = (2 - two(1 - bits)) * two(errors->numbers.of[precision].most);
    const double least = two(errors->numbers.of[precision].least);
    if (!(magnitude(result) <= most))
        return (double)INFINITY;
    const double error = units * unit_at(errors, precision, smaller(size, most));
    const bool small = result.low < least && result.high > -least;
    return small && !errors->numbers.of[precision].denormals ? larger(error, least) : error;
}

double conversion_of(const GlslErrors *errors, int precision, GlslRange a)
{
    return rounded(errors, precision, .5, magnitude(a), a);
}

static bool is_power(GlslRange a)
{
    int exponent;
    return is_point(a) && fabs(a.low) >= 1 && fabs(frexp(a.low, &exponent)) == .5;
}

/* Products with powers of 2 from 1 on, and sums with 0, are not rounded. */
static bool is_kept(int op, GlslRange a, GlslRange b)
{
    return op == OP_MULTIPLY ? is_power(a) || is_power(b)
                             : (op == OP_ADD || op == OP_SUBTRACT) && (is_zero(a) || is_zero(b));
}

double rounding_of(const GlslErrors *errors, const GlslInstruction *at, GlslRange a, GlslRange b,
                   GlslRange result)
{
    const double *units = errors->units[at->precision];
    double size = magnitude(result);
    int kind = GLSL_UNITS_OTHER;
    if (errors->numbers.of[at->precision].bits == 53)
        return 0;
    if (is_kept(at->op, a, b))
        return size < two(errors->numbers.of[at->precision].most + 1) ? 0 : (double)INFINITY;
    /* clang-format off */
    switch (at->op) {
    case OP_ADD: case OP_SUBTRACT:
        kind = GLSL_UNITS_SUM;
        size = larger(size, larger(magnitude(a), magnitude(b)));
        break;
    case OP_MULTIPLY: kind = GLSL_UNITS_PRODUCT; break;
    case OP_DIVIDE: kind = GLSL_UNITS_QUOTIENT; break;
    case OP_SQRT: kind = GLSL_UNITS_SQRT; break;
    case OP_INVERSE_SQRT: kind = GLSL_UNITS_INVERSE_SQRT; break;
    case OP_EXP2: kind = GLSL_UNITS_EXP2; break;
    case OP_LOG2: kind = GLSL_UNITS_LOG2; size = larger(size, 1); break;
    case OP_SIN: kind = GLSL_UNITS_SIN; size = larger(size, 1); break;
    case OP_COS: kind = GLSL_UNITS_COS; size = larger(size, 1); break;
    case OP_ASIN: case OP_ACOS: case OP_ATAN: case OP_ATAN2: break;
    case OP_POW: {
        /* Above 1 the error grows with the result. */
        const double most = larger(size * size, 1);
        double error = 0;
        int last = b.high > 0 ? ilogb(b.high) + 4 : 0;
        last = last < 0 ? 0 : last > 15 ? 15 : last;
        for (int i = 0; i <= last; i++)
            error = larger(error, errors->pow[at->precision][i]);
        const double least = rounded(errors, at->precision, 0, size, result);
        return magnitude(b) < 4096 ? error * most + least : (double)INFINITY;
    }
    default: return 0; /* numbers as they are, and whole ones */
    }
    /* clang-format on */
    return rounded(errors, at->precision, units[kind], size, result);
}
