#include "study/arithmetic/functions.h"

#include "base/random.h"

#include <math.h>

#ifdef HAVE_MPFR
#include <mpfr.h>
#endif

/* Result i of a function of vectors is that of components i, i + 1, i + 2, cyclically. */
#define ROTATED(before, after, tail)                                                               \
    "vec4(" before "a.xyz" after "xyz)" tail ", " before "a.yzw" after "yzw)" tail ", " before     \
    "a.zwx" after "zwx)" tail ", " before "a.wxy" after "wxy)" tail ")"

const FunctionInfo FUNCTIONS[FUNCTION_COUNT] = {
    [FUNCTION_ADD] = {"+", "a + b", 2, NULL},
    [FUNCTION_MULTIPLY] = {"*", "a * b", 2, NULL},
    [FUNCTION_DIVIDE] = {"/", "a / b", 2, "1 / b within the range"},
    [FUNCTION_SQRT] = {"sqrt", "sqrt(a)", 1, NULL},
    [FUNCTION_INVERSESQRT] = {"inversesqrt", "inversesqrt(a)", 1, NULL},
    [FUNCTION_LENGTH] = {"length",
                         "vec4(length(a.xyz), length(a.yzw), length(a.zwx), length(a.wxy))", 3,
                         "squares within the range"},
    [FUNCTION_NORMALIZE] = {"normalize",
                            "vec4(normalize(a.xyz).x, normalize(a.yzw).x, normalize(a.zwx).x, "
                            "normalize(a.wxy).x)",
                            3, "squares within the range"},
    [FUNCTION_DOT] = {"dot", ROTATED("dot(", ", b.", ""), 6, "products within the range"},
    [FUNCTION_POW] = {"pow", "pow(a, b)", 2, "exponents up to 1024"},
    [FUNCTION_EXP2] = {"exp2", "exp2(a)", 1, NULL},
    [FUNCTION_LOG2] = {"log2", "log2(a)", 1, NULL},
    [FUNCTION_SIN] = {"sin", "sin(a)", 1, "-2 pi to 2 pi"},
    [FUNCTION_COS] = {"cos", "cos(a)", 1, "-2 pi to 2 pi"},
    [FUNCTION_MIX] = {"mix", "mix(a, a.yzwx, b)", 3, "b from 0 to 1"},
    [FUNCTION_REFLECT] = {"reflect", ROTATED("reflect(", ", b.", ".x"), 6, "b up to length 2"},
};

/* A number of the format with this exponent: of the significands half are random, the others near
 * the ends, where it is 1 or almost 2. */
static double number(Random *random, const Format *format, int exponent)
{
    /* ldexp is slow. */
    const uint64_t bits = random_bits(random), count = (uint64_t)1 << (format->bits - 1);
    uint64_t part = bits % count;
    if ((bits >> 40 & 3) == 0)
        part &= 15;
    else if ((bits >> 40 & 3) == 1)
        part |= count - 1 - (part & 15);
    return (double)(count + part) * power_of_two(exponent - format->bits + 1);
}

static double with_sign(Random *random, double value)
{
    return random_bits(random) >> 63 ? -value : value;
}

/* A quarter each: any of these binades, two near 1, those near 1 in the middle of the range, and
 * very near 1. */
static double any_number(Random *random, const Format *format, int low, int high)
{
    switch (random_below(random, 4)) {
    case 0:
        return number(random, format, random_below(random, 2) - 1);
    case 1: { /* 1 plus or minus 2^-1 ... 2^(1 - bits) */
        const double part = number(random, format, -1 - random_below(random, format->bits - 1));
        const double grid = ldexp(1, format->bits);
        return rint((1 + with_sign(random, part)) * grid / 2) * 2 / grid;
    }
    case 2: {
        const int near = 8, from = low > -near ? low : -near, to = high < near ? high : near;
        return number(random, format, from + random_below(random, to - from + 1));
    }
    default:
        return number(random, format, low + random_below(random, high - low + 1));
    }
}

/* Uniform from low to high, rounded to the format. */
static double between(Random *random, const Format *format, double low, double high)
{
    const double value = random_between(random, low, high);
    const double ulp = format_ulp(format, value);
    return rint(value / ulp) * ulp;
}

static void two_numbers(Random *random, Function function, const Format *format, double *x,
                        double *y)
{
    const int low = format->min_exponent, high = format->max_exponent;
    *x = with_sign(random, any_number(random, format, low, high));
    if (function == FUNCTION_ADD && random_below(random, 2)) { /* terms of a size */
        int exponent = 0;
        frexp(*x, &exponent);
        exponent += random_below(random, 2 * format->bits + 3) - format->bits - 2;
        exponent = exponent < low ? low : exponent > high ? high : exponent;
        *y = with_sign(random, number(random, format, exponent));
    } else { /* for larger b no accuracy is promised (GLSL ES 3.20, section 4.7.1) */
        const int most = function == FUNCTION_DIVIDE ? -low - 1 : high;
        *y = with_sign(random, any_number(random, format, low, most));
    }
}

/* Half are what a highlight needs: a base up to 1 or little more, and an exponent up to 1024; the
 * others have a result within the range. */
static void base_and_exponent(Random *random, const Format *format, double *x, double *y)
{
    const int bits = format->bits;
    if (random_below(random, 2)) {
        const double away = random_between(random, 0, 1) * ldexp(1, -random_below(random, bits));
        *x = between(random, format, 1 - away, 1 - 0.9 * away);
        if (random_below(random, 16) == 0)
            *x = between(random, format, 1, 1.02);
        *y = number(random, format, random_below(random, 14) - 4);
        return;
    }
    *x = any_number(random, format, format->min_exponent, format->max_exponent);
    const double power = random_between(random, format->min_exponent, format->max_exponent + 1);
    const double logarithm = log2(*x);
    *y = logarithm == 0 ? 1 : power / logarithm;
    *y = fabs(*y) > 1024 ? random_between(random, -1024, 1024) : *y;
    const double ulp = format_ulp(format, *y);
    *y = rint(*y / ulp) * ulp;
    if (fabs(*y) > format_max(format))
        *y = 1;
}

static double one_number(Random *random, Function function, const Format *format)
{
    static const double PI_2 = 6.283185307179586;
    const int low = format->min_exponent, high = format->max_exponent;
    switch (function) {
    case FUNCTION_EXP2:
        return random_below(random, 2) ? between(random, format, low, high + 1)
                                       : with_sign(random, any_number(random, format, low, 2));
    case FUNCTION_SIN:
    case FUNCTION_COS:
        return random_below(random, 2) ? between(random, format, -PI_2, PI_2)
                                       : with_sign(random, any_number(random, format, low, 1));
    default:
        return any_number(random, format, low, high);
    }
}

/* Vectors: components of a size, whose squares are within the range with a reserve of 2 bits. */
static void vectors(Random *random, Function function, const Format *format, float a[4], float b[4])
{
    const int low = format->min_exponent / 2 + 1, high = format->max_exponent / 2 - 1;
    const bool unit = function == FUNCTION_REFLECT || random_below(random, 2);
    const int size = unit ? 0 : low + 2 + random_below(random, high - low - 3);
    for (int i = 0; i < 4; i++) {
        int exponent = size - random_below(random, 4);
        exponent = exponent < low ? low : exponent;
        a[i] = (float)with_sign(random, number(random, format, exponent));
        b[i] = (float)with_sign(random, number(random, format, -random_below(random, 4) - 1));
    }
    if (function == FUNCTION_MIX)
        for (int i = 0; i < 4; i++)
            b[i] = (float)between(random, format, 0, 1);
}

/* Every number of 16 bits; those that the function has no result for do not count. */
static void every_half(Batch *batch)
{
    for (int i = 0; i < 1 << 16; i++) {
        const int exponent = (i >> 10 & 31), part = i & 1023;
        double value = exponent == 0    ? ldexp(part, -24)
                       : exponent == 31 ? 0
                                        : ldexp(1024 + part, exponent - 25);
        (&batch->a[0][0])[i] = (float)(i >> 15 ? -value : value);
    }
}

static bool is_every_half(Function function, const Format *format)
{
    return FUNCTIONS[function].inputs == 1 && format_is_half(format);
}

int batch_count(Function function, const Format *format, long inputs)
{
    const long each = 4L * BATCH_COUNT;
    return is_every_half(function, format) || inputs < each ? 1 : (int)((inputs + each - 1) / each);
}

/* Exact results, and the magnitude by which an error counts. */

typedef struct Truth {
    double exact, magnitude;
} Truth;

static Truth truth_of_three(Function function, const float a[4], const float b[4], int i)
{
    const double x[3] = {(double)a[i], (double)a[(i + 1) % 4], (double)a[(i + 2) % 4]};
    const double y[3] = {(double)b[i], (double)b[(i + 1) % 4], (double)b[(i + 2) % 4]};
    double dot = 0, terms = 0, square = 0, most = 0;
    for (int k = 0; k < 3; k++) {
        dot += x[k] * y[k];
        terms += fabs(x[k] * y[k]);
        most = fmax(most, fabs(x[k] * y[k]));
        square += x[k] * x[k];
    }
    switch (function) {
    case FUNCTION_LENGTH:
        return (Truth){sqrt(square), 0};
    case FUNCTION_NORMALIZE:
        return (Truth){x[0] / sqrt(square), 0};
    case FUNCTION_DOT:
        return (Truth){dot, most};
    case FUNCTION_REFLECT:
        return (Truth){x[0] - 2 * dot * y[0], fmax(fabs(x[0]), fabs(2 * terms * y[0]))};
    default: /* mix(a, a.yzwx, b), which may be computed as a + b (a.yzwx - a) */
        return (Truth){x[0] * (1 - y[0]) + x[1] * y[0], fmax(fabs(x[0]), fabs(x[1]))};
    }
}

static Truth truth(Function function, const float a[4], const float b[4], int i)
{
    const double x = (double)a[i], y = (double)b[i];
    switch (function) {
    case FUNCTION_ADD:
        return (Truth){x + y, fmax(fabs(x), fabs(y))};
    case FUNCTION_MULTIPLY:
        return (Truth){x * y, 0};
    case FUNCTION_DIVIDE:
        return (Truth){x / y, 0};
    case FUNCTION_SQRT:
        return (Truth){sqrt(x), 0};
    case FUNCTION_INVERSESQRT:
        return (Truth){1 / sqrt(x), 0};
    case FUNCTION_POW:
        return (Truth){x > 0 ? pow(x, y) : (double)NAN, 0}; /* undefined for 0 */
    case FUNCTION_EXP2:
        return (Truth){exp2(x), 0};
    case FUNCTION_LOG2: /* near 0 these three have few digits on most machines: counted as next to 1
                         */
        return (Truth){log2(x), 0.5};
    case FUNCTION_SIN:
        return (Truth){fabs(x) > 6.2832 ? (double)NAN : sin(x), 0.5};
    case FUNCTION_COS:
        return (Truth){fabs(x) > 6.2832 ? (double)NAN : cos(x), 0.5};
    default:
        return truth_of_three(function, a, b, i);
    }
}

void batch_fill(Batch *batch, Function function, const Format *format, int number)
{
    const uint64_t seed = (uint64_t)function << 40 | (uint64_t)number << 8;
    Random random = {seed ^ (uint64_t)format->bits};
    for (int n = 0; n < BATCH_COUNT; n++) {
        float *a = batch->a[n], *b = batch->b[n];
        if (FUNCTIONS[function].inputs > 2) {
            vectors(&random, function, format, a, b);
            continue;
        }
        for (int i = 0; i < 4; i++) {
            double x = 0, y = 0;
            if (FUNCTIONS[function].inputs == 1)
                x = one_number(&random, function, format);
            else if (function == FUNCTION_POW)
                base_and_exponent(&random, format, &x, &y);
            else
                two_numbers(&random, function, format, &x, &y);
            a[i] = (float)x;
            b[i] = (float)y;
        }
    }
    if (is_every_half(function, format))
        every_half(batch);
    for (int n = 0; n < BATCH_COUNT; n++)
        for (int i = 0; i < 4; i++) {
            const Truth is = truth(function, batch->a[n], batch->b[n], i);
            batch->exact[n][i] = is.exact;
            batch->magnitude[n][i] = is.magnitude;
        }
}

/* Highlights: how far a power of a cosine is off, whatever its size. */
static void judge_power(Accuracy *accuracy, float x, float y, double error)
{
    enum { FIRST = -4, LAST = 11 };
    if (!(x > 0 && x <= 1 && y > 0))
        return;
    int exponent = ilogbf(y);
    exponent = exponent < FIRST ? FIRST : exponent > LAST ? LAST : exponent;
    float *most = &accuracy->absolute[exponent - FIRST];
    if (!(error <= (double)*most))
        *most = (float)error;
}

/* Denormals have fewer digits than the error is counted in, and may be taken for 0. */
static bool is_normal(const Format *format, float value)
{
    return value == 0 || fabs((double)value) >= ldexp(1, format->min_exponent);
}

void batch_judge(const Batch *batch, Function function, const Format *format,
                 const float (*results)[4], Accuracy *accuracy)
{
    const int count = is_every_half(function, format) ? (1 << 16) / 4 : BATCH_COUNT;
    for (int n = 0; n < count; n++)
        for (int i = 0; i < 4; i++) {
            const float x = batch->a[n][i], y = batch->b[n][i];
            const double exact = batch->exact[n][i];
            if (FUNCTIONS[function].inputs == 1 && !format->denormal_inputs &&
                !is_normal(format, x))
                continue;
            accuracy_add(accuracy, format, (float[]){x, y}, (double)results[n][i], exact,
                         batch->magnitude[n][i]);
            if (function == FUNCTION_POW)
                judge_power(accuracy, x, y, fabs((double)results[n][i] - exact));
        }
}

#ifdef HAVE_MPFR
enum { MPFR_BITS = 200, SAMPLE_STEP = 61 };

static void mpfr_of_three(mpfr_t result, Function function, const float a[4], const float b[4],
                          int i)
{
    mpfr_t x, y, sum, square;
    mpfr_inits2(MPFR_BITS, x, y, sum, square, (mpfr_ptr)0);
    mpfr_set_zero(sum, 1);
    mpfr_set_zero(square, 1);
    for (int k = 0; k < 3; k++) {
        mpfr_set_flt(x, a[(i + k) % 4], MPFR_RNDN);
        mpfr_mul_d(y, x, (double)b[(i + k) % 4], MPFR_RNDN);
        mpfr_add(sum, sum, y, MPFR_RNDN);
        mpfr_mul(y, x, x, MPFR_RNDN);
        mpfr_add(square, square, y, MPFR_RNDN);
    }
    mpfr_sqrt(square, square, MPFR_RNDN);
    mpfr_set_flt(x, a[i], MPFR_RNDN);
    mpfr_set_flt(y, b[i], MPFR_RNDN);
    if (function == FUNCTION_LENGTH) {
        mpfr_set(result, square, MPFR_RNDN);
    } else if (function == FUNCTION_NORMALIZE) {
        mpfr_div(result, x, square, MPFR_RNDN);
    } else if (function == FUNCTION_DOT) {
        mpfr_set(result, sum, MPFR_RNDN);
    } else if (function == FUNCTION_REFLECT) {
        mpfr_mul(sum, sum, y, MPFR_RNDN);
        mpfr_mul_ui(sum, sum, 2, MPFR_RNDN);
        mpfr_sub(result, x, sum, MPFR_RNDN);
    } else { /* mix: a + (a.yzwx - a) b */
        mpfr_set_flt(sum, a[(i + 1) % 4], MPFR_RNDN);
        mpfr_sub(sum, sum, x, MPFR_RNDN);
        mpfr_mul(sum, sum, y, MPFR_RNDN);
        mpfr_add(result, x, sum, MPFR_RNDN);
    }
    mpfr_clears(x, y, sum, square, (mpfr_ptr)0);
}

static void mpfr_of(mpfr_t result, Function function, const float a[4], const float b[4], int i)
{
    static int (*const of_one[FUNCTION_COUNT])(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t) = {
        [FUNCTION_SQRT] = mpfr_sqrt, [FUNCTION_INVERSESQRT] = mpfr_rec_sqrt,
        [FUNCTION_EXP2] = mpfr_exp2, [FUNCTION_LOG2] = mpfr_log2,
        [FUNCTION_SIN] = mpfr_sin,   [FUNCTION_COS] = mpfr_cos};
    static int (*const of_two[FUNCTION_COUNT])(mpfr_ptr, mpfr_srcptr, mpfr_srcptr,
                                               mpfr_rnd_t) = {[FUNCTION_ADD] = mpfr_add,
                                                              [FUNCTION_MULTIPLY] = mpfr_mul,
                                                              [FUNCTION_DIVIDE] = mpfr_div,
                                                              [FUNCTION_POW] = mpfr_pow};
    mpfr_t x, y;
    mpfr_inits2(MPFR_BITS, x, y, (mpfr_ptr)0);
    mpfr_set_flt(x, a[i], MPFR_RNDN);
    mpfr_set_flt(y, b[i], MPFR_RNDN);
    if (of_one[function])
        of_one[function](result, x, MPFR_RNDN);
    else if (of_two[function])
        of_two[function](result, x, y, MPFR_RNDN);
    else
        mpfr_of_three(result, function, a, b, i);
    mpfr_clears(x, y, (mpfr_ptr)0);
}

bool truth_check(const Batch *batch, Function function, Message *message)
{
    bool right = true;
    mpfr_t exact;
    mpfr_init2(exact, MPFR_BITS);
    for (int n = 0; n < BATCH_COUNT && right; n += SAMPLE_STEP) {
        const int i = n % 4;
        const double is = batch->exact[n][i];
        const double size = fmax(fabs(is), batch->magnitude[n][i]);
        mpfr_of(exact, function, batch->a[n], batch->b[n], i);
        if (!isfinite(is) || !(size > 0x1p-1000))
            continue;
        mpfr_sub_d(exact, exact, is, MPFR_RNDN);
        const double error = fabs(mpfr_get_d(exact, MPFR_RNDN));
        if (!(error <= 0x1p-48 * size))
            right = message_set(message,
                                "%s: this system's mathematical library is %.2g of the result off "
                                "for %.9g and %.9g, where MPFR is the truth",
                                FUNCTIONS[function].name, error / size, (double)batch->a[n][i],
                                (double)batch->b[n][i]);
    }
    mpfr_clear(exact);
    mpfr_free_cache();
    return right;
}

bool truth_is_checked(void)
{
    return true;
}
#else
bool truth_check(const Batch *batch, Function function, Message *message)
{
    (void)batch;
    (void)function;
    (void)message;
    return true;
}

bool truth_is_checked(void)
{
    return false;
}
#endif
