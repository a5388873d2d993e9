// catalogue: see catalogue.vert.

precision highp float;
precision highp int;

uniform int u_Facing;     // FACING_
uniform vec3 u_Axis;      // of the camera, towards the eye
uniform float u_Mirrored; // -1 if the model matrix mirrors
uniform int u_BackNormal; // 1: reversed on the back
uniform int u_Discard;    // CULL_
uniform float u_Gamma;
uniform float u_Most; // no channel is larger
uniform int u_Output; // OUTPUT_

varying vec3 v_Place;
varying vec3 v_Normal;
varying vec3 v_Toward[2];
varying vec3 v_Color;

#include "catalogue_light.glsl"

#ifdef SHADOWS
uniform highp sampler2D u_Map;
uniform int u_MapPlace;   // MAP_PLACE_
uniform int u_MapDepth;   // MAP_DEPTH_
uniform vec3 u_MapBias;   // constant; times one minus the cosine, if that is more; divided by w
uniform int u_MapTest;    // MAP_TEST_
uniform int u_MapOutside; // MAP_OUTSIDE_
uniform float u_ShadowLight; // what a shadow leaves
uniform float u_MapLight;    // the visibility of what the map shows in light

varying vec4 v_Map;
varying vec3 v_MapDivided;
varying vec3 v_Shade;

float visibility(vec3 normal) {
    bool whole = u_MapPlace == MAP_PLACE_NO_W_RANGE;
    vec3 place = u_MapPlace == MAP_PLACE_NO_W || whole ? v_Map.xyz : v_Map.xyz / v_Map.w;
    if (u_MapPlace == MAP_PLACE_VERTICES)
        place = v_MapDivided;
    vec3 at = 0.5 * place + 0.5;
    whole = whole || u_MapPlace == MAP_PLACE_NO_RANGE;
    if (whole || u_MapPlace == MAP_PLACE_NO_RANGE_DEPTH)
        at.z = place.z;
    if (whole || u_MapPlace == MAP_PLACE_NO_RANGE_XY)
        at.xy = place.xy;
    if (u_MapPlace == MAP_PLACE_FLIPPED)
        at.y = 1.0 - at.y;
    if (u_MapPlace == MAP_PLACE_MIRRORED)
        at.x = 1.0 - at.x;
    if (u_MapPlace == MAP_PLACE_YXZ)
        at = at.yxz;
    if (u_MapPlace == MAP_PLACE_XZY)
        at = at.xzy;
    vec2 asked = at.xy;
    if (u_MapOutside == MAP_OUTSIDE_UNHALVED)
        asked = place.xy;
    else if (u_MapOutside == MAP_OUTSIDE_HALVED)
        asked = 0.5 * at.xy + 0.5;
    bool beside = asked.x < 0.0 || asked.x > 1.0 || asked.y < 0.0 || asked.y > 1.0;
    bool dark = u_MapOutside == MAP_OUTSIDE_DARK || u_MapTest == MAP_TEST_ALWAYS;
    if (beside && u_MapOutside != MAP_OUTSIDE_CLAMPED)
        return dark ? u_ShadowLight : 1.0;
    vec3 texel = texture2D(u_Map, at.xy).rgb;
    if (u_MapDepth == MAP_DEPTH_BGR)
        texel = texel.bgr;
    float depth =
        u_MapDepth == MAP_DEPTH_RED ? texel.r : dot(texel, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0));
    float bias = u_MapBias.x + u_MapBias.z / v_Map.w;
    if (u_MapBias.y != 0.0)
        bias = max(u_MapBias.y * (1.0 - dot(normal, normalize(u_Light[0] - v_Place))), bias);
    bool lit = at.z - bias <= depth;
    if (u_MapTest == MAP_TEST_INVERTED)
        lit = !lit;
    else if (u_MapTest == MAP_TEST_NEVER || u_MapTest == MAP_TEST_ALWAYS)
        lit = u_MapTest == MAP_TEST_NEVER;
    return lit ? u_MapLight : u_ShadowLight;
}
#endif

// 1 on the back.
int side(vec3 normal) {
    bool front = gl_FrontFacing;
    if (u_Facing == FACING_NONE)
        return 0;
    if (u_Facing == FACING_BACK)
        return 1;
    if (u_Facing == FACING_AXIS)
        return dot(normal, u_Axis) > 0.0 ? 0 : 1;
    if (u_Facing == FACING_MIRRORED)
        return front ? 1 : 0;
    if (u_Facing >= FACING_ORIGIN)
        return dot(normal, u_Facing == FACING_ORIGIN ? -v_Place : u_View) < 0.0 ? 1 : 0;
    if (u_Facing >= FACING_VIEW)
        return (dot(normal, u_View - v_Place) > 0.0) == (u_Facing == FACING_VIEW) ? 0 : 1;
    if (u_Facing == FACING_RIGHT && u_Mirrored < 0.0)
        front = !front;
    if (u_Facing == FACING_SWAPPED) {
        front = u_Mirrored < 0.0 ? front : !front;
    } else if (u_Facing == FACING_LIGHT) {
        front = dot(normal, u_Light[0] - v_Place) > 0.0;
    }
    return front ? 0 : 1;
}

void main() {
    if (u_Discard == CULL_FRONT && gl_FrontFacing)
        discard;
    bool unit = u_NormalUnit == UNIT_RIGHT || u_NormalUnit == UNIT_AT_BOTH;
    vec3 normal = unit ? normalize(v_Normal) : v_Normal;
    int back = side(normal);
    if (u_NormalUnit == UNIT_WITH_W)
        normal *= inversesqrt(dot(normal, normal) + 1.0);
    if (u_Discard == CULL_BACK && back == 1)
        discard;
    if (back == 1 && u_BackNormal == 1)
        normal = -normal;
    vec3 color = v_Color;
#ifdef SHADOWS
    g_Visible = visibility(normal);
    if (u_MapTest == MAP_TEST_ALL_INVERTED)
        g_Visible = 1.0 + u_ShadowLight - g_Visible;
    color = mix(v_Shade, v_Color, g_Visible);
#endif
    if (u_AtVertices == 0)
        color = shade(v_Place, normal, v_Toward[0], v_Toward[1], back);
    if (u_Gamma != 1.0)
        color = pow(max(color, 0.0), vec3(u_Gamma));
    color = min(color, u_Most);
    if (u_Output == OUTPUT_INVERTED)
        color = 1.0 - color;
    else if (u_Output == OUTPUT_SWAPPED)
        color = color.bgr;
    else if (u_Output == OUTPUT_GREY)
        color = vec3(dot(color, vec3(0.299, 0.587, 0.114)));
    else if (u_Output == OUTPUT_BLACK)
        color = vec3(0.0);
    else if (u_Output == OUTPUT_WHITE)
        color = vec3(1.0);
    gl_FragColor = vec4(color, 1.0);
}
