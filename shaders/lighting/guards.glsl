// guards.glsl: keeps results finite if a formula of the book divides by zero or leaves its domain.
// LEAST and MOST bound the range of the stage's floats.

// 1 / length, from its square; large, not infinite, for length 0.
float safe_inversesqrt(float square) {
    return inversesqrt(max(square, LEAST));
}

// The zero vector stays zero; normalize returns NaN.
vec3 safe_normalize(vec3 v) {
    return v * safe_inversesqrt(dot(v, v));
}

// The share of light that arrives.
float safe_inverse(float denominator) {
    return 1.0 / max(denominator, LEAST);
}

// max(base, 0) to a power. 0 to the power of 0 is undefined in GLSL, and 1 here.
float safe_pow(float base, float exponent) {
    return base > 0.0 ? pow(base, exponent) : float(exponent == 0.0);
}

// No highlight if the light is behind the surface: the factor f of the equation.
float facing(float n_dot_l, float highlight) {
    return n_dot_l > 0.0 ? highlight : 0.0;
}
