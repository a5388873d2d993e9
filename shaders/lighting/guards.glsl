// guards.glsl: what keeps the cases finite in which a formula of the book divides by zero or leaves
// its domain. Compiled in where the scene may come to such a case. LEAST and MOST are numbers that
// the stage's arithmetic has.

#ifdef GUARDS
// The inverse of a length, of its square. Of no length: large, where inversesqrt gives infinity.
float safe_inversesqrt(float square) {
    return inversesqrt(max(square, LEAST));
}

// A vector of no length stays one, where normalize would give NaN.
vec3 safe_normalize(vec3 v) {
    return v * safe_inversesqrt(dot(v, v));
}

// The share of light that arrives.
float safe_inverse(float denominator) {
    return 1.0 / max(denominator, LEAST);
}
#endif

// Two that are terms of the equation, and always there:

// max(N.H, 0), to a power. 0 to the power of 0 is undefined in GLSL, and 1 here, as for any other
// number.
float safe_pow(float base, float exponent) {
    return base > 0.0 ? pow(base, exponent) : float(exponent == 0.0);
}

// Behind the surface there is no highlight: the equation's factor f.
float facing(float n_dot_l, float highlight) {
    return n_dot_l > 0.0 ? highlight : 0.0;
}
