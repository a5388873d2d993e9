// unguarded_normalize.glsl: lighting/guards.glsl with one function unguarded.

#define safe_normalize guarded_normalize
#include "../lighting/guards.glsl"
#undef safe_normalize

vec3 safe_normalize(vec3 v) {
    return normalize(v);
}
