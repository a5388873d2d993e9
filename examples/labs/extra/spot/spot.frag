// Spot: light each fragment with a spot light whose edge is as soft as its two cones are apart.

precision highp float;

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_SpotDirection; // world space, from the light, normalized
uniform float u_CosOuterCut;
uniform float u_CosInnerCut;
uniform vec3 u_Attenuation; // constant, linear, quadratic
uniform vec3 u_AmbientLight;

varying vec4 v_Color;
varying vec3 v_Normal;   // world space
varying vec3 v_Position; // world space

void main() {
    // To do: the light.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
