#version 100
// Everything in eye coordinates.
attribute vec4 a_Position, a_Normal, a_Color;
uniform mat4 u_ProjMatrix, u_ModelViewMatrix, u_EyeNormalMatrix, u_ViewMatrix;
uniform vec3 u_LightColor, u_LightDirection;
varying lowp vec4 v_Color;
void main() {
    vec4 eyePosition = u_ModelViewMatrix * a_Position;
    vec3 N = normalize((u_EyeNormalMatrix * vec4(a_Normal.xyz, 0.0)).xyz);
    vec3 L = (u_ViewMatrix * vec4(u_LightDirection, 0.0)).xyz;
    v_Color.rgb = clamp(dot(N, L), 0.0, 1.0) * (u_LightColor * a_Color.rgb);
    v_Color.a = a_Color.a;
    gl_Position = u_ProjMatrix * eyePosition;
}
