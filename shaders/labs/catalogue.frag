// catalogue: see catalogue.vert.

precision highp float;
precision highp int;

uniform int u_Facing;     // what the side is told by
uniform float u_Mirrored; // -1 where the model matrix mirrors
uniform int u_BackNormal; // 1: reversed on the back
uniform int u_Discard;    // 1: what is seen from the front
uniform float u_Gamma;

varying vec3 v_Place;
varying vec3 v_Normal;
varying vec3 v_Toward[2];
varying vec3 v_Color;

#include "catalogue_light.glsl"

// 1 on the back.
int side(vec3 normal) {
    bool front = gl_FrontFacing;
    if (u_Facing == 0)
        return 0;
    if (u_Facing == 1 && u_Mirrored < 0.0)
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
    vec3 normal = u_NormalUnit >= 2 ? normalize(v_Normal) : v_Normal;
    int back = side(normal);
    if (back == 1 && u_BackNormal == 1)
        normal = -normal;
    vec3 color = v_Color;
    if (u_AtVertices == 0)
        color = shade(v_Place, normal, v_Toward[0], v_Toward[1], back);
    if (u_Gamma != 1.0)
        color = pow(max(color, 0.0), vec3(u_Gamma));
    gl_FragColor = vec4(color, 1.0);
}
