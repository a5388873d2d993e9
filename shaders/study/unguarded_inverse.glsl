// unguarded_inverse.glsl: lighting/guards.glsl with one function unguarded.

#define safe_inverse guarded_inverse
#include "../lighting/guards.glsl"
#undef safe_inverse

float safe_inverse(float denominator) {
    return 1.0 / denominator;
}
