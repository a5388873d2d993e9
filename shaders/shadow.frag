// shadow.frag: marks a pixel as in shadow; only the channel of one light is written.

#if defined(DRAW_MAP) || defined(LOOK_UP)
precision highp float;
#else
precision mediump float;
#endif

#if defined(DRAW_MAP) && defined(PACKED)
varying highp vec2 v_Depth;
#endif

#ifdef LOOK_UP
#include "lighting/shadow_map.glsl"
#endif

void main() {
#ifdef DRAW_MAP
#ifdef PACKED
    vec3 parts = fract((0.5 * v_Depth.x / v_Depth.y + 0.5) * vec3(1.0, 255.0, 65025.0));
    parts.xy -= parts.yz / 255.0;
    gl_FragColor = vec4(parts, 1.0);
#else
    gl_FragColor = vec4(1.0);
#endif
#elif defined(LOOK_UP)
    float shadow = find_shadow();
    if (shadow == 0.0)
        discard; // another map of the same light may know
    gl_FragColor = vec4(shadow);
#else
    gl_FragColor = vec4(1.0);
#endif
}
