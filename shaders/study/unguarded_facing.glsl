// unguarded_facing.glsl: lighting/guards.glsl with one function unguarded.

#define facing guarded_facing
#include "../lighting/guards.glsl"
#undef facing

float facing(float n_dot_l, float highlight) {
    return highlight;
}
