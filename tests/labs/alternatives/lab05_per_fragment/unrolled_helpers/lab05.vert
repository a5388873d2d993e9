attribute vec4 a_Position;
attribute vec3 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
varying vec3 pos;
varying vec3 nrm;
varying vec4 col;
void main() {
    vec4 p = u_ModelMatrix * a_Position;
    pos = p.xyz / p.w;
    nrm = mat3(u_NormalMatrix) * a_Normal;
    col = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
