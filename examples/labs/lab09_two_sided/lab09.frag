// Lab 9: light both sides, each with its own colour and its own normal.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_AmbientLight;
uniform vec4 u_BackColor;
uniform float u_Mirrored; // -1 if the model matrix mirrors, else 1

varying vec4 v_Color;

void main() {
    // Start from your lab 5.
    // To do: which side is visible, its colour and its normal.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
