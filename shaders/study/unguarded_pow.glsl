// unguarded_pow.glsl: lighting/guards.glsl with one function unguarded.

#define safe_pow guarded_pow
#include "../lighting/guards.glsl"
#undef safe_pow

float safe_pow(float base, float exponent) {
    return pow(max(base, 0.0), exponent);
}
