// Lab 4: the colour is interpolated between the vertices.

precision mediump float;

varying vec4 v_Color;

void main() {
    gl_FragColor = v_Color;
}
