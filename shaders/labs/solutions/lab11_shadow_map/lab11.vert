// Lab 11: project each vertex, for the eye and for the light.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform mat4 u_LightMatrix; // world space to the light's clip space

varying vec4 v_Color;
varying vec3 v_Normal;        // world space
varying vec3 v_Position;      // world space
varying vec4 v_LightPosition; // the light's clip space

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    v_Position = vec3(u_ModelMatrix * a_Position);
    v_Normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
    v_LightPosition = u_LightMatrix * u_ModelMatrix * a_Position;
    v_Color = a_Color;
}
