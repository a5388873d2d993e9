// Lab 4: at each vertex, project it; two point lights.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // in the world
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    // Begin with what you did in lab 2.
    // To do: where this vertex lies in the world, and the direction from there to each light.
    v_Color = vec4(u_AmbientLight * a_Color.rgb, a_Color.a);
}
