// catalogue: a lab's right picture, or that of a mistake. Matrices and colours are chosen on the
// CPU: see examples/labs/diagnosis/wrong_program.h.

attribute vec4 a_Position;
attribute vec4 a_Normal;

uniform mat4 u_Clip;
uniform mat4 u_Place;
uniform mat4 u_Normal; // its last column is added, as for a normal with w = 1

uniform int u_NormalOf; // 1: of the position

varying vec3 v_Place;
varying vec3 v_Normal;
varying vec3 v_Toward[2];
varying vec3 v_Color;

#ifdef SHADOWS
uniform mat4 u_MapMatrix; // to clip space of the light
varying vec4 v_Map;
varying vec3 v_MapDivided;
varying vec3 v_Shade; // the colour in shadow
#endif

#include "catalogue_light.glsl"

void main() {
    gl_Position = u_Clip * a_Position;
    v_Place = vec3(u_Place * a_Position);
    vec3 normal = vec3(u_Normal * vec4(u_NormalOf == 1 ? a_Position.xyz : a_Normal.xyz, 1.0));
    bool here = u_NormalUnit == UNIT_AT_VERTICES || u_NormalUnit == UNIT_AT_BOTH;
    v_Normal = here ? normalize(normal) : normal;
    v_Toward[0] = normalize(u_Light[0] - u_FromPlace * v_Place);
    v_Toward[1] = normalize(u_Light[1] - u_FromPlace * v_Place);
    v_Color = vec3(0.0);
#ifdef SHADOWS
    v_Map = u_MapMatrix * a_Position;
    v_MapDivided = v_Map.xyz / v_Map.w;
    v_Shade = vec3(0.0);
#endif
    vec3 unit = u_NormalUnit == UNIT_WITH_W ? normal * inversesqrt(dot(normal, normal) + 1.0)
                                  : normalize(normal);
    if (u_NormalUnit == UNIT_NEVER)
        unit = normal;
    if (u_AtVertices == 1)
        v_Color = shade(v_Place, unit, v_Toward[0], v_Toward[1], 0);
#ifdef SHADOWS
    g_Visible = 0.0;
    if (u_AtVertices == 1)
        v_Shade = shade(v_Place, unit, v_Toward[0], v_Toward[1], 0);
#endif
}
