attribute vec4 a_Position;
attribute vec3 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
varying vec3 q;
varying vec3 n;
varying vec4 c;
void main() {
    vec4 p = u_ModelMatrix * a_Position;
    q = p.xyz / p.w;
    n = normalize(mat3(u_NormalMatrix) * a_Normal);
    c = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
