// shadow_map.glsl: how much of a fragment is in the shadow that a map shows. Included once per map,
// with the uniforms, varyings and functions renamed.

#define MAX_SLOPE 20.0

varying highp vec3 v_MapPlace; // from the light, which looks along -z
varying highp vec3 v_MapNormal;
uniform vec3 u_MapScale; // to the map's texture and depth, from 0 to 1; in perspective of (x, y, 1)
uniform vec3 u_MapMove;
uniform vec3 u_MapSize; // in texels; 1 over that; a texel's width, in perspective at distance 1
uniform vec3 u_MapBias; // in texels: towards the light, that times the slope, along the normal
uniform highp sampler2D u_Map; // without it 16 bits are enough for a driver

float map_depth(vec2 at) {
#ifdef PACKED
    return dot(texture2D(u_Map, at).rgb, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0));
#else
    return texture2D(u_Map, at).r;
#endif
}

float is_behind(vec3 at) {
    return map_depth(at.xy) < at.z ? 1.0 : 0.0;
}

// The place on the map, and the depth to compare. False: beside all that throws shadows.
bool find_place(out vec3 at) {
    vec3 place = v_MapPlace;
#ifdef PERSPECTIVE
#define TO_LIGHT (-v_MapPlace)
    float squares = dot(v_MapNormal, v_MapNormal) * dot(TO_LIGHT, TO_LIGHT);
#else
#define TO_LIGHT vec3(0.0, 0.0, 1.0)
    float squares = dot(v_MapNormal, v_MapNormal);
#endif
    float along = dot(v_MapNormal, TO_LIGHT); // where it is negative, nothing is lit
    // The squares of sine and cosine of the angle of arrival, times `squares`; the angle's tangent.
    float sines = max(squares - along * along, 0.0);
    float cosines = max(along * along, squares / (1.0 + MAX_SLOPE * MAX_SLOPE));
    float slope = sqrt(sines / max(cosines, 1e-37));
    float nearer = u_MapSize.z * (u_MapBias.x + u_MapBias.y * slope);
#ifdef ALONG_NORMAL
    float texel = u_MapSize.z * sqrt(sines / max(squares, 1e-37)) *
                  inversesqrt(max(dot(v_MapNormal, v_MapNormal), 1e-37));
#ifdef PERSPECTIVE
    texel *= -v_MapPlace.z;
#endif
    place += texel * u_MapBias.z * sign(along) * v_MapNormal;
#endif
    // Towards the light is straight up from the map; a texel is as much wider as it is farther.
#ifdef PERSPECTIVE
    at = 1.0 / max(-place.z, 1e-37) * u_MapScale * vec3(place.xy, 1.0 + nearer) + u_MapMove;
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
    float shadow = mix(mix(is_behind(low), is_behind(low + next.xyz), share.x),
                       mix(is_behind(low + next.yxz), is_behind(low + next.xxz), share.x), share.y);
#else
    float shadow = is_behind(at);
#endif
    return there ? shadow : 0.0;
}

#undef TO_LIGHT
#undef MAX_SLOPE
