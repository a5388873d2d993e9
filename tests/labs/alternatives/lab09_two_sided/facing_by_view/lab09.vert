attribute vec4 a_Position, a_Normal, a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
varying vec3 v_P, v_N;
varying vec4 v_Front;
void main() {
    v_P = vec3(u_ModelMatrix * a_Position);
    v_N = vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0));
    v_Front = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
