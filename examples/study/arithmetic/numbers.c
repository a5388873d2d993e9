/*
 * What floating-point numbers a machine computes with, told from what it computes, after Malcolm
 * (Algorithms to reveal properties of floating-point arithmetic, CACM 15, 1972): 1 plus a power of
 * two differs from 1 as long as the significand has its bits; sums half way between two numbers
 * tell how results are rounded; products at the ends of the range tell exponents, subnormal numbers
 * and infinity. Errors are counted in units in the last place of the exact result.
 */
#include "study/arithmetic/functions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool format_equal(const Format *a, const Format *b)
{
    return a->bits == b->bits && a->min_exponent == b->min_exponent &&
           a->max_exponent == b->max_exponent && a->denormals == b->denormals &&
           a->denormal_inputs == b->denormal_inputs && a->rounding == b->rounding &&
           a->infinity == b->infinity && a->nan == b->nan;
}

bool format_is_half(const Format *format)
{
    return format->bits == 11 && format->max_exponent == 15 && format->min_exponent == -14;
}

double format_max(const Format *format)
{
    return (2 - power_of_two(1 - format->bits)) * power_of_two(format->max_exponent);
}

double format_unit(const Format *format)
{
    return power_of_two(-format->bits);
}

/* The exponent of a finite number but 0; faster than ilogb. */
static int exponent_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int biased = (int)(bits >> 52 & 0x7FF);
    return biased ? biased - 1023 : -1023;
}

double format_ulp(const Format *format, double magnitude)
{
    const int exponent = exponent_of(magnitude);
    return power_of_two((exponent > format->min_exponent ? exponent : format->min_exponent) -
                        format->bits + 1);
}

/* Sums of +-1 or its upper neighbour with a part of the last place, for every number of bits. */
enum { MAX_BITS = 24, SUMS_PER_BIT = 8, SUM_SPECIAL = MAX_BITS * SUMS_PER_BIT };

typedef enum SumKind {
    SUM_EXACT, /* 1 + 2^(1 - bits): there if there are so many bits */
    SUM_TIE,   /* 1 + half of that */
    SUM_ODD,   /* the next number + half: a tie, too */
    SUM_ABOVE,
    SUM_BELOW,
    SUM_MINUS, /* from here on negative */
} SumKind;

static void sum_of(int bits, SumKind kind, float *x, float *y)
{
    const double last = ldexp(1, 1 - bits);
    const double parts[SUMS_PER_BIT] = {1, 0.5, 0.5, 0.75, 0.25, 0.5, 0.75, 0.25};
    const double sign = kind >= SUM_MINUS ? -1 : 1;
    *x = (float)(sign * (kind == SUM_ODD ? 1 + last : 1));
    *y = (float)(sign * parts[kind] * last);
}

void format_sums(FormatProbes *probes)
{
    memset(probes, 0, sizeof *probes);
    for (int bits = 1; bits <= MAX_BITS; bits++)
        for (int kind = 0; kind < SUMS_PER_BIT; kind++) {
            const int i = (bits - 1) * SUMS_PER_BIT + kind;
            sum_of(bits, (SumKind)kind, &probes->x[i], &probes->y[i]);
        }
    probes->x[SUM_SPECIAL] = INFINITY;
    probes->y[SUM_SPECIAL] = -INFINITY;
}

/* Products that are 2^k on their way, k from FIRST_POWER to its opposite, and come back near 1;
 * from number INPUTS on those of which the first factor is 2^k, from FIRST_POWER on, and the second
 * brings it back. */
enum { FIRST_POWER = -170, INPUTS = 1 - 2 * FIRST_POWER };

static int back_of(int power)
{
    return -(power / 2);
}

void format_products(FormatProbes *probes)
{
    for (int i = 0; i < FORMAT_PROBES; i++) {
        const int power = FIRST_POWER + i, half = power / 2;
        const bool possible = power <= -FIRST_POWER;
        probes->x[i] = possible ? ldexpf(1, half) : 0;
        probes->y[i] = possible ? ldexpf(1, power - half) : 0;
        probes->z[i] = possible ? ldexpf(1, back_of(power)) : 0;
    }
    for (int i = INPUTS; i < FORMAT_PROBES; i++) {
        const int power = FIRST_POWER + i - INPUTS;
        probes->x[i] = ldexpf(1, power);
        probes->y[i] = ldexpf(1, back_of(power));
        probes->z[i] = 1;
    }
}

static bool passes(const float *products, int power)
{
    return products[power - FIRST_POWER] == ldexpf(1, power + back_of(power));
}

static bool passes_as_input(const float *products, int power)
{
    return products[INPUTS + power - FIRST_POWER] == ldexpf(1, power + back_of(power));
}

static Rounding rounding_of(const float *sums, int bits)
{
    const float *r = sums + (bits - 1) * SUMS_PER_BIT;
    const float last = ldexpf(1, 1 - bits), next = 1 + last;
    const bool minus_up = r[6] == -next, minus_down = r[7] == -1;
    if (r[SUM_ABOVE] == next && r[SUM_BELOW] == 1 && minus_up && minus_down)
        return r[SUM_TIE] == 1 && r[SUM_ODD] == next + last && r[SUM_MINUS] == -1
                   ? ROUNDING_NEAREST_EVEN
                   : ROUNDING_NEAREST;
    return r[SUM_ABOVE] == 1 && r[SUM_BELOW] == 1 && r[6] == -1 ? ROUNDING_ZERO : ROUNDING_OTHER;
}

bool format_of(const float sums[FORMAT_PROBES], const float products[FORMAT_PROBES], Format *format)
{
    int bits = 0, low = 0, high = 0;
    for (int i = 1; i <= MAX_BITS; i++)
        if (sums[(i - 1) * SUMS_PER_BIT + SUM_EXACT] == 1 + ldexpf(1, 1 - i))
            bits = i;
    while (high < -FIRST_POWER && passes(products, high + 1))
        high++;
    while (low > FIRST_POWER && passes(products, low - 1))
        low--;
    if (bits < 2 || high < 2 || low > -2)
        return false;
    /* As IEEE 754 has it, the range of normal numbers is 1 - high to high; what is below are
     * denormals. */
    *format = (Format){
        .bits = bits,
        .max_exponent = high,
        .min_exponent = low < 1 - high ? 1 - high : low,
        .denormals = low < 1 - high,
        .denormal_inputs = passes_as_input(products, -1 - high),
        .rounding = rounding_of(sums, bits),
        .infinity = !isfinite(products[high + 1 - FIRST_POWER]),
        .nan = isnan(sums[SUM_SPECIAL]),
    };
    return true;
}

void claim_text(const Claim *claim, const Format *format, char text[CLAIM_SIZE])
{
    const bool unknown = claim->min == 0 && claim->max == 0 && claim->bits == 0;
    const bool bits = claim->bits + 1 != format->bits, range = claim->max != format->max_exponent;
    text[0] = '\0';
    /* The claimed range is that of magnitudes: 127 of floats and 15 of halves. */
    if (!unknown && bits)
        snprintf(text, CLAIM_SIZE, "says %d bits, computes with %d", claim->bits + 1, format->bits);
    else if (!unknown && range)
        snprintf(text, CLAIM_SIZE, "says up to 2^%d, computes up to 2^%d", claim->max + 1,
                 format->max_exponent + 1);
}

void accuracy_add(Accuracy *accuracy, const Format *format, const float at[2], double result,
                  double exact, double magnitude)
{
    const double size = fabs(exact) > magnitude ? fabs(exact) : magnitude;
    if (!(size >= power_of_two(format->min_exponent)) || !(size <= format_max(format)))
        return;
    /* At the ends of the range a few units decide whether a result leaves it. */
    const double least = power_of_two(format->min_exponent + 1);
    if (!isfinite(exact) || (isinf(result) && size > format_max(format) / 2) ||
        (fabs(exact) < least && fabs(result) < least / 2))
        return;
    accuracy->count++;
    const double error = fabs(result - exact) / format_ulp(format, size);
    if (!(error < INFINITY)) { /* NaN, too */
        if (accuracy->wrong++ == 0) {
            memcpy(accuracy->at, at, sizeof accuracy->at);
        }
        return;
    }
    accuracy->sum += error;
    const int binade = exponent_of((double)at[0]) - NUMBER_FIRST_BINADE;
    if (binade >= 0 && binade < NUMBER_BINADES && error > accuracy->by_binade[binade])
        accuracy->by_binade[binade] = (float)error;
    if (error > accuracy->largest) {
        accuracy->largest = error;
        if (accuracy->wrong == 0) {
            memcpy(accuracy->at, at, sizeof accuracy->at);
        }
    }
}

double accuracy_mean(const Accuracy *accuracy)
{
    const uint64_t finite = accuracy->count - accuracy->wrong;
    return finite ? accuracy->sum / (double)finite : 0;
}
