// Light at the vertices, for both sides; the fragment chooses.
attribute vec4 a_Position;
attribute vec4 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
varying vec3 v_Position;
varying vec3 v_Normal;
varying vec4 v_Color;
void main() {
    gl_Position = u_MvpMatrix * a_Position;
    v_Position = vec3(u_ModelMatrix * a_Position);
    v_Normal = vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0));
    v_Color = a_Color;
}
