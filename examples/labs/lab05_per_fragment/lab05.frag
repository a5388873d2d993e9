// Lab 5: light each fragment.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // world space
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    // To do: the lighting of lab 4, here.
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb, v_Color.a);
}
