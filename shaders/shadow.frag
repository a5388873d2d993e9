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
uniform mat4 u_MapFromLight;
uniform vec4 u_MapSize; // in texels; 1 over that; a texel's width, at distance 1; 1 if that grows
uniform vec4 u_Bias;    // in texels: towards the light, that times the slope, along the normal
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

// The place on the map, and the depth to compare.
vec3 map_place() {
    vec3 to_light = mix(vec3(0.0, 0.0, 1.0), normalize(-v_Place), u_MapSize.w);
    vec3 normal = v_Normal * inversesqrt(max(dot(v_Normal, v_Normal), 1e-37));
    float cosine = dot(normal, to_light); // where it is negative, nothing is lit
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float texel = u_MapSize.z * mix(1.0, -v_Place.z, u_MapSize.w);
    float nearer = u_Bias.x + u_Bias.y * min(sine / max(abs(cosine), 1e-3), 20.0);
    vec3 moved = v_Place + texel * (nearer * to_light + u_Bias.z * sine * sign(cosine) * normal);
    vec4 map = u_MapFromLight * vec4(moved, 1.0);
    if (map.w <= 0.0 || max(abs(map.x), abs(map.y)) >= map.w)
        discard; // beside all that throws shadows
    vec3 at = 0.5 * map.xyz / map.w + 0.5;
    return vec3(at.xy, min(at.z, 1.0)); // nothing throws shadows from beyond the map's depth
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
    vec3 at = map_place();
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
    if (shadow == 0.0)
        discard;
    gl_FragColor = vec4(shadow);
#else
#ifdef FLATTEN
    if (min(v_Between.x, v_Between.y) <= 0.0)
        discard;
#endif
    gl_FragColor = vec4(1.0);
#endif
}
