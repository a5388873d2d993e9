attribute highp vec4 a_Position;
varying highp vec2 v_At;
void main() {
    v_At = 0.5 * a_Position.xy + 0.5;
    gl_Position = a_Position;
}
