// Lab 1: at each vertex, project it and light it.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor;
uniform vec3 u_LightDirection; // in the world, towards the light, unit

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    // To do: the normal in the world, the cosine between it and the light's direction, and the
    // light that is reflected.
    v_Color = a_Color;
}
