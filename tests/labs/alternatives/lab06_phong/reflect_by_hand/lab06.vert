attribute vec4 a_Position;
attribute vec3 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
varying vec3 v_Position;
varying vec3 v_Normal;
varying vec4 v_Color;
void main() {
    vec4 p = u_ModelMatrix * a_Position;
    v_Position = p.xyz / p.w;
    v_Normal = mat3(u_NormalMatrix) * a_Normal;
    v_Color = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
