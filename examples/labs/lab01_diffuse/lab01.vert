// Lab 1: project and light each vertex.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor;
uniform vec3 u_LightDirection; // world space, to the light, normalized

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    // To do: the normal in world space, the cosine between it and the light direction, and the
    // reflected light.
    v_Color = a_Color;
}
