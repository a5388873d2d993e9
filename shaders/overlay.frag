// marks: lines and points in colours of their own, without light.

precision mediump float;

varying vec3 v_Color;

void main() {
    gl_FragColor = vec4(v_Color, 1.0);
}
