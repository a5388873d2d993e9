// Lab 4: project each vertex; two point lights.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // world space
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    // Start from your lab 2.
    // To do: this vertex in world space, and the direction from there to each light.
    v_Color = vec4(u_AmbientLight * a_Color.rgb, a_Color.a);
}
