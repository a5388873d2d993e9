// Computes CODE; study/arithmetic/meter.c defines what it measures.
#ifndef CODE
#define CODE a
#define ONE u_One
#define PRECISION highp
#endif
precision PRECISION float;
uniform highp sampler2D u_A, u_B;
uniform float u_One;
varying highp vec2 v_At;
void main() {
    vec4 a = texture2D(u_A, v_At), b = texture2D(u_B, v_At);
    a *= ONE;
    b *= ONE;
    gl_FragColor = ONE * (CODE);
}
