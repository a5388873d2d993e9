/*
 * A dot product is at most the product of its vectors' lengths, which ranges of single numbers do
 * not say: those of a unit vector allow a length of sqrt(3). Lengths are read from how the vectors
 * were computed: normalized, scaled, turned around, mirrored.
 */
#include "glsl/glsl_bound_tape.h"

enum { MOST = 4, DEEPEST = 8 };

/* Without conversions and what narrowed it. */
static int bare(const State *state, int at)
{
    while (state->entries[at].op == OP_SET && state->entries[at].from[0] >= 0)
        at = state->entries[at].from[0];
    return at;
}

static int operand(const State *state, int at, int side)
{
    const int from = state->entries[at].from[side];
    return from < 0 ? at : bare(state, from);
}

/* Whether a number is the dot product of two vectors, its terms in any order. */
static bool is_dot(const State *state, int at, const int *a, const int *b, int count)
{
    unsigned found = 0;
    for (int k = 0; k < count; k++) {
        const bool sums = k < count - 1;
        if (sums && state->entries[at].op != OP_ADD)
            return false;
        const int term = sums ? operand(state, at, 1) : at;
        at = operand(state, at, 0);
        const int x = operand(state, term, 0), y = operand(state, term, 1);
        for (int i = 0; i < count && state->entries[term].op == OP_MULTIPLY; i++)
            if ((x == a[i] && y == b[i]) || (x == b[i] && y == a[i]))
                found |= 1U << i;
    }
    return found == (1U << count) - 1;
}

/* The same factor of each number of a vector, and the others; -1: there is none. */
static int factor_of(const State *state, const int *v, int count, int others[MOST])
{
    for (int side = 0; side < 2; side++) {
        const int factor = operand(state, v[0], side);
        bool common = true;
        for (int i = 0; i < count && common; i++) {
            const int x = operand(state, v[i], 0), y = operand(state, v[i], 1);
            common = state->entries[v[i]].op == OP_MULTIPLY && (x == factor || y == factor);
            others[i] = x == factor ? y : x;
        }
        if (common)
            return factor;
    }
    return -1;
}

/* Whether a factor is 1 / the vector's length, or less. */
static bool normalizes(const State *state, int factor, const int *v, int count)
{
    if (state->entries[factor].op != OP_INVERSE_SQRT)
        return false;
    const int square = operand(state, factor, 0);
    if (state->entries[square].op != OP_MAX)
        return is_dot(state, square, v, v, count);
    return is_dot(state, operand(state, square, 0), v, v, count) ||
           is_dot(state, operand(state, square, 1), v, v, count);
}

static double length_of(const State *state, const int *v, int count, int depth);

/* Of 2 dot(n, l) n less l, or l less that, it is that of l, for a unit vector n. */
static double length_of_mirrored(const State *state, const int *scaled, const int *l, int count,
                                 int depth)
{
    int n[MOST], others[MOST];
    const int factor = factor_of(state, scaled, count, n);
    const int twice = factor < 0 ? -1 : factor_of(state, &factor, 1, others);
    if (twice < 0)
        return (double)INFINITY;
    const bool first = is_dot(state, others[0], n, l, count);
    const GlslRange two = state->entries[first ? twice : others[0]].exact;
    if (!(first || is_dot(state, twice, n, l, count)) || two.low != 2 || two.high != 2)
        return (double)INFINITY;
    const double normal = length_of(state, n, count, depth);
    return larger(2 * normal * normal - 1, 1) * length_of(state, l, count, depth);
}

/* The largest length. */
static double length_of(const State *state, const int *v, int count, int depth)
{
    double squares = 0;
    int parts[2][MOST];
    bool turned = true, sums = true;
    for (int i = 0; i < count; i++) {
        const int op = state->entries[v[i]].op;
        squares += magnitude(state->entries[v[i]].exact) * magnitude(state->entries[v[i]].exact);
        turned &= op == OP_NEGATE;
        sums &= op == OP_ADD || op == OP_SUBTRACT;
        for (int k = 0; k < 2; k++)
            parts[k][i] = operand(state, v[i], k);
    }
    double length = sqrt(squares);
    if (depth >= DEEPEST)
        return length;
    if (turned)
        return smaller(length_of(state, parts[0], count, depth + 1), length);
    for (int k = 0; k < 2 && sums; k++)
        length = smaller(length_of_mirrored(state, parts[k], parts[!k], count, depth + 1), length);
    const int factor = sums ? -1 : factor_of(state, v, count, parts[0]);
    if (factor < 0)
        return length;
    return smaller(normalizes(state, factor, parts[0], count)
                       ? 1
                       : magnitude(state->entries[factor].exact) *
                             length_of(state, parts[0], count, depth + 1),
                   length);
}

void tape_narrow_dot(const GlslBoundRun *run, int count, int sum, int term, GlslRange *exact)
{
    const State *state = run->state;
    int v[2][MOST];
    for (int i = 0; i < count; i++) {
        const bool last = i == count - 1;
        term = bare(state, i ? (last ? sum : operand(state, sum, 1)) : term);
        sum = i && !last ? operand(state, sum, 0) : bare(state, sum);
        if (state->entries[term].op != OP_MULTIPLY)
            return;
        for (int k = 0; k < 2; k++)
            v[k][i] = operand(state, term, k);
    }
    double most = length_of(state, v[0], count, 0) * length_of(state, v[1], count, 0);
    most += most * 0x1p-48; /* these are rounded */
    exact->low = larger(-most, exact->low);
    exact->high = smaller(most, exact->high);
}
