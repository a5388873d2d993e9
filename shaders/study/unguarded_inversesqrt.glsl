// unguarded_inversesqrt.glsl: lighting/guards.glsl with one function unguarded.

#define safe_inversesqrt guarded_inversesqrt
#include "../lighting/guards.glsl"
#undef safe_inversesqrt

float safe_inversesqrt(float square) {
    return inversesqrt(square);
}
