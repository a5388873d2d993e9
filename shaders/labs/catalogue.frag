// catalogue: see catalogue.vert.

precision highp float;
precision highp int;

uniform int u_Facing;     // 0: right; 1: none; 2: not mirrored; 3: swapped; 4: by the light; 5: back; 6:
                          // by the angle to the eye; 7: and swapped; 8: by that to the camera's axis; 9: always
                          // mirrored; 10: by that to the origin; 11: by that to the eye as a direction
uniform vec3 u_Axis;      // of the camera, towards the eye
uniform float u_Mirrored; // -1 if the model matrix mirrors
uniform int u_BackNormal; // 1: reversed on the back
uniform int u_Discard;    // 1: front faces; 2: back faces
uniform float u_Gamma;
uniform float u_Most; // no channel is larger
uniform int u_Output; // 1: inverted; 2: red and blue swapped; 3: grey; 4: black; 5: white

varying vec3 v_Place;
varying vec3 v_Normal;
varying vec3 v_Toward[2];
varying vec3 v_Color;

#include "catalogue_light.glsl"

#ifdef SHADOWS
uniform highp sampler2D u_Map;
uniform int u_MapPlace;   // 0: right; 1: not divided by w; 2: from -1 to 1; 3: only the depth; 4: only
                          // the place; 5: y reversed; 6: x reversed; 8: 1 and 2; 9: x and y swapped;
                          // 10: y and z swapped; 11: divided by w at the vertices
uniform int u_MapDepth;   // 1: only red; 2: red and blue swapped
uniform vec3 u_MapBias;   // constant; times one minus the cosine, if that is more; divided by w
uniform int u_MapTest;    // 1: inverted; 2: never in shadow; 3: always; 4: beside the map inverted, too
uniform int u_MapOutside; // 0: lit; 1: as the edge; 2: dark; 3: from 0 to 1 before it is halved; 4: from
                          // -1 to 1 after
uniform float u_ShadowLight; // what a shadow leaves
uniform float u_MapLight;    // the visibility of what the map shows in light

varying vec4 v_Map;
varying vec3 v_MapDivided;
varying vec3 v_Shade;

float visibility(vec3 normal) {
    vec3 place = u_MapPlace == 1 || u_MapPlace == 8 ? v_Map.xyz : v_Map.xyz / v_Map.w;
    if (u_MapPlace == 11)
        place = v_MapDivided;
    vec3 at = 0.5 * place + 0.5;
    if (u_MapPlace == 2 || u_MapPlace == 3 || u_MapPlace == 8)
        at.z = place.z;
    if (u_MapPlace == 2 || u_MapPlace == 4 || u_MapPlace == 8)
        at.xy = place.xy;
    if (u_MapPlace == 5)
        at.y = 1.0 - at.y;
    if (u_MapPlace == 6)
        at.x = 1.0 - at.x;
    if (u_MapPlace == 9)
        at = at.yxz;
    if (u_MapPlace == 10)
        at = at.xzy;
    vec2 asked = u_MapOutside == 3 ? place.xy : u_MapOutside == 4 ? 0.5 * at.xy + 0.5 : at.xy;
    if (u_MapOutside != 1 && (asked.x < 0.0 || asked.x > 1.0 || asked.y < 0.0 || asked.y > 1.0))
        return u_MapOutside == 2 || u_MapTest == 3 ? u_ShadowLight : 1.0;
    vec3 texel = texture2D(u_Map, at.xy).rgb;
    if (u_MapDepth == 2)
        texel = texel.bgr;
    float depth =
        u_MapDepth == 1 ? texel.r : dot(texel, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0));
    float bias = u_MapBias.x + u_MapBias.z / v_Map.w;
    if (u_MapBias.y != 0.0)
        bias = max(u_MapBias.y * (1.0 - dot(normal, normalize(u_Light[0] - v_Place))), bias);
    bool lit = at.z - bias <= depth;
    if (u_MapTest == 1)
        lit = !lit;
    else if (u_MapTest == 2 || u_MapTest == 3)
        lit = u_MapTest == 2;
    return lit ? u_MapLight : u_ShadowLight;
}
#endif

// 1 on the back.
int side(vec3 normal) {
    bool front = gl_FrontFacing;
    if (u_Facing == 1)
        return 0;
    if (u_Facing == 5)
        return 1;
    if (u_Facing == 8)
        return dot(normal, u_Axis) > 0.0 ? 0 : 1;
    if (u_Facing == 9)
        return front ? 1 : 0;
    if (u_Facing >= 10)
        return dot(normal, u_Facing == 10 ? -v_Place : u_View) < 0.0 ? 1 : 0;
    if (u_Facing >= 6)
        return (dot(normal, u_View - v_Place) > 0.0) == (u_Facing == 6) ? 0 : 1;
    if (u_Facing == 0 && u_Mirrored < 0.0)
        front = !front;
    if (u_Facing == 3) {
        front = u_Mirrored < 0.0 ? front : !front;
    } else if (u_Facing == 4) {
        front = dot(normal, u_Light[0] - v_Place) > 0.0;
    }
    return front ? 0 : 1;
}

void main() {
    if (u_Discard == 1 && gl_FrontFacing)
        discard;
    vec3 normal = u_NormalUnit == 0 || u_NormalUnit == 3 ? normalize(v_Normal) : v_Normal;
    int back = side(normal);
    if (u_NormalUnit == 4)
        normal *= inversesqrt(dot(normal, normal) + 1.0);
    if (u_Discard == 2 && back == 1)
        discard;
    if (back == 1 && u_BackNormal == 1)
        normal = -normal;
    vec3 color = v_Color;
#ifdef SHADOWS
    g_Visible = visibility(normal);
    if (u_MapTest == 4)
        g_Visible = 1.0 + u_ShadowLight - g_Visible;
    color = mix(v_Shade, v_Color, g_Visible);
#endif
    if (u_AtVertices == 0)
        color = shade(v_Place, normal, v_Toward[0], v_Toward[1], back);
    if (u_Gamma != 1.0)
        color = pow(max(color, 0.0), vec3(u_Gamma));
    color = min(color, u_Most);
    if (u_Output == 1)
        color = 1.0 - color;
    else if (u_Output == 2)
        color = color.bgr;
    else if (u_Output == 3)
        color = vec3(dot(color, vec3(0.299, 0.587, 0.114)));
    else if (u_Output == 4)
        color = vec3(0.0);
    else if (u_Output == 5)
        color = vec3(1.0);
    gl_FragColor = vec4(color, 1.0);
}
