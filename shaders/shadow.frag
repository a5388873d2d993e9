// shadow.frag: marks a pixel as in shadow; only the channel of one light is written.

#if defined(DRAW_MAP) || defined(LOOK_UP) || defined(FLATTEN)
precision highp float;
#else
precision mediump float;
#endif

#ifdef FLATTEN
varying highp vec2 v_Between;
#endif

#if defined(DRAW_MAP) && defined(PACKED)
varying highp vec2 v_Depth;
#endif

#ifdef LOOK_UP
varying highp vec3 v_Place; // from the light, which looks along -z
varying highp vec3 v_Normal;
uniform vec3 u_MapScale; // to the map's texture and depth, from 0 to 1; in perspective of (x, y, 1)
uniform vec3 u_MapMove;
uniform vec3 u_MapSize; // in texels; 1 over that; a texel's width, in perspective at distance 1
uniform vec3 u_Bias;    // in texels: towards the light, that times the slope, along the normal
uniform highp sampler2D u_Map; // without it 16 bits are enough for a driver

float map_depth(vec2 at) {
#ifdef PACKED
    return dot(texture2D(u_Map, at).rgb, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0));
#else
    return texture2D(u_Map, at).r;
#endif
}

float hidden(vec3 at) {
    return map_depth(at.xy) < at.z ? 1.0 : 0.0;
}

// The place on the map, and the depth to compare. False: beside all that throws shadows.
bool find_place(out vec3 at) {
    vec3 place = v_Place;
#ifdef PERSPECTIVE
#define TO_LIGHT (-v_Place)
    float squares = dot(v_Normal, v_Normal) * dot(TO_LIGHT, TO_LIGHT);
#else
#define TO_LIGHT vec3(0.0, 0.0, 1.0)
    float squares = dot(v_Normal, v_Normal);
#endif
    float along = dot(v_Normal, TO_LIGHT); // where it is negative, nothing is lit
    // The tangent of the angle of arrival, up to 20.
    float sines = max(squares - along * along, 0.0);
    float slope = sqrt(sines / max(max(along * along, squares / 401.0), 1e-37));
    float nearer = u_MapSize.z * (u_Bias.x + u_Bias.y * slope);
#ifdef ALONG_NORMAL
    float texel = u_MapSize.z * sqrt(sines / max(squares, 1e-37)) *
                  inversesqrt(max(dot(v_Normal, v_Normal), 1e-37));
#ifdef PERSPECTIVE
    texel *= -v_Place.z;
#endif
    place += texel * u_Bias.z * sign(along) * v_Normal;
#endif
    // Towards the light is straight up from the map; a texel is as much wider as it is farther.
#ifdef PERSPECTIVE
    float inverse = 1.0 / max(-place.z, 1e-37);
    at = inverse * u_MapScale * vec3(place.xy, 1.0 + nearer) + u_MapMove;
    bool before = place.z < 0.0;
#else
    at = u_MapScale * vec3(place.xy, place.z + nearer) + u_MapMove;
    const bool before = true;
#endif
    at.z = min(at.z, 1.0); // nothing throws shadows from beyond the map's depth
    return before && max(abs(at.x - 0.5), abs(at.y - 0.5)) < 0.5;
}

float find_shadow() {
    vec3 at;
    bool there = find_place(at);
#ifdef SMOOTH
    vec2 texels = at.xy * u_MapSize.x - 0.5;
    vec2 share = fract(texels);
    vec3 low = vec3((floor(texels) + 0.5) * u_MapSize.y, at.z);
    vec3 next = vec3(u_MapSize.y, 0.0, 0.0);
    float shadow = mix(mix(hidden(low), hidden(low + next.xyz), share.x),
                       mix(hidden(low + next.yxz), hidden(low + next.xxz), share.x), share.y);
#else
    float shadow = hidden(at);
#endif
    return there ? shadow : 0.0;
}
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
#ifndef ALONE
    if (shadow == 0.0)
        discard; // another map of the same light may know
#endif
    gl_FragColor = vec4(shadow);
#else
#ifdef FLATTEN
    if (min(v_Between.x, v_Between.y) <= 0.0)
        discard;
#endif
    gl_FragColor = vec4(1.0);
#endif
}
