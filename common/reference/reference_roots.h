/*
 * reference_roots: the real roots of polynomials of at most the fourth degree.
 */
#ifndef REFERENCE_ROOTS_H
#define REFERENCE_ROOTS_H

#include "reference/reference_real.h"

/* All roots of c[0] + c[1] s + ... + c[degree] s^degree between low and high, in their order;
 * returns their number. Where it touches 0 without a change of sign there is none. */
int polynomial_roots(const Real *c, int degree, Real low, Real high, Real *roots);

#endif
