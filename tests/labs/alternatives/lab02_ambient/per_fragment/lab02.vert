attribute vec3 a_Position;
attribute vec3 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
varying vec3 fNormal;
varying vec4 fColor;
void main() {
    fNormal = (u_NormalMatrix * vec4(a_Normal, 0.0)).xyz;
    fColor = a_Color;
    gl_Position = u_MvpMatrix * vec4(a_Position, 1.0);
}
