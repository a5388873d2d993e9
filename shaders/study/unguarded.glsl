// unguarded.glsl: lighting/guards.glsl without guards: the formulas of the book.

float safe_inversesqrt(float square) {
    return inversesqrt(square);
}

vec3 safe_normalize(vec3 v) {
    return normalize(v);
}

float safe_inverse(float denominator) {
    return 1.0 / denominator;
}

float safe_pow(float base, float exponent) {
    return pow(max(base, 0.0), exponent);
}

float facing(float n_dot_l, float highlight) {
    return highlight;
}
