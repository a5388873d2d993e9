// Lab 6: light each fragment, with Phong's highlight.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // world space
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // world space

varying vec4 v_Color;

void main() {
    // Start from your lab 5.
    // To do: the view direction, the reflected light direction, and the highlight.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
