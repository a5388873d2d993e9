// outline: what a lab's objects cover, without light.

attribute vec4 a_Position;

uniform mat4 u_Clip;

void main() {
    gl_Position = u_Clip * a_Position;
}
