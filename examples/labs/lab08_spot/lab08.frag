// Lab 8: light each fragment with a spot light with a soft edge and attenuation.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_SpotDirection; // world space, from the light, normalized
uniform float u_SpotCutoff;   // half the cone's angle, in degrees
uniform float u_SpotExponent;
uniform vec3 u_Attenuation; // constant, linear, quadratic
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // world space

varying vec4 v_Color;

void main() {
    // Start from your lab 6.
    // To do: the cone, its fall-off, and the attenuation.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
