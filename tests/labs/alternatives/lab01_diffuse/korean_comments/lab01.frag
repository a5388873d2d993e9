precision mediump float;
varying vec4 v_Color; // 꼭짓점 사이에서 보간된 색
void main(void) {
    gl_FragColor = v_Color;
}
