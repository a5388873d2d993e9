/*
 * glsl_bound: how far a driver's result can be from the exact one, over a piece of a surface.
 *
 * Code (glsl_run.h) runs with numbers of which a range of the exact value, one of the driver's, and
 * a bound of their difference are known: for all points of a piece, and all roundings that the
 * driver may make. Exactly is: in double precision.
 */
#ifndef GLSL_BOUND_H
#define GLSL_BOUND_H

#include "glsl/glsl_run.h"

typedef struct GlslRange {
    double low, high;
} GlslRange;

/* What is measured of operations. */
/* clang-format off */
enum {
    GLSL_UNITS_SUM, GLSL_UNITS_PRODUCT, GLSL_UNITS_QUOTIENT, GLSL_UNITS_SQRT,
    GLSL_UNITS_INVERSE_SQRT, GLSL_UNITS_EXP2, GLSL_UNITS_LOG2, GLSL_UNITS_SIN, GLSL_UNITS_COS,
    GLSL_UNITS_OTHER, GLSL_UNITS
};
/* clang-format on */

/* A driver's numbers, and the largest errors of its operations: in units in the last place, of a
 * sum of its largest term, of log2, sin and cos of at least 1; of pow absolute, for bases up to 1,
 * by the exponent of 2 of its second argument from -4 on. INFINITY: any. */
typedef struct GlslErrors {
    GlslArithmetic numbers;
    double units[GLSL_HIGHP + 1][GLSL_UNITS];
    double pow[GLSL_HIGHP + 1][16];
} GlslErrors;

/* The directions of a piece: s and t, and others in which what is seen of it changes. */
enum { GLSL_WAYS = 5 };

/* An input: where each direction w is from -radius[w] to radius[w], `middle` and for each the
 * product with a slope in these ranges, up to `slack` more or less; the driver's is at most `error`
 * from it. */
typedef struct GlslInput {
    double middle, error, slack;
    GlslRange slope[GLSL_WAYS];
} GlslInput;

/* What a texture's functions may give at coordinates in these ranges. */
typedef void GlslRangeTexture(void *context, int unit, int function, const GlslRange *coordinates,
                              int count, GlslRange color[4]);

typedef struct GlslBoundRun {
    const GlslCode *code;
    const GlslErrors *errors;
    /* Of each register, read where it is one of an input: set before a run. */
    GlslInput *inputs;
    double radius[GLSL_WAYS];
    /* How s and t change from a pixel to the one beside it, and above it; zeroed: unknown. Where a
     * condition changes in a pixel, an edge runs through it, which is not bounded. */
    double pixel[2][2];
    GlslRangeTexture *texture; /* NULL: 0 to 1, the same for both */
    void *context;
    int most;       /* operations in one run; 1,000,000 at first */
    bool discarded; /* at all points */
    bool edges;     /* there are pixels that are left out */
    bool stopped;   /* a loop's end is not known; `node` is its */
    int node;
    struct GlslBoundState *state;
} GlslBoundRun;

/* Never NULL. Both are to live as long. */
GlslBoundRun *glsl_bound_open(const GlslCode *code, const GlslErrors *errors);
void glsl_bound_close(GlslBoundRun *run);

/* False if it stopped. */
bool glsl_bound_run(GlslBoundRun *run);

/* Of a register after a run. */
typedef struct GlslBound {
    GlslRange exact, driver;
    double middle, slack; /* as in GlslInput; the middle of `exact` where slopes are not known */
    GlslRange slope[GLSL_WAYS];
    double error; /* the largest difference; INFINITY: no bound exists */
    int node;     /* of the operations whose errors make most of it; 0: the inputs' do */
    double share; /* what they make */
} GlslBound;
GlslBound glsl_bound(GlslBoundRun *run, int at);

#endif
