/*
 * functions: what is measured of GLSL's operations: inputs that find the worst, and the truth.
 * No GL.
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
#include "study/arithmetic/numbers.h"

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
