attribute vec4 a_Position, a_Normal, a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
uniform vec3 u_LightPosition[2], u_EyePosition;
varying vec3 v_Normal, v_ToEye, v_ToLight[2];
varying vec4 v_Color;
void main() {
    vec4 worldPosition = u_ModelMatrix * a_Position;
    v_ToEye = u_EyePosition - worldPosition.xyz;
    v_ToLight[0] = u_LightPosition[0] - worldPosition.xyz;
    v_ToLight[1] = u_LightPosition[1] - worldPosition.xyz;
    v_Normal = normalize(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)).xyz;
    v_Color = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
