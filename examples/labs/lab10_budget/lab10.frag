// Lab 10: light each fragment, with Phong's highlight, as cheaply as it goes.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // in the world
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // in the world

varying vec4 v_Color;

void main() {
    // Begin with what you did in lab 6.
    // To do: the highlight; then leave out what costs time and changes nothing.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
