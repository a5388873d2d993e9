attribute vec4 a_Position;
attribute vec3 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
varying vec3 worldPos;
varying vec3 worldNormal;
varying vec4 baseColor;
void main() {
    vec4 p = u_ModelMatrix * a_Position;
    worldPos = p.xyz / p.w;
    worldNormal = mat3(u_NormalMatrix) * a_Normal;
    baseColor = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
