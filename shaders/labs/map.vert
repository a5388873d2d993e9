// map: see map.frag.

attribute vec4 a_Position;

uniform mat4 u_ClipFromObject;

varying vec2 v_Depth;

void main() {
    gl_Position = u_ClipFromObject * a_Position;
    v_Depth = gl_Position.zw;
}
