// Computes CODE; study/arithmetic/meter.c defines what it measures.
#ifndef CODE
#define CODE a
#define ONE u_One
#define PRECISION highp
#endif
precision PRECISION float;
attribute highp vec4 a_Position;
attribute highp vec4 a_A, a_B;
uniform float u_One;
varying highp vec4 v_Result;
void main() {
    gl_Position = a_Position;
    gl_PointSize = 1.0;
    vec4 a = a_A, b = a_B;
    a *= ONE;
    b *= ONE;
    v_Result = ONE * (CODE);
}
