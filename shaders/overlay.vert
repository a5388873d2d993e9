// marks: lines and points in colours of their own, without light.

attribute vec4 a_Position;
attribute vec3 a_Color;

uniform mat4 u_ClipFromWorld;
uniform float u_PointSize; // in pixels

varying vec3 v_Color;

void main() {
    gl_Position = u_ClipFromWorld * a_Position;
    gl_PointSize = u_PointSize;
    v_Color = a_Color;
}
