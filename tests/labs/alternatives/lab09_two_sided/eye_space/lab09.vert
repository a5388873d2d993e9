attribute vec4 a_Position;
attribute vec4 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_ModelViewMatrix;
uniform mat4 u_EyeNormalMatrix;
uniform mat4 u_ProjMatrix;
varying vec3 v_EyePosition;
varying vec3 v_EyeNormal;
varying vec4 v_Color;
void main() {
    vec4 eyePosition = u_ModelViewMatrix * a_Position;
    v_EyePosition = eyePosition.xyz;
    v_EyeNormal = normalize((u_EyeNormalMatrix * vec4(a_Normal.xyz, 0.0)).xyz);
    v_Color = a_Color;
    gl_Position = u_ProjMatrix * eyePosition;
}
