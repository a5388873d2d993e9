attribute vec4 a_Position;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix;
varying vec3 v_Position;
varying vec4 v_Color;
void main() {
    v_Position = vec3(u_ModelMatrix * a_Position);
    v_Color = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
