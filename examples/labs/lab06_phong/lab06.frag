// Lab 6: light each fragment, with Phong's highlight.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // in the world
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // in the world

varying vec4 v_Color;

void main() {
    // Begin with what you did in lab 5.
    // To do: the direction to the eye, that of the reflected light, and the highlight.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
