// Lab 1: the colour comes from the vertices, interpolated. Nothing is to be done here.

precision mediump float;

varying vec4 v_Color;

void main() {
    gl_FragColor = v_Color;
}
