attribute vec4 a_Position;
attribute vec3 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
varying vec3 P;
varying vec3 N_;
varying vec4 C;
void main() {
    vec4 p = u_ModelMatrix * a_Position;
    P = p.xyz / p.w;
    N_ = mat3(u_NormalMatrix) * a_Normal;
    C = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
