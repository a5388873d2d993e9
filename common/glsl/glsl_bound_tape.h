/*
 * glsl_bound_tape: the numbers of glsl_bound, and what is known of operations.
 */
#ifndef GLSL_BOUND_TAPE_H
#define GLSL_BOUND_TAPE_H

#include "glsl/glsl_bound.h"
#include "glsl/glsl_code.h"

#include <math.h>

static const GlslRange ANY = {-(double)INFINITY, (double)INFINITY}, ONE = {1, 1}, NONE = {0, 0};

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
/* ANY, which may be no number, too: what is made of it may, as well. */
static inline bool is_any(GlslRange a)
{
    return a.low == ANY.low && a.high == ANY.high;
}
static inline bool is_point(GlslRange a)
{
    return a.low == a.high;
}

static inline GlslRange range_sum(GlslRange a, GlslRange b)
{
    const GlslRange sum = {a.low + b.low, a.high + b.high};
    return sum.low <= sum.high ? sum : ANY; /* not of infinities that cancel */
}

static inline GlslRange range_minus(GlslRange a, GlslRange b)
{
    return range_sum(a, (GlslRange){-b.high, -b.low});
}

static inline GlslRange range_product(GlslRange a, GlslRange b)
{
    if (is_point(a) && is_point(b) && isfinite(a.low * b.low))
        return (GlslRange){a.low * b.low, a.low * b.low};
    if ((a.low == 0 && a.high == 0) || (b.low == 0 && b.high == 0))
        return (GlslRange){0, 0};
    const double ends[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    GlslRange product = {ends[0], ends[0]};
    for (int i = 0; i < 4; i++) {
        if (isnan(ends[i])) /* 0 times infinity */
            return ANY;
        product.low = smaller(product.low, ends[i]);
        product.high = larger(product.high, ends[i]);
    }
    return product;
}

/* A number on the tape. `slope`: by the directions; `by`: of the result by the operands `from`. */
typedef struct Entry {
    GlslRange exact, driver, slope[GLSL_WAYS], by[2];
    double middle, slack; /* exactly, where these are 0, and how exact that is */
    double error, born;
    int from[2], node; /* -1: none */
    int converted;     /* to another precision, 0: not yet */
    unsigned char op, precision, converted_to;
    bool narrowed; /* only for a way of a branch */
    bool edge;     /* a condition: where the two may differ, it changes within each pixel */
} Entry;

typedef struct GlslBoundState {
    Entry *entries;
    GlslRange *weights; /* the result's derivatives by each, backward */
    int *map;           /* the entry of each register, -1: as the inputs say */
    int *leaves;        /* what the inputs say, -1: not yet asked for */
    int *meets;         /* where the ways of each instruction's branches meet */
    int count, room, weight_room;
    int apart; /* how many branches are open in which the driver may go another way */
    int depth, operations;
    int ways;      /* directions with a radius, at least s and t */
    bool wide;     /* one has */
    double *lines; /* errors by line; 0: of the inputs */
    int *line_of;  /* each node's, counted from 0 */
} State;

/* One range in each direction. */
void tape_slope(Entry *entry, GlslRange slope);

/* Adds a number; its index. */
int tape_add(GlslBoundRun *run, const Entry *entry);
int tape_add_constant(GlslBoundRun *run, double value);

/* The number of a register, perhaps an input's. */
int tape_read(GlslBoundRun *run, int at);

/* A number as one of a precision with fewer bits. */
int tape_convert(GlslBoundRun *run, int at, int precision);

/* What an operation makes of two; of one number, both are that. */
int tape_compute(GlslBoundRun *run, const GlslInstruction *at, int a, int b);

/* Ways that the exact numbers and the driver's may take, as bits; EDGE: where they take different
 * ones, the condition changes within each pixel. */
enum { BOTH_FIRST = 1, BOTH_SECOND = 2, FIRST_SECOND = 4, SECOND_FIRST = 8, EDGE = 16 };
int ways_of(const Entry *condition);

/* The exact range of a dot product of so many terms, from its last sum's operands. */
void tape_narrow_dot(const GlslBoundRun *run, int count, int sum, int term, GlslRange *exact);

/* One of two numbers; `near`: the same where the two may go different ways. */
int tape_join(GlslBoundRun *run, const int of[2], const int near[2], int ways, int node);

/* By how much a driver's number in one range may be from an exact one in the other. */
double range_difference(GlslRange exact, GlslRange driver);

/* What an operation gives; ANY, if it may be undefined. `same`: both operands are one number. */
GlslRange range_of(int op, GlslRange a, GlslRange b, bool same);

/* Its derivatives by a and b, between any two values; `result` is its range. */
void slopes_of(int op, GlslRange a, GlslRange b, GlslRange result, GlslRange by[2]);

/* By how much the driver's rounding changes a result in `result` of operands in these ranges. */
double rounding_of(const GlslErrors *errors, const GlslInstruction *at, GlslRange a, GlslRange b,
                   GlslRange result);

/* Of a number that becomes one of this precision. */
double conversion_of(const GlslErrors *errors, int precision, GlslRange a);

bool is_of_precision(const GlslErrors *errors, int precision, double value);

#endif
