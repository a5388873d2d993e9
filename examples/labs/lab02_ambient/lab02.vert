// Lab 2: project each vertex; two directional lights, and ambient light once.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightDirection[2]; // world space, to the lights, normalized
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    // Start from your lab 1.
    // To do: the sum of both lights, and the ambient light.
    v_Color = a_Color;
}
