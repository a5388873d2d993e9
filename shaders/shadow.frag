// shadow.frag: marks a pixel as in shadow; only the channel of one light is written.

precision mediump float;

void main() {
    gl_FragColor = vec4(1.0);
}
