// Lab 8: light each fragment with a spot that falls off towards its edge and with the distance.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // in the world
uniform vec3 u_SpotDirection; // in the world, away from the light, unit
uniform float u_SpotCutoff;   // half the cone's angle, in degrees
uniform float u_SpotExponent;
uniform vec3 u_Attenuation; // constant, linear, quadratic
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // in the world

varying vec4 v_Color;

void main() {
    // Begin with what you did in lab 6.
    // To do: the cone, its fall-off, and the attenuation.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
