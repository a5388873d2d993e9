/*
 * Between the roots of its derivative a polynomial is monotonic. Those are found in the same way,
 * down to a constant; then each interval between them at whose ends the signs differ has exactly
 * one root, which is bracketed. Closed forms of quartics lose digits where roots lie close; a
 * bracket does not.
 */
#include "reference/reference_solid.h"

static Real evaluate(const Real *c, int degree, Real s)
{
    Real sum = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        sum = sum * s + c[i];
    return sum;
}

/* The root of a polynomial that is monotonic between low and high, where its signs differ: Newton's
 * steps, or halves where those leave the bracket. (Numerical Recipes in C, section 9.4) */
static Real bracketed_root(const Real *c, int degree, Real low, Real high)
{
    Real slope[4];
    for (int i = 0; i < degree; i++)
        slope[i] = c[i + 1] * (i + 1);
    const bool rising = evaluate(c, degree, high) > 0;
    Real s = (low + high) / 2;
    for (int i = 0; i < 200; i++) {
        const Real value = evaluate(c, degree, s);
        if (value == 0)
            break;
        *((value > 0) == rising ? &high : &low) = s;
        const Real gradient = evaluate(slope, degree - 1, s);
        Real next = gradient != 0 ? s - value / gradient : low;
        if (!(next > low && next < high))
            next = (low + high) / 2;
        if (real_abs(next - s) <= 2 * REAL_EPSILON * real_max(real_abs(low), real_abs(high)))
            break;
        s = next;
    }
    return s;
}

int polynomial_roots(const Real *c, int degree, Real low, Real high, Real *roots)
{
    Real slope[4], turns[6];
    int count = 0, turn_count = 0;
    if (degree == 0)
        return 0;
    for (int i = 0; i < degree; i++)
        slope[i] = c[i + 1] * (i + 1);
    turns[0] = low;
    turn_count = 1 + polynomial_roots(slope, degree - 1, low, high, turns + 1);
    turns[turn_count] = high;
    for (int i = 0; i < turn_count; i++)
        if ((evaluate(c, degree, turns[i]) > 0) != (evaluate(c, degree, turns[i + 1]) > 0))
            roots[count++] = bracketed_root(c, degree, turns[i], turns[i + 1]);
    return count;
}
