attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
varying vec4 v_Color;
varying vec3 v_Normal, v_Position;
void main() {
    gl_Position = u_MvpMatrix * a_Position;
    v_Position = (u_ModelMatrix * a_Position).xyz;
    v_Normal = (u_NormalMatrix * vec4(a_Normal.xyz, 0.0)).xyz;
    v_Color = a_Color;
}
