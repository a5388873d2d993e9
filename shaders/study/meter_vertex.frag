varying highp vec4 v_Result;
void main() {
    gl_FragColor = v_Result;
}
