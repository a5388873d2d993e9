/*
 * functions: which numbers a shader computes with, and what is measured of GLSL's operations:
 * inputs that find the worst, and the truth. No GL.
 *
 * The truth is computed in double precision. Its error is far below what is measured, the half unit
 * of a correctly rounded 24-bit result: sums, products, quotients and square roots of floats are
 * correctly rounded to 53 bits, and the sums of up to four products have at most 4 such errors of
 * their largest term, together below 2^-26 units of a float; exp2, log2, pow, sin and cos of the C
 * library have at most 2 units of a double (glibc manual, Known Maximum Errors in Math Functions),
 * 2^-28 of a float's. truth_check compares a sample with MPFR.
 */
#ifndef FUNCTIONS_H
#define FUNCTIONS_H

#include "base/message.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* 2^exponent, -1022 to 1023; faster than ldexp. */
static inline double power_of_two(int exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

typedef enum Rounding {
    ROUNDING_NEAREST_EVEN,
    ROUNDING_NEAREST, /* ties otherwise */
    ROUNDING_ZERO,
    ROUNDING_OTHER,
} Rounding;

typedef struct Format {
    int bits;                       /* of the significand, with the first, which is always 1 */
    int min_exponent, max_exponent; /* of normal numbers: 2^min_exponent to just below
                                       2^(max_exponent + 1) */
    bool denormals;                 /* smaller results are kept, not taken for 0 */
    bool denormal_inputs;           /* smaller inputs are */
    Rounding rounding;              /* of sums */
    bool infinity, nan;             /* what overflows is not finite; inf - inf is not a number */
} Format;

bool format_equal(const Format *a, const Format *b);

/* IEEE 754's binary16: there are so few numbers that every one can be tried. */
bool format_is_half(const Format *format);

double format_max(const Format *format);

/* Half the distance of 1 from the next larger number: the largest relative error of rounding. */
double format_unit(const Format *format);

/* The distance of neighbouring numbers at this magnitude. */
double format_ulp(const Format *format, double magnitude);

/* The probes: FORMAT_PROBES sums of two numbers, and as many products (x y) z of three, whose
 * results, computed in some way, tell the format. Products may leave the range on their way, or
 * begin below it. */
enum { FORMAT_PROBES = 512 };
typedef struct FormatProbes {
    float x[FORMAT_PROBES], y[FORMAT_PROBES], z[FORMAT_PROBES];
} FormatProbes;
void format_sums(FormatProbes *probes);
void format_products(FormatProbes *probes);

/* From their results. Nothing else is asked: a driver's own word is not. False: these are no
 * floating-point numbers. */
bool format_of(const float sums[FORMAT_PROBES], const float products[FORMAT_PROBES],
               Format *format);

/* What glGetShaderPrecisionFormat says: 2^-min to 2^max, and bits after the first; zeroed: unknown.
 */
typedef struct Claim {
    int min, max, bits;
} Claim;

/* How a claim differs from what was measured, as "says 10 bits, computes with 24": empty if it does
 * not. */
enum { CLAIM_SIZE = 96 };
void claim_text(const Claim *claim, const Format *format, char text[CLAIM_SIZE]);

/* Errors of one function, in units in the last place: those of the exact result's magnitude, or of
 * the largest term of a sum, since terms can cancel. */
enum { NUMBER_BINADES = 280, NUMBER_FIRST_BINADE = -150 };
typedef struct Accuracy {
    uint64_t count, wrong; /* not finite though the exact result is */
    double largest, sum;
    float at[2];                     /* inputs of the largest, or of the first that is wrong */
    float by_binade[NUMBER_BINADES]; /* the largest, by the exponent of the first input from
                                        NUMBER_FIRST_BINADE on */
    float absolute[16]; /* the largest absolute error by the exponent of the second input, from -4
                           on: of pow, for bases up to 1 */
} Accuracy;

/* Adds one result. Exact results that the format does not have, for being too large or too small,
 * do not count. */
void accuracy_add(Accuracy *accuracy, const Format *format, const float at[2], double result,
                  double exact, double magnitude);
double accuracy_mean(const Accuracy *accuracy);

typedef enum Function {
    FUNCTION_ADD,
    FUNCTION_MULTIPLY,
    FUNCTION_DIVIDE,
    FUNCTION_SQRT,
    FUNCTION_INVERSESQRT,
    FUNCTION_LENGTH,
    FUNCTION_NORMALIZE,
    FUNCTION_DOT,
    FUNCTION_POW,
    FUNCTION_EXP2,
    FUNCTION_LOG2,
    FUNCTION_SIN,
    FUNCTION_COS,
    FUNCTION_MIX,
    FUNCTION_REFLECT,
    FUNCTION_COUNT,
} Function;

/* Each invocation of a shader has two vectors of four numbers, and computes four results. */
typedef struct FunctionInfo {
    const char *name;
    const char *code;   /* from vec4 a and vec4 b */
    int inputs;         /* numbers that a result depends on */
    const char *domain; /* the inputs, where not all; NULL */
} FunctionInfo;
extern const FunctionInfo FUNCTIONS[FUNCTION_COUNT];

/* Invocations whose results are judged at once. */
enum { BATCH_COUNT = 1 << 15 };
typedef struct Batch {
    float a[BATCH_COUNT][4], b[BATCH_COUNT][4];
    double exact[BATCH_COUNT][4], magnitude[BATCH_COUNT][4];
} Batch;

/* The number of batches with at least `inputs` results, a power of two; fewer if that is every
 * number that the format has. */
int batch_count(Function function, const Format *format, long inputs);

/* Fills in batch `number`: inputs that are numbers of the format, and exact results. */
void batch_fill(Batch *batch, Function function, const Format *format, int number);

/* Adds what was computed from a batch. */
void batch_judge(const Batch *batch, Function function, const Format *format,
                 const float (*results)[4], Accuracy *accuracy);

/* Whether exact results of some batch are those of MPFR with 200 bits, within 2^-48 of their
 * magnitude. True without a comparison if this is built without MPFR; see truth_is_checked. */
bool truth_check(const Batch *batch, Function function, Message *message);
bool truth_is_checked(void);

#endif
