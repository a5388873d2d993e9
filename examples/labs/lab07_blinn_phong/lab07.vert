// Lab 7: project each vertex and pass on what the fragment shader needs.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    // To do: pass on position and normal in world space.
    v_Color = a_Color;
}
