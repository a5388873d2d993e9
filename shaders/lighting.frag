// lighting.frag: the lighting model of lighting.vert, per fragment.

precision highp float;

#if defined(BASE) && !defined(VERTEX_LIGHTS)
#define FRAGMENT_BASE
#endif
#ifdef FRAGMENT_COLOR
varying vec3 v_Color;
#endif
#ifdef ALPHA
uniform float u_FrontAlpha;
#ifdef TWO_SIDED
uniform float u_BackAlpha;
#endif
#endif

#ifdef VERTEX_LIGHTS
varying vec3 v_FrontColor;
#ifdef TWO_SIDED
varying vec3 v_BackColor;
#endif
#endif
#ifdef FRAGMENT_NORMALS
varying vec3 v_Normal;
#endif
#ifdef FRAGMENT_POSITION
varying vec3 v_Position;
#endif

#ifdef MEDIUMP // 16 bits, perhaps: 6.1e-5 to 65504
#define LEAST 6.2e-5
#define MOST 6e4
#else
#define LEAST 1e-37
#define MOST 1e37
#endif
#include "lighting/common.glsl"
#include "lighting/output.glsl"
#ifdef FRAGMENT_BASE
#include "lighting/base.glsl"
#endif
#if defined(FRAGMENT_LIGHTS) || defined(VERTEX_SHADOWS)
#include "lighting/fragment_groups.glsl"
#endif

#ifdef TWO_SIDED
#include "lighting/side.glsl"
#define SIDE(front, back) (is_front() ? front : back)
#else
#define SIDE(front, back) front
#endif

#ifdef LINEAR
// IEC 61966-2-1.
vec3 srgb_encode(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055;
    return mix(low, high, step(vec3(0.0031308), linear));
}
#endif

void main() {
#ifdef FRAGMENT_COLOR
    surface_color = v_Color;
#endif
#ifdef LOOK_UP_SHADOWS
    look_up_shadows();
#endif
    vec3 color = vec3(0.0);
#ifdef VERTEX_LIGHTS
    color = SIDE(v_FrontColor, v_BackColor); // with the base
#ifdef VERTEX_SHADOWS
    color += SHADOWED_LIGHT;
#endif
#elif defined(FRAGMENT_BASE)
    color = SIDE(FRONT_BASE, BACK_BASE);
#endif

#ifdef FRAGMENT_LIGHTS
    vec3 normal = vec3(0.0);
    vec3 position = vec3(0.0);
#ifdef FRAGMENT_NORMALS
    normal = SIDE(v_Normal, BACK(v_Normal));
#ifdef NORMALIZE_FRAGMENT
    normal = safe_normalize(normal);
#endif
#endif
#ifdef FRAGMENT_POSITION
    position = v_Position;
#endif
    add_lights(normal, position, VIEWER(position), SIDE(true, false), color);
#endif

#ifdef SHOW_CLIPPED
    if (max(max(color.r, color.g), color.b) > 1.0)
        color = vec3(1.0, 0.0, 1.0);
#endif
#ifdef LINEAR
    color = srgb_encode(clamp(color, 0.0, 1.0));
#endif
#ifdef LIMIT
    color = min(color, vec3(min(MOST, 1e6))); // what the framebuffer clamps, as an integer
#endif
    // The sum is clamped once, here, by the framebuffer.
#ifdef ALPHA
    gl_FragColor = vec4(output_color(color), SIDE(u_FrontAlpha, u_BackAlpha));
#else
    gl_FragColor = vec4(output_color(color), 1.0);
#endif
}
